// The pins of an Arduino Uno (ATmega328P) with a CNC Shield V3. Portable.
#pragma once

#include "passo/chip/pin_map.hpp"

namespace passo {

// Steps are on D2 to D4, directions on D5 to D7: all on port D, whose two lowest bits are the serial port. While the
// serial port is on, values written to these bits reach no pin, so they serve as the flags.
inline constexpr PinMap<3> uno_cnc_shield = {
    .motor = {{.step = {'D', 2}, .direction = {'D', 5}, .enable = {'B', 0}},
              {.step = {'D', 3}, .direction = {'D', 6}, .enable = {'B', 0}},
              {.step = {'D', 4}, .direction = {'D', 7}, .enable = {'B', 0}}},
    .step_ports = {'D'},
    .flag_special = 1,
    .flag_stop = 2,
    // Recent shields have the Z limit on D12, and the spindle's speed on D11.
    .limits = {{'B', 1}, {'B', 2}, {'B', 4}},
    .probe = {'C', 5},
    .emergency_stop = {'C', 0},
    .feed_hold = {'C', 1},
    .cycle_start = {'C', 2},
    .spindle_pwm = {'B', 3},
    .spindle_direction = {'B', 5},
    .mist = {'C', 4},
    .flood = {'C', 3},
};
static_assert(uno_cnc_shield.without_conflict(), "a pin has two jobs");
static_assert(uno_cnc_shield.fits_the_interrupt());

}  // namespace passo
