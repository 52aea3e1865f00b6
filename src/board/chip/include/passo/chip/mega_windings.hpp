// The pins of an Arduino Mega (ATmega2560) that switches the windings of four motors itself. Portable.
#pragma once

#include "passo/chip/pin_map.hpp"

namespace passo {

// The first three motors, the keypad and the indicators are wired as on the follower.
inline constexpr PinMap<4> mega_windings = {
    .motor = {{.windings = {{'A', 0}, {'A', 1}, {'A', 2}, {'A', 3}}},   // D22 to D25
              {.windings = {{'A', 4}, {'A', 5}, {'A', 6}, {'A', 7}}},   // D26 to D29
              {.windings = {{'C', 7}, {'C', 6}, {'C', 5}, {'C', 4}}},   // D30 to D33
              {.windings = {{'K', 0}, {'K', 1}, {'K', 2}, {'K', 3}}}},  // A8 to A11
    .step_ports = {'A', 'C', 'K'},
    .limits = {{'E', 5}, {'J', 1}, {'D', 3}, {'E', 4}, {'J', 0}, {'D', 2}},  // D3, D14, D18; D2, D15, D19
    .probe = {'B', 2},                                                       // D51
    .emergency_stop = {'B', 0},                                              // D53
    .feed_hold = {'B', 1},                                                   // D52
    .cycle_start = {'B', 3},                                                 // D50
    .spindle_pwm = {'H', 5},                                                 // D8
    .spindle_direction = {'H', 3},                                           // D6
    .spindle_relay = {'B', 5},                                               // D11
    .mist = {'H', 6},                                                        // D9
    .flood = {'B', 4},                                                       // D10
    .keypad = {.rows = {{'L', 7}, {'L', 6}, {'L', 5}, {'L', 4}},             // D42 to D45
               .columns = {{'L', 3}, {'L', 2}, {'L', 1}},                    // D46 to D48
               .tool_button = {'L', 0},                                      // D49
               .automatic_indicator = {'C', 1},                              // D36
               .manual_indicator = {'C', 0},                                 // D37
               // Half steps, 400 per revolution: 0.6 rev/s from standstill, up to 5 rev/s.
               .speeds = {.start_stop = 250, .highest = 2'000, .acceleration = 4'000, .tap = 1}},
};
static_assert(mega_windings.without_conflict(), "a pin has two jobs");
static_assert(mega_windings.fits_the_interrupt());
static_assert(mega_windings.has_whole_keypad(16'000'000));

}  // namespace passo
