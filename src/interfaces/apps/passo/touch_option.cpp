#include "touch_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

// An empty text leaves the value as it is.
bool read_end(std::string_view text, double& value) {
  if (text.empty()) return true;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Reads one range: "X10:60".
bool read_range(std::string_view text, const MachineDescription& machine, TouchBox& box) {
  const std::size_t colon = text.find(':');
  if (text.size() < 3 || colon == std::string_view::npos) return false;
  const std::optional<Axis> axis = axis_of(text[0]);
  const auto is_it = [&](const AxisDescription& description) { return description.axis == axis; };
  if (!axis || std::ranges::none_of(machine.axes, is_it)) return false;
  TouchBox::Range& range = box.ranges[*axis];
  return read_end(text.substr(1, colon - 1), range.low) && read_end(text.substr(colon + 1), range.high) &&
         range.low <= range.high;
}

// Reads a place: "X100,Y80,Z-20". Axes that it does not name are 0.
bool read_place(std::string_view text, Point& place) {
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    const std::optional<Axis> axis = word.empty() ? std::nullopt : axis_of(word[0]);
    if (!axis || is_rotary(*axis) || word.size() < 2 || !read_end(word.substr(1), place[*axis])) return false;
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

bool read_box(std::string_view text, const MachineDescription& machine, TouchBox& box) {
  for (;;) {
    const std::size_t comma = text.find(',');
    if (!read_range(text.substr(0, comma), machine, box)) return false;
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

bool names_file(const std::string& text) {
  const std::string file = text.substr(0, text.rfind('@'));
  std::error_code none;
  return file.ends_with(".stl") || file.ends_with(".csv") || std::filesystem::exists(file, none);
}

std::optional<PlacedSurface> read_placed(const std::string& text) {
  PlacedSurface placed;
  const std::size_t at = text.rfind('@');
  if (at != std::string::npos && !read_place(std::string_view(text).substr(at + 1), placed.zero)) {
    fail(exit_bad_program, fmt::format("'{}': expected FILE@POSITION with the position of the file's zero in machine "
                                       "coordinates, e.g. part.stl@X100,Y80,Z-20",
                                       text));
    return std::nullopt;
  }
  Diagnostics diagnostics;
  placed.surface = std::make_shared<const Surface>(read_surface(text.substr(0, at), diagnostics));
  show(diagnostics);
  if (diagnostics.any_error()) return std::nullopt;
  return placed;
}

}  // namespace

std::optional<std::vector<Touchable>> read_touch_options(const std::vector<std::string>& texts,
                                                         const MachineDescription& machine) {
  std::vector<Touchable> things;
  for (const std::string& text : texts) {
    if (names_file(text)) {
      const std::optional<PlacedSurface> placed = read_placed(text);
      if (!placed) return std::nullopt;
      things.emplace_back(*placed);
      continue;
    }
    TouchBox box;
    if (!read_box(text, machine, box)) {
      fail(exit_bad_program, fmt::format("'{}': expected --touch with LOW:HIGH of axes of the machine in machine "
                                         "coordinates, e.g. Z:-1.5 or X10:60,Y10:50,Z:-2, or an STL or height map file",
                                         text));
      return std::nullopt;
    }
    things.emplace_back(box);
  }
  return things;
}

}  // namespace passo
