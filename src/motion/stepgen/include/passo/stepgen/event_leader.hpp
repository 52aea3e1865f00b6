// The choice of the motor that makes the events of a board, and of the subdivision of its steps: the rules of the step
// generator, which other code uses to predict events.
//
// The fastest motor leads. Its steps are divided by 2, 4, ... until the event rate is at least the slow rate.
#pragma once

#include <cmath>

namespace passo::event_leader {

// Another motor must be faster by this factor before it leads.
inline constexpr double takeover = 1 + 1e-6;
// The event rate stays between these multiples of the slow rate. Outside this range, a finer or coarser division
// begins.
inline constexpr double rate_before_finer = 0.5;
inline constexpr double rate_before_coarser = 4;
// The largest number of events per step.
inline constexpr int finest_division = 256;

// Returns the square of the rate that a motor of this slope would have one step from here if the path accelerated until
// then, in units of which a step has `step`. Close to a stop point the current rate is of little use; this rate is
// meaningful there, and the same before and after a stop.
inline double rate_squared(double slope, double path_speed, double path_acceleration, double step) {
  const double speed = slope * path_speed;
  return speed * speed + 2 * std::fabs(path_acceleration) * slope * step;
}

}  // namespace passo::event_leader
