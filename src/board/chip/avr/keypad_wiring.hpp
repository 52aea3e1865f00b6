// KeypadWiring: the keypad's pins, as the hardware interface that ManualMode needs.
#pragma once

#include "wiring.hpp"

namespace passo::chip {

class KeypadWiring {
 public:
  static uint8_t rows() {
    uint8_t down = 0;
#pragma clang loop unroll(full)
    for (uint8_t row = 0; row < keypad_rows; ++row) {
      if (Wiring::closed(pins.keypad.rows[row])) down = static_cast<uint8_t>(down | 1U << row);
    }
    return down;
  }
  // The output latches stay low: a pin drives its column low as an output, and floats as an input.
  static void draw_column(uint8_t column) {
#pragma clang loop unroll(full)
    for (uint8_t c = 0; c < keypad_columns; ++c) {
      const Pin pin = pins.keypad.columns[c];
      volatile uint8_t& drawn = Wiring::port_register(pin.port, 1);
      drawn = static_cast<uint8_t>(c == column ? drawn | pin.mask() : drawn & ~pin.mask());
    }
  }
  static bool tool_button() {
    return Wiring::closed(pins.keypad.tool_button);
  }
  static void indicators(bool automatic, bool manual) {
    Wiring::set(pins.keypad.automatic_indicator, automatic);
    Wiring::set(pins.keypad.manual_indicator, manual);
  }
};

}  // namespace passo::chip
