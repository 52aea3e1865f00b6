// cycle_text: the G-code of a validated probing cycle. Private to probing/.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/probing/probing_cycle.hpp"

namespace passo {

// The direction of a touch along X or Y.
struct TouchWay {
  char axis = 'X';
  int sign = 1;
};
// Parses "x+", "x-", "y+" or "y-". Nothing if it is not a direction.
std::optional<TouchWay> way_of(std::string_view side);

// The directions in which the two sides of a corner are touched.
struct CornerWays {
  int x = 1;
  int y = 1;
};
// Parses "front-left" and the other corners.
std::optional<CornerWays> corner_of(std::string_view side);

std::string cycle_text(const ProbingCycle& cycle);

}  // namespace passo
