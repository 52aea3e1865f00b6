// The options of BacklashCompensator for motors with screws.
#pragma once

#include "passo/path/backlash_compensator.hpp"
#include "passo/stepgen/step_generator.hpp"

namespace passo {

// `counts_items`: positions on the path are item numbers. A path that is started in its middle is counted from its
// beginning, where no axis had its backlash taken up for motion in the negative direction. `smoothness`: that of the
// path.
BacklashOptions backlash_options(const StepOptions& steps, Smoothness smoothness, bool counts_items);
bool takes_up_backlash(const StepOptions& steps);

}  // namespace passo
