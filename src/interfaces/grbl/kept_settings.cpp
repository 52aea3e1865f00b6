#include "passo/grbl/kept_settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "passo/grbl/grbl_settings.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

// In mm: a pitch that makes no step too frequent for a board, whatever the axis is.
constexpr double long_pitch = 1000;

struct Change {
  std::string path;
  TomlText::Setting value;
};

std::optional<MachineDescription> described(const std::string& text) {
  Diagnostics diagnostics;
  return parse_machine(text, "the machine file", diagnostics, MachineUse::any_board);
}

std::optional<std::string> changed(const std::string& text, const std::vector<Change>& changes) {
  auto toml = TomlText::read(text);
  if (!toml) return {};
  for (const Change& change : changes) {
    if (!toml->set(change.path, change.value)) return {};
  }
  return described(toml->text()) ? std::optional(toml->text()) : std::nullopt;
}

// Shortest digits: 0.1 / 60 is no number that anybody wants to read.
double tidy(double value) {
  const std::string text = fmt::format("{:.9g}", value);
  double read = value;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return read;
}

std::string key(const AxisDescription& axis, std::string_view of_mm, std::string_view of_degrees) {
  return fmt::format("axis.{}.{}", letter_of(axis.axis), is_rotary(axis.axis) ? of_degrees : of_mm);
}

// Either the steps are in the file, or the pitch of a screw after the steps of a turn.
std::optional<std::string> with_scale(const std::string& text, const AxisDescription& axis, double value) {
  if (auto plain = changed(text, {{key(axis, "steps_per_mm", "steps_per_deg"), tidy(value)}})) return plain;
  if (is_rotary(axis.axis)) return {};
  const std::string pitch = key(axis, "screw_pitch_mm", "");
  const auto with_long = changed(text, {{pitch, long_pitch}});
  const auto machine = with_long ? described(*with_long) : std::nullopt;
  if (!machine) return {};
  const auto found = std::ranges::find(machine->axes, axis.axis, &AxisDescription::axis);
  return changed(text, {{pitch, tidy(long_pitch * found->steps_per_unit / value)}});
}

std::vector<Change> of_homing(const MachineDescription& machine, std::string_view of_mm, std::string_view of_degrees,
                              double value) {
  std::vector<Change> changes;
  for (const AxisDescription& axis : machine.axes) {
    if (axis.home) changes.push_back({key(axis, of_mm, of_degrees), tidy(value)});
  }
  return changes;
}

// The level at which a pin is on.
TomlText::Setting level(bool high) {
  return std::string(high ? "high" : "low");
}

// A bit for each axis of the reports. Lines are written only for axes that change.
std::vector<Change> of_directions(const MachineDescription& machine, double value) {
  constexpr double highest_mask = 255;
  if (value > highest_mask) return {};
  const auto mask = static_cast<unsigned>(std::lround(value));
  std::vector<Change> changes;
  const std::vector<Axis> axes = grbl_axes_of(machine);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool inverted = ((mask >> i) & 1U) != 0;
    const auto found = std::ranges::find(machine.axes, axes[i], &AxisDescription::axis);
    if (found == machine.axes.end() || found->inverted == inverted) continue;
    changes.push_back({key(*found, "inverted", "inverted"), inverted});
  }
  return changes;
}

std::vector<Change> changes_for(const MachineDescription& machine, int number, double value) {
  switch (number) {
    case 0: return {{"board.step_pulse_us", tidy(value)}};
    case 2: return {{"outputs.step", level(value == 0)}};
    case 3: return of_directions(machine, value);
    case 4: return {{"outputs.driver_enable", level(value != 0)}};
    case 6: return {{"inputs.probe", level(value != 0)}};
    case 11: return {{"path_tolerance_mm", tidy(value)}};
    case 24: return of_homing(machine, "home.latch_mm_s", "home.latch_deg_s", value / seconds_per_minute);
    case 25: return of_homing(machine, "home.seek_mm_s", "home.seek_deg_s", value / seconds_per_minute);
    case 27: return of_homing(machine, "home.pull_off_mm", "home.pull_off_deg", value);
    case 30: return {{"tool.max_rpm", tidy(value)}};
    default: break;
  }
  const AxisDescription* const axis = number >= 100 && number < 140 ? axis_of_setting(machine, number) : nullptr;
  if (axis == nullptr) return {};
  switch (number / 10) {
    case 11: return {{key(*axis, "max_velocity_mm_s", "max_velocity_deg_s"), tidy(value / seconds_per_minute)}};
    case 12: return {{key(*axis, "max_acceleration_mm_s2", "max_acceleration_deg_s2"), tidy(value)}};
    case 13: {
      // The end with the switch stays where it is.
      const bool keeps_high = axis->home && axis->home->toward_high;
      const double low = keeps_high ? axis->travel_high - value : axis->travel_low;
      return {{key(*axis, "travel_mm", "travel_deg"), std::vector<double>{tidy(low), tidy(low + value)}}};
    }
    default: return {};
  }
}

}  // namespace

MachineDescription KeptSettings::machine() const {
  return *described(text_);
}

std::optional<std::string> KeptSettings::with(int number, double value, std::string& reason) const {
  const MachineDescription before = machine();
  const bool is_scale = number / 10 == 10;
  const std::vector<Change> changes = changes_for(before, number, value);
  const AxisDescription* const axis = is_scale ? axis_of_setting(before, number) : nullptr;
  if (changes.empty() && axis == nullptr) {
    reason = "The machine file has no such setting";
    return {};
  }
  const auto after = axis != nullptr ? with_scale(text_, *axis, value) : changed(text_, changes);
  reason = "This value would make the machine file invalid";
  if (!after) return {};
  return has_setting(*described(*after), {}, number, value) ? after : std::nullopt;
}

}  // namespace passo
