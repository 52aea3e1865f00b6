// LimitedAxis: what one axis, or a motor that axes share, can do, as the laws of speed need it. Private to trajectory/.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/kinematics/axis_row.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// A row with at least one limit: of one axis, or the sum of axes that a motor turns for. The path demands of a row what
// the row makes of the path's slope and bend. A limit that it lacks is infinity.
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
inline constexpr std::size_t most_limited_axes = axis_count + most_limited_rows;
// The result refers to `limits`, which must outlive it.
std::vector<LimitedAxis> axes_with_limits(const MotionLimits& limits);

}  // namespace passo
