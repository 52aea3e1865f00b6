#include "passo/activity/touchable.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "passo/activity/stage_options.hpp"

namespace passo {
namespace {

// In steps: the rounding error when millimetres become steps.
constexpr double rounding = 1e-6;

// In steps: no machine goes beyond this.
constexpr double far_away = 1e15;

// The box as ranges of motor steps.
TouchBody body_of(const TouchBox& box, const MachineDescription& machine) {
  TouchBody body;
  const Kinematics kinematics = kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const TouchBox::Range& range = box.ranges[axis.axis];
    const double factor = kinematics.rows()[m].steps.factor_of(axis.axis);
    const double low = std::max(range.low * std::abs(factor), -far_away);
    const double high = std::min(range.high * std::abs(factor), far_away);
    const auto first = static_cast<std::int64_t>(std::ceil(low - rounding));
    const auto last = static_cast<std::int64_t>(std::floor(high + rounding));
    body.motors[m] = factor < 0 ? TouchBody::Range{-last, -first} : TouchBody::Range{first, last};
  }
  return body;
}

TouchSurface body_of(const PlacedSurface& placed, const MachineDescription& machine) {
  constexpr std::array axes{Axis::x, Axis::y, Axis::z};
  std::array<TouchSurface::Along, 3> along;
  const Kinematics kinematics = kinematics_of(machine);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    along[i].zero = placed.zero[axes[i]];
    for (std::size_t m = 0; m < machine.axes.size(); ++m) {
      if (machine.axes[m].axis != axes[i]) continue;
      along[i].motor = m;
      along[i].steps_per_mm = kinematics.rows()[m].steps.factor_of(axes[i]);
    }
  }
  return {placed.surface, along};
}

}  // namespace

void add(FittedPlant& plant, const Touchable& thing, const MachineDescription& machine) {
  std::visit([&](const auto& body) { plant.add(body_of(body, machine)); }, thing);
}

}  // namespace passo
