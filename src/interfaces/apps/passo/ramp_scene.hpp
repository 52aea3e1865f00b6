// The content of a ramp picture: every applicable method, as played, compared with the ideal. With a jerk limit the
// picture compares the ramp with jerk to constant acceleration.
#pragma once

#include <string>

#include "passo/ramp/ramp_sequence.hpp"
#include "passo/report/ramp_picture.hpp"

namespace passo {

// The request's method is always included. If that method is not applicable, returns the error. The exact method is
// shown as a chip plays it, in whole ticks.
Result<RampScene, RampError> ramp_scene(const RampRequest& request);

std::string ramp_title(const RampRequest& request);
std::string ramp_words(const RampRequest& request);

}  // namespace passo
