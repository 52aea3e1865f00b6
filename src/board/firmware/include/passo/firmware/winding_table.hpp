// WindingTable: the windings of a motor that carry current at each step.
//
// A motor has four outputs F1 to F4, wired to its windings in their order of rotation: Ph1, Ph3, Ph2, Ph4. A pattern
// has F1 in bit 0. The next entry of the table is one step up, the previous entry is one step down.
//   two on   1100 0110 0011 1001            1.4 times the torque of one winding, for twice the power
//   wave     1000 0100 0010 0001            one winding: half the power
//   half     alternates the two, eight patterns: twice as many steps per revolution, uneven torque
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

enum class DriveMode : uint8_t { two_on, wave, half_step };

struct WindingTable {
  uint8_t patterns[8] = {};
  uint8_t mask = 0;  // the index is the motor's step position, masked with this

  constexpr uint8_t at(uint8_t place) const { return patterns[place & mask]; }
};

constexpr WindingTable winding_table(DriveMode drive) {
  switch (drive) {
    case DriveMode::two_on: return {.patterns = {0b0011, 0b0110, 0b1100, 0b1001}, .mask = 3};
    case DriveMode::wave: return {.patterns = {0b0001, 0b0010, 0b0100, 0b1000}, .mask = 3};
    case DriveMode::half_step:
      return {.patterns = {0b0011, 0b0010, 0b0110, 0b0100, 0b1100, 0b1000, 0b1001, 0b0001}, .mask = 7};
  }
  return {};
}

}  // namespace passo
