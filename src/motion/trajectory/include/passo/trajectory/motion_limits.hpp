// MotionLimits: what the axes can do, and motors that axes share. A limit of 0 or less does not limit (the axis does
// not exist).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/kinematics/axis_row.hpp"
#include "passo/trajectory/acceleration_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Beyond any machine, in mm and seconds. Keeps a segment finite that no axis limits.
inline constexpr double fastest = 1e6;
inline constexpr double strongest = 1e9;
inline constexpr double sharpest = 1e13;

// What a motor can do that turns for several axes. Its place is the row's sum, in millimetres.
struct RowLimits {
  AxisRow row;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  AccelerationCurve falling = {};
};

// A machine has no more motors that axes share.
inline constexpr std::size_t most_limited_rows = 4;

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
  PerAxis<MmPerSecond3> jerk;
  // The acceleration that a motor has left at the axis's speed; it limits beside the constant. Empty: the constant
  // alone.
  PerAxis<AccelerationCurve> falling;
  // The velocity to which a motor jumps from rest, and from which it stops at once, without losing a step. 0: none.
  // Planning with limited jerk does not use it.
  PerAxis<MmPerSecond> start_stop;
  // Beside those of the axes, and kept at the same time: at most most_limited_rows. None on a machine with a motor for
  // each axis.
  std::vector<RowLimits> rows = {};

  // Of some axis at least.
  bool limits_jerk() const {
    const auto is_limit = [](MmPerSecond3 limit) { return limit > MmPerSecond3(0); };
    return std::ranges::any_of(jerk.values, is_limit) || std::ranges::any_of(rows, is_limit, &RowLimits::jerk);
  }
};

// The highest speed along a path, at most `speed`, at which nothing with such slopes is faster than it can be.
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
