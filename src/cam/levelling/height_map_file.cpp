#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/levelling/height_map.hpp"

namespace passo {
namespace {

constexpr std::string_view between = " \t,;\r";

struct MapPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  std::uint32_t line = 0;
};

class HeightMapReader {
 public:
  HeightMapReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  std::optional<HeightMap> read(std::string_view text);

 private:
  void read_line(std::string_view line);
  bool looks_like_names(std::string_view line) const;
  std::optional<HeightMap> grid();
  void error(std::uint32_t line, std::size_t column, std::size_t length, std::string_view text, std::string message,
             std::string expected);

  const std::string& name_;
  Diagnostics& diagnostics_;
  std::vector<MapPoint> points_;
  std::uint32_t line_ = 0;
  bool has_names_ = false;
  bool is_none_ = false;  // the first line is no point: this is another kind of text
};

void HeightMapReader::error(std::uint32_t line, std::size_t column, std::size_t length, std::string_view text,
                            std::string message, std::string expected) {
  diagnostics_.add({.code = "surface.height-map",
                    .file = name_,
                    .place = {.line = line,
                              .column = static_cast<std::uint32_t>(column + 1),
                              .length = static_cast<std::uint32_t>(std::max<std::size_t>(1, length))},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(text.substr(0, 1000))});
}

std::optional<HeightMap> HeightMapReader::read(std::string_view text) {
  while (!text.empty() && !diagnostics_.full() && !is_none_) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    ++line_;
    read_line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (diagnostics_.any_error()) return {};
  return grid();
}

bool HeightMapReader::looks_like_names(std::string_view line) const {
  return points_.empty() && !has_names_ && line.find_first_of("0123456789") == std::string_view::npos;
}

void HeightMapReader::read_line(std::string_view line) {
  const std::string_view words = line.substr(0, line.find('#'));
  std::size_t at = words.find_first_not_of(between);
  if (at == std::string_view::npos) return;
  if (looks_like_names(words)) {
    has_names_ = true;
    return;
  }
  double values[3] = {};
  for (int i = 0; i < 3; ++i) {
    const std::size_t end =
        at == std::string_view::npos ? at : std::min(words.find_first_of(between, at), words.size());
    const std::string_view word = at == std::string_view::npos ? "" : words.substr(at, end - at);
    const auto [last, fault] = std::from_chars(word.data(), word.data() + word.size(), values[i]);
    if (fault != std::errc() || last != word.data() + word.size() || !(std::abs(values[i]) <= HeightMap::farthest)) {
      is_none_ = points_.empty();
      error(line_, at == std::string_view::npos ? words.size() : at, word.size(), line,
            (is_none_ ? std::string("this is not a height map: ") : std::string()) +
                (word.empty() ? "a number is missing" : fmt::format("'{}' is not a valid length", word.substr(0, 40))),
            fmt::format("x, y and z of a point in mm, each at most {:g}", HeightMap::farthest));
      return;
    }
    at = words.find_first_not_of(between, end);
  }
  if (at != std::string_view::npos) {
    error(line_, at, words.size() - at, line, "there is more than one point on this line", "x, y and z");
    return;
  }
  points_.push_back({.x = values[0], .y = values[1], .z = values[2], .line = line_});
}

std::vector<double> sorted_once(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
}

std::optional<HeightMap> HeightMapReader::grid() {
  std::vector<double> columns;
  std::vector<double> rows;
  for (const MapPoint& point : points_) {
    columns.push_back(point.x);
    rows.push_back(point.y);
  }
  columns = sorted_once(std::move(columns));
  rows = sorted_once(std::move(rows));
  if (columns.size() < 2 || rows.size() < 2) {
    error(0, 0, 1, "",
          fmt::format("{} in {} and {} are not enough for a surface", counted(points_.size(), "point"),
                      counted(columns.size(), "column"), counted(rows.size(), "row")),
          "a grid of at least two columns and two rows");
    return {};
  }
  // Points may be missing or double, so the grid may be far larger than the file.
  if (columns.size() > points_.size() / rows.size()) {
    error(0, 0, 1, "",
          fmt::format("{} in {} and {} do not fill a grid", counted(points_.size(), "point"),
                      counted(columns.size(), "column"), counted(rows.size(), "row")),
          fmt::format("a point for each column and row: {}",
                      static_cast<double>(columns.size()) * static_cast<double>(rows.size())));
    return {};
  }
  std::vector<std::optional<double>> heights(columns.size() * rows.size());
  for (const MapPoint& point : points_) {
    std::optional<double>& place = heights[index_of(rows, point.y) * columns.size() + index_of(columns, point.x)];
    if (place) {
      error(point.line, 0, 1, "", fmt::format("X{:g} Y{:g} has two heights", point.x, point.y),
            "each point of the grid once");
      return {};
    }
    place = point.z;
  }
  std::vector<double> all;
  all.reserve(heights.size());
  for (const std::optional<double>& height : heights) all.push_back(*height);
  return HeightMap(std::move(columns), std::move(rows), std::move(all));
}

}  // namespace

std::optional<HeightMap> read_height_map(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return HeightMapReader(name, diagnostics).read(text);
}

}  // namespace passo
