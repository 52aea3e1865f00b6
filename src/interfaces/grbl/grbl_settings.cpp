#include "passo/grbl/grbl_settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_axes = 6;

const AxisDescription* find_axis(const MachineDescription& machine, Axis axis) {
  const auto found = std::ranges::find(machine.axes, axis, &AxisDescription::axis);
  return found == machine.axes.end() ? nullptr : &*found;
}

std::string decimal(double value) {
  return fmt::format("{:.3f}", value);
}

// A bit for each axis of the reports for which `is` holds.
template <class Is>
unsigned mask_of(const MachineDescription& machine, const Is& is) {
  unsigned mask = 0;
  const std::vector<Axis> axes = grbl_axes_of(machine);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisDescription* axis = find_axis(machine, axes[i]);
    if (axis != nullptr && is(*axis)) mask |= 1U << i;
  }
  return mask;
}

// The value of the first axis that is homed.
template <class Value>
double of_homing(const MachineDescription& machine, const Value& value) {
  for (const AxisDescription& axis : machine.axes) {
    if (axis.home) return value(*axis.home);
  }
  return 0;
}

}  // namespace

std::vector<Axis> grbl_axes_of(const MachineDescription& machine) {
  std::vector<Axis> axes = {Axis::x, Axis::y, Axis::z};
  for (const Axis axis : all_axes) {
    if (index_of(axis) < 3 || find_axis(machine, axis) == nullptr) continue;
    if (axes.size() < most_axes) axes.push_back(axis);
  }
  return axes;
}

std::string more_grbl_axes(const MachineDescription& machine) {
  std::string letters;
  for (const Axis axis : grbl_axes_of(machine)) {
    if (index_of(axis) >= 3) letters += letter_of(axis);
  }
  return letters;
}

const AxisDescription* axis_of_setting(const MachineDescription& machine, int number) {
  const std::vector<Axis> axes = grbl_axes_of(machine);
  const auto index = static_cast<std::size_t>(number % 10);
  return index < axes.size() ? find_axis(machine, axes[index]) : nullptr;
}

std::vector<GrblSetting> grbl_settings(const MachineDescription& machine, const GrblChoices& choices) {
  const auto bit = [](bool on) { return std::string(on ? "1" : "0"); };
  const auto number = [](unsigned value) { return fmt::format("{}", value); };
  const bool homes = !machine.homing.empty();
  const PinsDescription& pins = machine.pins;
  std::vector<GrblSetting> all = {
      {0, fmt::format("{:.0f}", std::max(machine.board.step_pulse.value() * 1e6, 1.0))},
      {1, pins.drivers_off_after > Seconds(0) ? "254" : "255"},
      {2, number(pins.step_low ? mask_of(machine, [](const AxisDescription&) { return true; }) : 0)},
      {3, number(mask_of(machine, [](const AxisDescription& axis) { return axis.inverted; }))},
      {4, bit(pins.driver_enable_high)},
      {5, bit(pins.limits_high[0])},
      {6, bit(pins.probe_high)},
      {10, number(choices.status_mask)},
      {11, decimal(machine.path_tolerance.value())},
      {12, "0.002"},
      {13, bit(choices.inches)},
      {20, "1"},
      {21, bit(homes)},
      {22, bit(homes)},
      {23, number(mask_of(machine, [](const AxisDescription& axis) { return axis.home && !axis.home->toward_high; }))},
      {24, decimal(of_homing(machine,
                             [](const HomeDescription& home) { return home.latch.value() * seconds_per_minute; }))},
      {25,
       decimal(of_homing(machine, [](const HomeDescription& home) { return home.seek.value() * seconds_per_minute; }))},
      {26, "25"},
      {27, decimal(of_homing(machine, [](const HomeDescription& home) { return home.pull_off; }))},
      {30, fmt::format("{:.0f}", machine.tool.highest_rpm > 0 ? machine.tool.highest_rpm : 1000)},
      {31, "0"},
      {32, "0"},
  };
  struct Family {
    int first;
    double (*value)(const AxisDescription&);
  };
  static constexpr Family families[] = {
      {100, [](const AxisDescription& axis) { return axis.steps_per_unit; }},
      {110, [](const AxisDescription& axis) { return axis.velocity.value() * seconds_per_minute; }},
      {120, [](const AxisDescription& axis) { return axis.acceleration.value(); }},
      {130, [](const AxisDescription& axis) { return axis.travel_high - axis.travel_low; }},
  };
  const std::vector<Axis> axes = grbl_axes_of(machine);
  for (const Family& family : families) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const AxisDescription* axis = find_axis(machine, axes[i]);
      all.push_back({family.first + static_cast<int>(i), decimal(axis != nullptr ? family.value(*axis) : 0)});
    }
  }
  return all;
}

bool has_setting(const MachineDescription& machine, const GrblChoices& choices, int number, double value) {
  constexpr double shown = 0.0006;  // three decimals
  for (const GrblSetting& setting : grbl_settings(machine, choices)) {
    if (setting.number == number) return std::abs(std::stod(setting.value) - value) <= shown;
  }
  return false;
}

}  // namespace passo
