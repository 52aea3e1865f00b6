// MotionLimits: what the axes can do. A limit of 0 or less does not limit (the axis does not exist).
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
  PerAxis<MmPerSecond3> jerk;
};

}  // namespace passo
