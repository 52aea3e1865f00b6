// What the picture of a ramp shows: every method that applies, played, beside the ideal.
#pragma once

#include <string>

#include "passo/ramp/ramp_sequence.hpp"
#include "passo/report/ramp_picture.hpp"

namespace passo {

// The request's method is one of those shown; where it does not apply, that is the error. The exact method is shown as
// a chip plays it, in whole ticks.
Result<RampScene, RampError> ramp_scene(const RampRequest& request);

std::string ramp_title(const RampRequest& request);
std::string ramp_words(const RampRequest& request);

}  // namespace passo
