// The intended rate of constant acceleration over time: a straight line up, a level one, a straight line down. What a
// method plays is compared with it.
#pragma once

#include <vector>

#include "passo/ramp/ramp_sequence.hpp"

namespace passo {

struct IdealRate {
  double time = 0;  // s
  double rate = 0;  // steps a second
};

// The corners of the line. `duration`: of the whole ramp or move, in seconds. The request has no bound on the jerk.
std::vector<IdealRate> ideal_rates(const RampRequest& request, double duration);

}  // namespace passo
