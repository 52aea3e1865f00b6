#include "passo/activity/homing_repeats.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/base/counted.hpp"

namespace passo {

void HomingRepeats::record(const std::vector<HomedAxis>& homed, const std::optional<Point>& stood) {
  if (!stood) {
    homings_ = 0;
    places_.clear();
  }
  ++homings_;
  const Kinematics kinematics = kinematics_of(machine_);
  for (const HomedAxis& one : homed) {
    const auto axis = std::ranges::find(machine_.axes, one.axis, &AxisDescription::axis);
    if (axis == machine_.axes.end() || !axis->home) continue;
    auto found = std::ranges::find(places_, one.axis, &Places::axis);
    if (found == places_.end()) {
      if (homings_ > 1) continue;
      found = places_.insert(places_.end(), Places{.axis = one.axis});
    }
    ++found->homings;
    if (!stood) continue;
    const double steps_per_unit = kinematics.steps_per_unit(one.axis);
    const auto steps = [&](double value) { return std::llround(value * steps_per_unit); };
    // Each homing makes its own place the true one. So the differences from one to the next add up.
    found->last = steps((*stood)[one.axis]) + steps(one.way) - steps(axis->home->switch_at);
    found->place += found->last;
    found->sum += found->place;
    found->low = std::min(found->low, found->place);
    found->high = std::max(found->high, found->place);
  }
}

std::vector<AxisRepeats> HomingRepeats::axes() const {
  std::vector<AxisRepeats> all;
  const Kinematics kinematics = kinematics_of(machine_);
  for (const AxisDescription& axis : machine_.axes) {
    const auto found = std::ranges::find(places_, axis.axis, &Places::axis);
    if (found == places_.end() || found->homings != homings_) continue;
    const double step = 1000 / kinematics.steps_per_unit(axis.axis);
    all.push_back({.axis = axis.axis,
                   .homings = found->homings,
                   .last = static_cast<double>(found->last) * step,
                   .mean = static_cast<double>(found->sum) / found->homings * step,
                   .spread = static_cast<double>(found->high - found->low) * step,
                   .spread_steps = found->high - found->low});
  }
  return all;
}

std::string describe(const AxisRepeats& repeats) {
  // No minus sign before a zero.
  const auto rounded = [](double value) { return std::round(value * 10) / 10 + 0.0; };
  return fmt::format("{}: the mean position is {:.1f} {unit} from the first, the spread {:.1f} {unit} ({})",
                     letter_of(repeats.axis), rounded(repeats.mean), rounded(repeats.spread),
                     counted(repeats.spread_steps, "step"), fmt::arg("unit", is_rotary(repeats.axis) ? "mdeg" : "um"));
}

}  // namespace passo
