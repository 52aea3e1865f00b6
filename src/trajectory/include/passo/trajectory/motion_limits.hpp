// MotionLimits: what the axes can do. A limit of 0 or less does not limit (the axis does not exist).
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/trajectory/acceleration_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
  PerAxis<MmPerSecond3> jerk;
  // Beside the constant, what a motor has left at the axis's speed. Empty: the constant alone.
  PerAxis<AccelerationCurve> falling;
};

}  // namespace passo
