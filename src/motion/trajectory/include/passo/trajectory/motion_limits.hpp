// MotionLimits: the limits of the axes, and of motors that axes share. A limit of 0 or less means no limit (the axis
// does not exist).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/kinematics/axis_row.hpp"
#include "passo/trajectory/acceleration_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// A speed beyond that of any machine, in mm/s, for segments that no axis limits.
inline constexpr double fastest = 1e6;
inline constexpr double strongest = 1e9;
inline constexpr double sharpest = 1e13;

// The limits of a motor that moves several axes. Its position is the sum of the row, in millimetres.
struct RowLimits {
  AxisRow row;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  AccelerationCurve falling = {};
};

// The maximum number of motors that axes share on one machine.
inline constexpr std::size_t most_limited_rows = 4;

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
  PerAxis<MmPerSecond3> jerk;
  // The acceleration that a motor can give at the axis' speed, in addition to the constant limit. Empty: only the
  // constant limit.
  PerAxis<AccelerationCurve> falling;
  // The velocity to which a motor can jump from standstill, and from which it can stop instantly, without losing a
  // step. 0: none. Jerk limits hold above it.
  PerAxis<MmPerSecond> start_stop;
  // Limits in addition to those of the axes, at most most_limited_rows. None on a machine with a motor for each axis.
  std::vector<RowLimits> rows = {};

  // Whether at least one axis has a jerk limit.
  bool limits_jerk() const {
    const auto is_limit = [](MmPerSecond3 limit) { return limit > MmPerSecond3(0); };
    return std::ranges::any_of(jerk.values, is_limit) || std::ranges::any_of(rows, is_limit, &RowLimits::jerk);
  }
};

// The highest speed along a path, at most `speed`, at which no axis or shared motor exceeds its velocity. `slopes`: of
// the axes per unit of the path.
inline double speed_within(const Point& slopes, double speed, const MotionLimits& limits) {
  for (const Axis axis : all_axes) {
    if (slopes[axis] > 0) speed = std::min(speed, limits.velocity[axis].value() / slopes[axis]);
  }
  for (const RowLimits& own : limits.rows) {
    const double most = own.row.most_of(slopes);
    if (most > 0 && own.velocity > MmPerSecond(0)) speed = std::min(speed, own.velocity.value() / most);
  }
  return speed;
}

}  // namespace passo
