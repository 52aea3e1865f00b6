// LimitedAxis: the limits of one axis, or of a motor that axes share, as used by the speed laws. Private to
// trajectory/.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/kinematics/axis_row.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// A row with at least one limit: one axis, or a motor driven by the sum of several axes. The row is applied to the
// path's slope and bend, which gives the row's demand. A missing limit is infinity.
struct LimitedAxis {
  AxisRow row;
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  const AccelerationCurve* falling = nullptr;  // below `acceleration` from its shoulder on; null for most axes

  // Limits of rotary axes are in degrees.
  bool is_rotary() const {
    return std::ranges::any_of(row.shares(), [](const AxisRow::Share& share) { return passo::is_rotary(share.axis); });
  }
  bool limits_acceleration() const { return std::isfinite(acceleration); }
  bool limits_jerk() const { return std::isfinite(jerk); }
  // The acceleration limit at this square of the axis' speed.
  double acceleration_at(double w) const {
    return falls_at(w) ? std::min(acceleration, line_at(w).at(w)) : acceleration;
  }
  bool falls_at(double w) const { return falling != nullptr && w > falling->shoulder(); }
  // The line of the curve that is the highest at w. A line is within the curve at any speed. Only for an axis whose
  // limit falls.
  const AccelerationCurve::Line& line_at(double w) const { return falling->lines()[falling->line_at(w)]; }
  // The square of the highest speed along the path at which bending alone uses at most this fraction of the limit.
  double turning_cap(double slope, double bend, double share) const;
};
inline constexpr std::size_t most_limited_axes = axis_count + most_limited_rows;
// The result refers to `limits`, which must outlive it.
std::vector<LimitedAxis> axes_with_limits(const MotionLimits& limits);

}  // namespace passo
