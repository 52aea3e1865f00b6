#include "passo/activity/touch_box.hpp"

#include <cmath>

namespace passo {
namespace {

// In steps: the rounding error when millimetres become steps.
constexpr double rounding = 1e-6;

// In steps: no machine goes beyond this.
constexpr double far_away = 1e15;

}  // namespace

TouchBody touch_body(const TouchBox& box, const MachineDescription& machine) {
  TouchBody body;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const TouchBox::Range& range = box.ranges[axis.axis];
    const double low = std::max(range.low * axis.steps_per_unit, -far_away);
    const double high = std::min(range.high * axis.steps_per_unit, far_away);
    const auto first = static_cast<std::int64_t>(std::ceil(low - rounding));
    const auto last = static_cast<std::int64_t>(std::floor(high + rounding));
    body.motors[m] = axis.inverted ? TouchBody::Range{-last, -first} : TouchBody::Range{first, last};
  }
  return body;
}

}  // namespace passo
