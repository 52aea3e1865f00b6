// What the picture of a ramp shows: every method that applies, as played, beside the ideal. With a limit of jerk the
// picture shows the ramp with jerk beside constant acceleration.
#pragma once

#include <string>

#include "passo/ramp/ramp_sequence.hpp"
#include "passo/report/ramp_picture.hpp"

namespace passo {

// The request's method is always among the methods shown. If that method does not apply, returns the error. The exact
// method is shown as a chip plays it, in whole ticks.
Result<RampScene, RampError> ramp_scene(const RampRequest& request);

std::string ramp_title(const RampRequest& request);
std::string ramp_words(const RampRequest& request);

}  // namespace passo
