// The fastest motion between two stops along a straight line, in closed form. Private to trajectory/.
//
//   acceleration  __                     Seven phases at most: the acceleration rises, is constant, falls; constant
//                /  \________            speed; the same for deceleration. A short distance omits some phases.
//                            \__/
//
// With start-stop velocities the motion begins and ends at a speed above 0, still without acceleration.
//
// Source: the closed forms for limited jerk, for instance L. Biagiotti, C. Melchiorri, "Trajectory Planning for
// Automatic Machines and Robots" (2008), 3.4.
#pragma once

#include "passo/trajectory/phase.hpp"

namespace passo {

// The limits of the axes along the line; all above 0.
struct PathLimits {
  double speed = 0;         // mm/s
  double acceleration = 0;  // mm/s²
  double jerk = 0;          // mm/s³
};

// The way from stop to stop: positions on the segment's curve, in mm, from < to. The motors may jump to the speed
// `entry` at the first stop, and from `exit` at the second (mm/s). Both may be lower.
struct WayBetweenStops {
  double from = 0;
  double to = 0;
  double entry = 0;
  double exit = 0;
};
// Adds the phases of that way to an empty move.
void add_rest_to_rest(const WayBetweenStops& way, const PathLimits& limits, PlannedMove& move);

}  // namespace passo
