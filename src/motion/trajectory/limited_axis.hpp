// LimitedAxis: what one axis can do, as the laws of speed need it. Private to trajectory/.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// An axis with at least one limit. A limit that it lacks is infinity.
struct LimitedAxis {
  std::size_t index = 0;
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  const AccelerationCurve* falling = nullptr;  // below `acceleration` from its shoulder on; null for most axes

  bool limits_acceleration() const { return std::isfinite(acceleration); }
  // The limit of the acceleration at this square of the axis's speed.
  double acceleration_at(double w) const {
    return falls_at(w) ? std::min(acceleration, line_at(w).at(w)) : acceleration;
  }
  bool falls_at(double w) const { return falling != nullptr && w > falling->shoulder(); }
  // The line of the curve that is the highest at w. A line keeps to the curve at any speed. Only for an axis that
  // falls.
  const AccelerationCurve::Line& line_at(double w) const { return falling->lines()[falling->line_at(w)]; }
  // The square of the highest speed along the path at which bending alone takes no more than this share of the limit.
  double turning_cap(double slope, double bend, double share) const;
};
// The result refers to `limits`, which must outlive it.
std::vector<LimitedAxis> axes_with_limits(const MotionLimits& limits);

}  // namespace passo
