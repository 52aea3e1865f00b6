// Describes a MarginSpot as text: the cause and the remedy.
#pragma once

#include <string>

#include "passo/verdict/margin_survey.hpp"

namespace passo {

// Returns e.g. "Y needs 0.31 N·m at 1,420 steps/s, and has 0.28 to 0.40". Steps are full steps.
std::string cause_of(const MarginSpot& spot);
// Returns a safe limit, e.g. "a <= 380 mm/s², or F <= 900". Empty for a safe spot.
std::string cure_of(const MarginSpot& spot);
// Returns whether no line needs more than the guaranteed torque for its motion, so that only oscillations are unsafe.
bool is_torque_enough(const MarginVerdict& margin);

}  // namespace passo
