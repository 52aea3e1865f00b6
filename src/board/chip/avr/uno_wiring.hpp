// The chip-specific parts of the Uno's wiring: the timer for the spindle's PWM, and the flags that report a switch
// change.
#pragma once

#include "registers.hpp"
#include "switch_pins.hpp"

namespace passo::chip {

// The ports of an output action, and the PWM's duty and control registers.
inline constexpr char output_ports[] = {pins.switched_on('B') != 0 ? 'B' : 'C', 'C'};
using SpindleDuty = Ocr2a;
using SpindleControl = Tccr2a;
inline constexpr uint8_t spindle_connected = 1 << 7 | 1 << 1 | 1 << 0;
inline constexpr uint8_t spindle_disconnected = 1 << 1 | 1 << 0;
inline constexpr uint8_t spindle_inverting = 1 << 6;

// Sets up PWM of 7.8 kHz at the spindle's pin, initially off.
inline void prepare_spindle() {
  SpindleDuty::write(0);
  SpindleControl::write(spindle_disconnected);
  Tccr2b::write(1 << 1);
}

// Sets the pins that stop the motors while `watched` is captured. `alarms`: inputs that are drive alarms.
inline void stop_on(uint16_t watched, uint16_t alarms = 0) {
  stops_b = stops_beside<'B'>(watched, alarms);
  stops_c = stops_beside<'C'>(watched, alarms);
}

// The interrupt reads these flags before every step; they have no interrupt of their own.
inline void watch_switches() {
  constexpr uint8_t b = pins.may_stop_on('B');
  constexpr uint8_t c = pins.may_stop_on('C');
  stop_on(input_probe);
  Pcmsk0::write(b);
  Pcmsk1::write(static_cast<uint8_t>(c | pins.probe.mask()));
  Pcifr::write(7);
}
static_assert(!pins.spindle_pwm.exists() || pins.spindle_pwm == Pin{'B', 3});
static_assert(pins.probe.port == 'C' && pins.may_stop_on('D') == 0);

}  // namespace passo::chip
