// The motors that each key of the keypad moves. Follower boards and boards with a queue use the same keys. Portable.
#pragma once

#include <stdint.h>

#include "passo/firmware/keypad.hpp"

namespace passo {

// A key moves the axes in `steps`; those in `down` move in the negative direction.
struct KeyMove {
  uint8_t steps = 0;
  uint8_t down = 0;
};
struct JogTable {
  KeyMove of[no_key + 1] = {};
};
constexpr JogTable jog_table() {
  constexpr uint8_t x = 1;
  constexpr uint8_t y = 2;
  constexpr uint8_t z = 4;
  constexpr uint8_t both = x | y;
  constexpr KeyMove jogs[keypad_rows][keypad_columns] = {
      {{both, x}, {y, 0}, {both, 0}},     // 1 2 3
      {{x, x}, {z, 0}, {x, 0}},           // 4 5 6
      {{both, both}, {y, y}, {both, y}},  // 7 8 9
      {{}, {z, z}, {}},                   // * 0 #
  };
  JogTable table;
  for (uint8_t row = 0; row < keypad_rows; ++row) {
    for (uint8_t column = 0; column < keypad_columns; ++column) table.of[key_at(row, column)] = jogs[row][column];
  }
  return table;
}
inline constexpr JogTable jog_of_key = jog_table();

}  // namespace passo
