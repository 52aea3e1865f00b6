// How fast a segment and a junction may be passed: the planner's model of the machine, without any planning.
//
// Every limit is one of an axis. An axis whose limit is 0 or less does not limit (it does not exist, and the path
// builder has said so).
#pragma once

#include "passo/path/segment.hpp"
#include "passo/trajectory/planner.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Held anywhere on the segment: speeds up to `speed` together with accelerations along the path up to `acceleration`
// keep every axis within its own velocity and acceleration.
struct SegmentLimits {
  MmPerSecond speed{0};
  MmPerSecond2 acceleration{0};
};
SegmentLimits segment_limits(const Segment& segment, const MotionLimits& limits);

// The fastest speed at which the junction from `before` to `after` may be passed, infinite where the path goes
// straight on. The segments' own limits come on top.
MmPerSecond junction_speed(const Segment& before, const Segment& after, const MotionLimits& limits);

}  // namespace passo
