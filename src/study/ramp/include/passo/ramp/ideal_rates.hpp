// The ideal rate of constant acceleration over time, as a polyline: acceleration, cruise, deceleration. The output of a
// method is compared with it.
#pragma once

#include <vector>

#include "passo/ramp/ramp_sequence.hpp"

namespace passo {

struct IdealRate {
  double time = 0;  // s
  double rate = 0;  // steps/s
};

// Returns the corners of the polyline. `duration`: of the whole ramp or move, in seconds. The request must not have a
// jerk limit.
std::vector<IdealRate> ideal_rates(const RampRequest& request, double duration);

}  // namespace passo
