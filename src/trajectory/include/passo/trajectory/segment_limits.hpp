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

struct Junction {
  MmPerSecond speed{0};   // at most; infinite where the path goes straight on. The segments' own limits come on top.
  bool straight = false;  // two lines in one direction
};
// `straight_before`: the way up to the junction that leads in one direction, the segment `before` and lines before it.
Junction junction_between(const Segment& before, const Segment& after, Mm straight_before, const MotionLimits& limits);

}  // namespace passo
