// cycle_text: the G-code of a probing cycle whose values are good. Private to probing/.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/probing/probing_cycle.hpp"

namespace passo {

// The way of a touch along X or Y.
struct TouchWay {
  char axis = 'X';
  int sign = 1;
};
// "x+" and the like. Nothing: no such way.
std::optional<TouchWay> way_of(std::string_view side);

// The ways in which the two sides at a corner are touched.
struct CornerWays {
  int x = 1;
  int y = 1;
};
// "front-left" and the like.
std::optional<CornerWays> corner_of(std::string_view side);

std::string cycle_text(const ProbingCycle& cycle);

}  // namespace passo
