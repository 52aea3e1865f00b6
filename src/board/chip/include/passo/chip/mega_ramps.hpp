// The pins of an Arduino Mega (ATmega2560) with RAMPS 1.4. Portable.
#pragma once

#include "passo/chip/pin_map.hpp"

namespace passo {

// X, Y, Z, E0 and E1 have their drivers on RAMPS; the sixth motor is wired to AUX-2. The flags are two bits of port F
// that are connected to no motor; the interrupt never writes them to a pin.
inline constexpr PinMap<6> mega_ramps = {
    .motor = {{.step = {'F', 0}, .direction = {'F', 1}, .enable = {'D', 7}},   // A0, A1, D38
              {.step = {'F', 6}, .direction = {'F', 7}, .enable = {'F', 2}},   // A6, A7, A2
              {.step = {'L', 3}, .direction = {'L', 1}, .enable = {'K', 0}},   // D46, D48, A8
              {.step = {'A', 4}, .direction = {'A', 6}, .enable = {'A', 2}},   // D26, D28, D24
              {.step = {'C', 1}, .direction = {'C', 3}, .enable = {'C', 7}},   // D36, D34, D30
              {.step = {'L', 7}, .direction = {'L', 5}, .enable = {'G', 1}}},  // D42, D44, D40
    .step_ports = {'F', 'L', 'A', 'C'},
    .flag_special = 1 << 4,
    .flag_stop = 1 << 3,
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
    .keypad = {.rows = {{'L', 4}, {'L', 6}, {'G', 0}, {'G', 2}},             // D45, D43, D41, D39, in a row on AUX-4
               .columns = {{'C', 0}, {'C', 2}, {'C', 4}},                    // D37, D35, D33
               .tool_button = {'C', 6},                                      // D31
               .automatic_indicator = {'A', 7},                              // D29
               .manual_indicator = {'A', 5},                                 // D27
               // Sixteen microsteps: 0.5 rev/s from standstill, up to 5 rev/s.
               .speeds = {.start_stop = 1'600, .highest = 16'000, .acceleration = 32'000, .tap = 16}},
    .encoder = {.pulses = {'L', 2}, .index = {'L', 0}},  // D47 on AUX-4, D49 on AUX-3
};
static_assert(mega_ramps.without_conflict(), "a pin has two jobs");
static_assert(mega_ramps.fits_the_interrupt());
static_assert(mega_ramps.has_whole_keypad(16'000'000));
static_assert(mega_ramps.encoder.is_whole());

}  // namespace passo
