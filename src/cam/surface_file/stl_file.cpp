#include "stl_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

constexpr std::size_t binary_head = 84;      // bytes before the first triangle
constexpr std::size_t binary_triangle = 50;  // bytes
constexpr std::string_view blanks = " \t\r\n\v\f";

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return word;
}

// What the head of a binary STL file promises, or nothing.
std::optional<std::size_t> binary_triangles(std::string_view bytes) {
  if (bytes.size() < binary_head) return std::nullopt;
  const std::size_t count = word_at(bytes, 80);
  // Some programs write a few bytes more.
  const std::size_t size = binary_head + count * binary_triangle;
  if (bytes.size() < size || bytes.size() >= size + binary_triangle) return std::nullopt;
  return count;
}

bool is_within(const SurfaceTriangle& triangle) {
  return std::ranges::all_of(triangle, [](const SurfacePoint& point) {
    return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <= farthest_surface &&
           std::isfinite(point.x + point.y + point.z);
  });
}

class StlReader {
 public:
  StlReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : name_(name), bytes_(bytes), diagnostics_(diagnostics) {}

  std::vector<SurfaceTriangle> read() {
    const std::optional<std::size_t> binary = binary_triangles(bytes_);
    if (binary ? read_binary(*binary) : read_text()) {
      if (all_.empty()) refuse("has no triangle", "");
      return std::move(all_);
    }
    return {};
  }

 private:
  bool refuse(std::string message, std::string expected) {
    diagnostics_.add(of_file("surface.stl", name_, std::move(message), std::move(expected)));
    return false;
  }
  bool refuse_word(std::string expected);
  bool add(const SurfaceTriangle& triangle);
  bool read_binary(std::size_t count);
  bool read_text();
  bool read_facet();
  // The next word. Empty: the text is at its end.
  std::string_view next();
  bool read_word(std::string_view word);
  void skip_line() { at_ = std::min(bytes_.find('\n', at_), bytes_.size()); }
  bool read_point(SurfacePoint& point);

  const std::string& name_;
  std::string_view bytes_;
  Diagnostics& diagnostics_;
  std::vector<SurfaceTriangle> all_;
  std::size_t at_ = 0;    // after the word
  std::size_t word_ = 0;  // where it begins
};

bool StlReader::add(const SurfaceTriangle& triangle) {
  if (all_.size() == most_triangles) return refuse("has too many triangles", fmt::format("at most {}", most_triangles));
  all_.push_back(triangle);
  return is_within(triangle) || refuse(fmt::format("triangle {} is too far away", all_.size()),
                                       fmt::format("places of at most {:g} mm", farthest_surface));
}

bool StlReader::read_binary(std::size_t count) {
  all_.reserve(std::min(count, most_triangles));
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&](std::size_t index) {
      constexpr std::size_t after_normal = 12;
      const std::size_t at = binary_head + i * binary_triangle + after_normal + 4 * index;
      return static_cast<double>(std::bit_cast<float>(word_at(bytes_, at)));
    };
    const auto corner = [&](std::size_t k) {
      return SurfacePoint{number(3 * k), number(3 * k + 1), number(3 * k + 2)};
    };
    if (!add({corner(0), corner(1), corner(2)})) return false;
  }
  return true;
}

std::string_view StlReader::next() {
  word_ = std::min(bytes_.find_first_not_of(blanks, at_), bytes_.size());
  at_ = std::min(bytes_.find_first_of(blanks, word_), bytes_.size());
  return bytes_.substr(word_, at_ - word_);
}

// Writers differ in upper and lower case.
bool is_word(std::string_view word, std::string_view wanted) {
  return std::ranges::equal(word, wanted, {},
                            [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
}

bool StlReader::refuse_word(std::string expected) {
  const std::string_view before = bytes_.substr(0, word_);
  const std::size_t line_begin = before.find_last_of('\n') + 1;  // of the first line: npos + 1, which is 0
  const std::size_t line_end = std::min(bytes_.find_first_of("\r\n", line_begin), bytes_.size());
  constexpr std::size_t longest = 200;
  const std::string_view found = bytes_.substr(word_, std::min<std::size_t>(at_ - word_, 40));
  diagnostics_.add({.code = "surface.stl",
                    .file = name_,
                    .place = {.line = static_cast<std::uint32_t>(1 + std::ranges::count(before, '\n')),
                              .column = static_cast<std::uint32_t>(1 + word_ - line_begin),
                              .length = static_cast<std::uint32_t>(std::max<std::size_t>(1, found.size()))},
                    .message = found.empty() ? std::string("the file ends amid a body")
                                             : fmt::format("'{}' does not belong here", found),
                    .expected = std::move(expected),
                    .text = word_ - line_begin < longest
                                ? std::string(bytes_.substr(line_begin, std::min(longest, line_end - line_begin)))
                                : std::string()});
  return false;
}

bool StlReader::read_word(std::string_view word) {
  return is_word(next(), word) || refuse_word(fmt::format("'{}'", word));
}

bool StlReader::read_point(SurfacePoint& point) {
  for (double* value : {&point.x, &point.y, &point.z}) {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *value);
    if (error != std::errc() || end != word.data() + word.size()) return refuse_word("a number");
  }
  return true;
}

bool StlReader::read_facet() {
  SurfacePoint normal{};
  if (!read_word("normal") || !read_point(normal) || !read_word("outer") || !read_word("loop")) return false;
  SurfaceTriangle triangle{};
  for (SurfacePoint& corner : triangle) {
    if (!read_word("vertex") || !read_point(corner)) return false;
  }
  return read_word("endloop") && read_word("endfacet") && add(triangle);
}

bool StlReader::read_text() {
  if (!read_word("solid")) return false;
  skip_line();  // a name of any words
  for (std::string_view word = next(); !word.empty(); word = next()) {
    if (is_word(word, "facet")) {
      if (!read_facet()) return false;
    } else if (is_word(word, "solid") || is_word(word, "endsolid")) {
      skip_line();
    } else {
      return refuse_word("'facet' or 'endsolid'");
    }
  }
  return true;
}

}  // namespace

bool looks_like_stl(std::string_view bytes) {
  if (binary_triangles(bytes)) return true;
  const std::size_t first = bytes.find_first_not_of(blanks);
  return first != std::string_view::npos && is_word(bytes.substr(first, 5), "solid") &&
         (bytes.substr(0, 1 << 16).find("facet") != std::string_view::npos ||
          bytes.substr(0, 1 << 16).find("FACET") != std::string_view::npos);
}

std::vector<SurfaceTriangle> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return StlReader(name, bytes, diagnostics).read();
}

}  // namespace passo
