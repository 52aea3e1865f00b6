// MotionLimits: what the axes can do. A limit of 0 or less does not limit (the axis does not exist).
#pragma once

#include <algorithm>

#include "passo/geometry/axes.hpp"
#include "passo/trajectory/acceleration_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Beyond any machine, in mm and seconds. Keeps a segment finite that no axis limits.
inline constexpr double fastest = 1e6;
inline constexpr double strongest = 1e9;
inline constexpr double sharpest = 1e13;

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

  // Of some axis at least.
  bool limits_jerk() const {
    return std::any_of(jerk.values.begin(), jerk.values.end(),
                       [](MmPerSecond3 limit) { return limit > MmPerSecond3(0); });
  }
};

// The highest speed along a path, at most `speed`, at which no axis with such slopes is faster than it can be.
inline double speed_within(const Point& slopes, double speed, const MotionLimits& limits) {
  for (const Axis axis : all_axes) {
    if (slopes[axis] > 0) speed = std::min(speed, limits.velocity[axis].value() / slopes[axis]);
  }
  return speed;
}

}  // namespace passo
