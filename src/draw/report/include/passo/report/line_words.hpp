// Describes the cost of a serial link as text.
#pragma once

#include <string>

#include "passo/units/units.hpp"

namespace passo {

// A smaller cost is a rounding error and is ignored.
inline constexpr Seconds least_cost_of_line{0.0005};

// Returns e.g. "1.2 %", or "under 0.1 %".
std::string percent_of(Seconds part, Seconds whole);

}  // namespace passo
