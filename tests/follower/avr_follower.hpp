// The follower's image for an Uno or a Mega, in simavr: its pins as lines and outputs of a FollowerVector.
#pragma once

#include <string>
#include <vector>

#include "follower/vector.hpp"

#include "passo/chip/follower_pins.hpp"

namespace passo {

struct AvrBoard {
  std::string name;
  std::string mcu;
  const FollowerPins* pins = nullptr;
  // Where its images lie, less "_two_on.elf".
  std::string images;
};

FollowerRun run_on_avr(const AvrBoard& board, const FollowerVector& vector);

}  // namespace passo
