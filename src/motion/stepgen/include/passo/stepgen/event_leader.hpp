// Which motor makes the events of a board, and how finely its steps are divided: the rules that the step generator
// follows, for all who want to know where events will come.
//
// The fastest motor leads. Its steps are divided by 2, 4, ... until events come no more seldom than the slow rate.
#pragma once

#include <cmath>

namespace passo::event_leader {

// Another motor must be faster by this factor before it leads.
inline constexpr double takeover = 1 + 1e-6;
// The rate of a stretch's events stays between these multiples of the slow rate. If the rate leaves the range, a new
// stretch begins with a finer or coarser grid.
inline constexpr double rate_before_finer = 0.5;
inline constexpr double rate_before_coarser = 4;
// The most events of one step.
inline constexpr int finest_division = 256;

// The square of the rate that a motor of this slope would have one step from here if the path sped up all the way: in
// places a second, of which one step has `step`. Close to a rest the present rate says little. This rate is useful
// there, and it is the same before and after a stop.
inline double rate_squared(double slope, double path_speed, double path_acceleration, double step) {
  const double speed = slope * path_speed;
  return speed * speed + 2 * std::fabs(path_acceleration) * slope * step;
}

}  // namespace passo::event_leader
