// The pins of an Arduino Uno (ATmega328P) that switches the windings of three motors itself. Portable.
#pragma once

#include "passo/chip/pin_map.hpp"

namespace passo {

// Twelve pins are windings, and two are the serial port. Port C has the switches and one relay. There are no buttons:
// they are in the user interface on the computer. The boot loader blinks D13: that moves no motor, but it would switch
// a relay.
inline constexpr PinMap<3> uno_windings = {
    .motor = {{.windings = {{'D', 4}, {'D', 5}, {'D', 6}, {'D', 7}}},   // D4 to D7
              {.windings = {{'B', 0}, {'B', 1}, {'B', 2}, {'B', 3}}},   // D8 to D11
              {.windings = {{'D', 2}, {'D', 3}, {'B', 4}, {'B', 5}}}},  // D2, D3, D12, D13
    .step_ports = {'D', 'B'},
    .limits = {{'C', 1}, {'C', 2}, {'C', 3}},  // A1, A2, A3
    .probe = {'C', 5},                         // A5
    .emergency_stop = {'C', 0},                // A0
    .spindle_relay = {'C', 4},                 // A4
};
static_assert(uno_windings.without_conflict(), "a pin has two jobs");
static_assert(uno_windings.fits_the_interrupt());

}  // namespace passo
