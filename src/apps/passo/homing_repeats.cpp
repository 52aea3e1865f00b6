#include "homing_repeats.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

const HomedAxis* find(const HomingReport& report, Axis axis) {
  const auto found = std::ranges::find(report.axes, axis, &HomedAxis::axis);
  return found == report.axes.end() ? nullptr : &*found;
}

}  // namespace

std::vector<AxisRepeats> repeats_of(const std::vector<HomingReport>& reports, const MachineDescription& machine) {
  std::vector<AxisRepeats> all;
  for (const AxisDescription& axis : machine.axes) {
    const auto steps = [&](double value) { return std::llround(value * axis.steps_per_unit); };
    std::int64_t place = 0;
    std::int64_t sum = 0;
    std::int64_t low = 0;
    std::int64_t high = 0;
    bool whole = !reports.empty() && axis.home.has_value();
    const HomedAxis* before = nullptr;
    for (const HomingReport& report : reports) {
      const HomedAxis* const now = find(report, axis.axis);
      whole = whole && now != nullptr;
      if (!whole) break;
      // Each homing makes its own place the true one. So the differences from one to the next add up.
      if (before != nullptr) place += steps(before->place) + steps(now->way) - steps(axis.home->switch_at);
      before = now;
      sum += place;
      low = std::min(low, place);
      high = std::max(high, place);
    }
    if (!whole) continue;
    const double step = 1000 / axis.steps_per_unit;
    all.push_back({.axis = axis.axis,
                   .mean = static_cast<double>(sum) / static_cast<double>(reports.size()) * step,
                   .spread = static_cast<double>(high - low) * step,
                   .spread_steps = high - low});
  }
  return all;
}

std::string words_of(const AxisRepeats& repeats) {
  // No minus sign before a zero.
  const auto rounded = [](double value) { return std::round(value * 10) / 10 + 0.0; };
  return fmt::format("{}: the mean place is {:.1f} {unit} from the first, the spread {:.1f} {unit} ({} step{})",
                     letter_of(repeats.axis), rounded(repeats.mean), rounded(repeats.spread), repeats.spread_steps,
                     repeats.spread_steps == 1 ? "" : "s", fmt::arg("unit", is_rotary(repeats.axis) ? "mdeg" : "um"));
}

}  // namespace passo
