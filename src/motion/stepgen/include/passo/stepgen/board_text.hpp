// Board items as text, one line each, for golden files and for people. Board items are the input of the wire protocol.
//
//   segment 200 events, 250.5 ticks, change 0.125, X +1 Y -0.40002 Z 0
//   outputs spindle clockwise 1000 rpm, flood
#pragma once

#include <string>

#include "passo/stepgen/step_generator.hpp"

namespace passo {

// The text ends with a newline. Increments are in steps per event; a positive increment counts the motor up.
std::string to_text(const BoardItem& item, const StepOptions& options);

}  // namespace passo
