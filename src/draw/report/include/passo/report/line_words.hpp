// What a line to the board costs, in words.
#pragma once

#include <string>

#include "passo/units/units.hpp"

namespace passo {

// Less than this is no cost: it is rounding.
inline constexpr Seconds least_cost_of_line{0.0005};

// "1.2 %", or "under 0.1 %".
std::string percent_of(Seconds part, Seconds whole);

}  // namespace passo
