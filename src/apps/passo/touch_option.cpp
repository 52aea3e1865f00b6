#include "touch_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "program_input.hpp"
#include <fmt/format.h>

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

bool read_box(std::string_view text, const MachineDescription& machine, TouchBox& box) {
  for (;;) {
    const std::size_t comma = text.find(',');
    if (!read_range(text.substr(0, comma), machine, box)) return false;
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

std::optional<std::vector<TouchBox>> read_touch_options(const std::vector<std::string>& texts,
                                                        const MachineDescription& machine) {
  std::vector<TouchBox> boxes;
  for (const std::string& text : texts) {
    if (read_box(text, machine, boxes.emplace_back())) continue;
    fail(exit_bad_program, fmt::format("'{}': expected --touch LOW:HIGH of axes that the machine has, as Z:-1.5 or "
                                       "X10:60,Y10:50,Z:-2, in machine coordinates",
                                       text));
    return std::nullopt;
  }
  return boxes;
}

}  // namespace passo
