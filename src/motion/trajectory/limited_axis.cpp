#include "limited_axis.hpp"

#include <cassert>

#include "arithmetic.hpp"

namespace passo {
namespace {

double limit_or_infinity(double limit) {
  return limit > 0 ? limit : infinity;
}

}  // namespace

std::vector<LimitedAxis> axes_with_limits(const MotionLimits& limits) {
  std::vector<LimitedAxis> axes;
  const auto add = [&](const AxisRow& row, MmPerSecond velocity, MmPerSecond2 acceleration, MmPerSecond3 jerk,
                       const AccelerationCurve& falling) {
    const LimitedAxis axis{.row = row,
                           .velocity = limit_or_infinity(velocity.value()),
                           .acceleration = limit_or_infinity(acceleration.value()),
                           .jerk = limit_or_infinity(jerk.value()),
                           .falling = falling.empty() ? nullptr : &falling};
    if (std::isfinite(axis.velocity) || std::isfinite(axis.acceleration) || std::isfinite(axis.jerk)) {
      axes.push_back(axis);
    }
  };
  for (const Axis axis : all_axes) {
    add({axis, 1}, limits.velocity[axis], limits.acceleration[axis], limits.jerk[axis], limits.falling[axis]);
  }
  assert(limits.rows.size() <= most_limited_rows);
  for (const RowLimits& own : limits.rows) add(own.row, own.velocity, own.acceleration, own.jerk, own.falling);
  return axes;
}

// Where the limit falls, it is the highest of the lines. Each line gives a speed up to which it allows the turn.
double LimitedAxis::turning_cap(double slope, double bend, double share) const {
  const double constant = bend > 0 ? share * acceleration / bend : infinity;
  if (!falls_at(slope * slope * constant)) return constant;
  double most = 0;
  for (const AccelerationCurve::Line& line : falling->lines()) {
    most = std::max(most, share * line.at_rest / (bend + share * line.fall * slope * slope));
  }
  return std::min(most, constant);
}

}  // namespace passo
