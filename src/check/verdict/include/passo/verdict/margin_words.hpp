// What a MarginSpot means, in words: the cause and the cure.
#pragma once

#include <string>

#include "passo/verdict/margin_survey.hpp"

namespace passo {

// "Y needs 0.31 N·m at 1,420 steps/s, and has 0.28 to 0.40". Steps are full steps.
std::string cause_of(const MarginSpot& spot);
// "a <= 380 mm/s², or F <= 900", what would be safe. Empty for a safe spot.
std::string cure_of(const MarginSpot& spot);
// Whether no line needs more torque for its motion than there surely is: what is not safe are swings alone.
bool is_torque_enough(const MarginVerdict& margin);

}  // namespace passo
