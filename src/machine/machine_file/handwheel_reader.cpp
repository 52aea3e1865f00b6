#include "handwheel_reader.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace passo {
namespace {

const char* const handwheel_code = "machine.handwheel";
constexpr NumberKey wheel_counts_key{"counts_per_detent", 1, 16, "4"};
constexpr NumberKey wheel_step_key{"step_mm", 1e-4, 1, "0.01"};
constexpr NumberKey wheel_speed_key{"speed_percent", 2, 100, "50"};
constexpr std::string_view wheel_axes_key = "axes";

std::string letters_of_axes(const std::vector<AxisDescription>& axes) {
  std::string letters;
  for (const AxisDescription& axis : axes) letters += letter_of(axis.axis);
  return letters;
}

// "XYZA", with a - for a position that moves nothing.
bool read_wheel_positions(std::string_view text, std::string_view letters, HandwheelDescription& wheel) {
  if (text.empty() || text.size() > HandwheelDescription::positions) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '-') continue;
    if (letters.find(text[i]) == std::string_view::npos || text.find(text[i], i + 1) != std::string_view::npos) {
      return false;
    }
    wheel.axes[i] = axis_of(text[i]);
  }
  return true;
}

}  // namespace

HandwheelDescription read_handwheel(const TomlEntry& entry, const std::vector<AxisDescription>& axes,
                                    const TomlReporter& reporter, const std::function<void(TableReader&)>& finish) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "handwheel", entry.place, reporter);
  HandwheelDescription wheel{.place = entry.place};
  const std::string letters = letters_of_axes(axes);
  const std::string usual = letters.substr(0, HandwheelDescription::positions);
  const std::string order = reader.text(wheel_axes_key, usual, Need::optional).value_or(usual);
  if (!axes.empty() && !read_wheel_positions(order, letters, wheel)) {
    reader.error(handwheel_code, wheel_axes_key,
                 fmt::format("{} = \"{}\"", reader.full_name(wheel_axes_key), order.substr(0, 40)),
                 fmt::format("at most four axes of this machine ({}) in the order of the selector; - for a position "
                             "that moves nothing",
                             letters));
  }
  if (const auto counts = reader.whole_number(wheel_counts_key, Need::optional)) {
    wheel.counts_per_detent = static_cast<int>(*counts);
  }
  wheel.step = reader.number(wheel_step_key, Need::optional).value_or(wheel.step);
  if (const auto percent = reader.number(wheel_speed_key, Need::optional)) wheel.share = *percent / 100;
  wheel.is_reversed = reader.flag("reversed").value_or(false);
  finish(reader);
  return wheel;
}

}  // namespace passo
