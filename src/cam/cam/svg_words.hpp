// SvgWords: reads the numbers in SVG attributes. Private to cam/.
#pragma once

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "dxf_transform.hpp"

namespace passo {

class SvgWords {
 public:
  explicit SvgWords(std::string_view text) : text_(text), rest_(text) {}

  // Returns the offset of the next word, for messages.
  std::size_t place() const { return text_.size() - rest_.size(); }
  bool at_end() {
    skip();
    return rest_.empty();
  }
  char peek() {
    skip();
    return rest_.empty() ? '\0' : rest_.front();
  }
  void drop(std::size_t count = 1) { rest_.remove_prefix(std::min(count, rest_.size())); }
  std::string_view rest() const { return rest_; }

  std::optional<double> number() {
    skip();
    std::string_view text = rest_;
    if (text.starts_with('+')) text.remove_prefix(1);
    const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
    const bool is_number =
        !digits.empty() && ((digits[0] >= '0' && digits[0] <= '9') ||
                            (digits[0] == '.' && digits.size() > 1 && digits[1] >= '0' && digits[1] <= '9'));
    if (!is_number) return std::nullopt;
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
    rest_ = text.substr(static_cast<std::size_t>(end - text.data()));
    return value;
  }
  // Reads a flag of an arc; flags need no separator.
  std::optional<bool> flag() {
    const char c = peek();
    if (c != '0' && c != '1') return std::nullopt;
    drop();
    return c == '1';
  }
  // Reads the letters that follow.
  std::string_view name() {
    skip();
    std::size_t size = 0;
    while (size < rest_.size() && std::isalpha(static_cast<unsigned char>(rest_[size])) != 0) ++size;
    const std::string_view found = rest_.substr(0, size);
    drop(size);
    return found;
  }

 private:
  void skip() {
    const std::size_t next = rest_.find_first_not_of(" \t\r\n\f,");
    rest_.remove_prefix(next == std::string_view::npos ? rest_.size() : next);
  }

  std::string_view text_;
  std::string_view rest_;
};

// Reads a transform list such as "translate(10,20) rotate(45)". Nothing if it is invalid.
std::optional<DxfTransform> svg_transform(std::string_view text);

// Reads transform-origin: one or two lengths, percentages or sides such as "left". Nothing if it is invalid.
std::optional<std::array<double, 2>> svg_transform_origin(std::string_view text, double width, double height,
                                                          double inch);

inline constexpr double svg_inch = 96;  // pixels

// Reads a length and converts it to pixels. `whole`: the length of 100 %. `inch`: the number of pixels per inch.
std::optional<double> svg_length(std::string_view text, double whole, double inch = svg_inch);

}  // namespace passo
