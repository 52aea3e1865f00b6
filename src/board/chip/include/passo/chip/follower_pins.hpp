// FollowerPins: the follower's pins on an ATmega board, as data that is checked at compile time.
//
// The clock and direction signals are on one port, as on the first control board, so that one read samples all of them.
// Portable.
#pragma once

#include <stdint.h>

#include "passo/chip/pin.hpp"
#include "passo/firmware/follower.hpp"

namespace passo {

struct FollowerPins {
  char lines = 0;  // the port with the clocks on bits 0, 1, 2 and the directions on 3, 4, 5
  Pin relay_line = {};
  Pin windings[follower_axes][4] = {};  // F1 to F4 of X, Y, Z
  Pin relay = {};
  Pin relay_indicator = {};
  Pin automatic_indicator = {};
  Pin manual_indicator = {};
  Pin rows[keypad_rows] = {};  // all of them, on one port with the columns, or none
  Pin columns[keypad_columns] = {};
  Pin tool_button = {};

  constexpr bool has_keypad() const { return rows[0].exists(); }

  // Calls visit(pin) for every pin except the clock and direction inputs.
  template <class Visit>
  constexpr void each(Visit visit) const {
    each_output(visit);
    each_pulled_up(visit);
    for (const Pin pin : columns) visit(pin);
    visit(relay_line);
  }
  template <class Visit>
  constexpr void each_output(Visit visit) const {
    for (const auto& motor : windings) {
      for (const Pin pin : motor) visit(pin);
    }
    visit(relay);
    visit(relay_indicator);
    visit(automatic_indicator);
    visit(manual_indicator);
  }
  template <class Visit>
  constexpr void each_pulled_up(Visit visit) const {
    for (const Pin pin : rows) visit(pin);
    visit(tool_button);
  }
  constexpr uint8_t outputs_on(char port) const {
    uint8_t mask = 0;
    each_output([&](Pin pin) { mask = static_cast<uint8_t>(mask | (pin.port == port ? pin.mask() : 0)); });
    return mask;
  }
  constexpr uint8_t pulled_up_on(char port) const {
    uint8_t mask = 0;
    each_pulled_up([&](Pin pin) { mask = static_cast<uint8_t>(mask | (pin.port == port ? pin.mask() : 0)); });
    return mask;
  }

  constexpr bool without_conflict() const {
    bool conflict = false;
    each([&](Pin one) {
      uint8_t jobs = one.port == lines && one.bit < 6 ? 1 : 0;
      each([&](Pin other) { jobs = static_cast<uint8_t>(jobs + (one == other ? 1 : 0)); });
      if (one.exists() && jobs != 1) conflict = true;
    });
    return !conflict;
  }

  constexpr bool keypad_on_one_port() const {
    bool same = true;
    for (const Pin pin : rows) same = same && pin.port == rows[0].port;
    for (const Pin pin : columns) same = same && pin.port == rows[0].port;
    return same;
  }

  // The bits of the motor's pins on `port` for a pattern of its windings.
  constexpr uint8_t winding_bits(uint8_t axis, char port, uint8_t pattern) const {
    uint8_t bits = 0;
    for (uint8_t f = 0; f < 4; ++f) {
      const Pin pin = windings[axis][f];
      if ((pattern >> f & 1) != 0 && pin.port == port) bits = static_cast<uint8_t>(bits | pin.mask());
    }
    return bits;
  }
};

// Arduino Uno (ATmega328P): all of its twenty pins are used, so there is no keypad. D0, D1 and D13 drive windings,
// because the boot loader sets D1 and blinks D13. That moves no motor, but it would switch a relay.
inline constexpr FollowerPins uno_follower = {
    .lines = 'C',                                            // A0 to A5
    .relay_line = {'B', 4},                                  // D12
    .windings = {{{'D', 4}, {'D', 5}, {'D', 6}, {'D', 7}},   // D4 to D7
                 {{'D', 0}, {'D', 1}, {'D', 2}, {'D', 3}},   // D0 to D3
                 {{'B', 1}, {'B', 2}, {'B', 3}, {'B', 5}}},  // D9, D10, D11, D13
    .relay = {'B', 0},                                       // D8
};
static_assert(uno_follower.without_conflict(), "a pin has two jobs");
static_assert(uno_follower.keypad_on_one_port());

// Arduino Mega (ATmega2560).
inline constexpr FollowerPins mega_follower = {
    .lines = 'F',                                            // A0 to A5
    .relay_line = {'D', 7},                                  // D38
    .windings = {{{'A', 0}, {'A', 1}, {'A', 2}, {'A', 3}},   // D22 to D25
                 {{'A', 4}, {'A', 5}, {'A', 6}, {'A', 7}},   // D26 to D29
                 {{'C', 7}, {'C', 6}, {'C', 5}, {'C', 4}}},  // D30 to D33
    .relay = {'C', 3},                                       // D34
    .relay_indicator = {'C', 2},                             // D35
    .automatic_indicator = {'C', 1},                         // D36
    .manual_indicator = {'C', 0},                            // D37
    .rows = {{'L', 7}, {'L', 6}, {'L', 5}, {'L', 4}},        // D42 to D45
    .columns = {{'L', 3}, {'L', 2}, {'L', 1}},               // D46 to D48
    .tool_button = {'L', 0},                                 // D49
};
static_assert(mega_follower.without_conflict(), "a pin has two jobs");
static_assert(mega_follower.keypad_on_one_port());

}  // namespace passo
