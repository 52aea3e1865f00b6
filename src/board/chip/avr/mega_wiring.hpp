// The chip-specific parts of the Mega's wiring: the timer for the spindle's PWM, and the flags that report a switch
// change.
#pragma once

#include "registers.hpp"
#include "switch_pins.hpp"

namespace passo::chip {

// The ports of an output action, and the PWM's duty and control registers.
inline constexpr char output_ports[] = {'H', 'B'};
using SpindleDuty = Ocr4cl;
using SpindleControl = Tccr4a;
inline constexpr uint8_t spindle_connected = 1 << 3 | 1 << 0;
inline constexpr uint8_t spindle_disconnected = 1 << 0;
inline constexpr uint8_t spindle_inverting = 1 << 2;

// Sets up PWM of 7.8 kHz at the spindle's pin, initially off: timer 4, eight bits, output C. The high byte goes through
// a register that nothing else of this timer writes, so it stays 0.
inline void prepare_spindle() {
  Ocr4ch::write(0);
  SpindleDuty::write(0);
  SpindleControl::write(spindle_disconnected);
  Tccr4b::write(1 << 3 | 1 << 1);
  Tccr2b::write(1 << 1);  // the clock of Wiring::microseconds()
}

// Sets the pins that stop the motors while `watched` is captured. `alarms`: inputs that are drive alarms.
inline void stop_on(uint16_t watched, uint16_t alarms = 0) {
  stops_b = stops_beside<'B'>(watched, alarms);
  stops_d = stops_beside<'D'>(watched, alarms);
  stops_e = stops_beside<'E'>(watched, alarms);
  stops_j = stops_beside<'J'>(watched, alarms);
}

// The interrupt reads these flags before every step; they have no interrupt of their own. Pins of ports D and E have
// one flag each, INT2 to INT5. Pins of B and J share one flag per port.
inline void watch_switches() {
  constexpr uint8_t b = pins.may_stop_on('B');
  constexpr uint8_t j = pins.may_stop_on('J');
  stop_on(input_probe);
  Eicra::write(1 << 6 | 1 << 4);  // any change of INT3 and INT2
  Eicrb::write(1 << 2 | 1 << 0);  // any change of INT5 and INT4
  Pcmsk0::write(static_cast<uint8_t>(b | pins.probe.mask()));
  Pcmsk1::write(static_cast<uint8_t>(j << 1));
  Pcifr::write(7);
  Eifr::write(0xff);
}
static_assert(pins.spindle_pwm == Pin{'H', 5} && pins.probe.port == 'B');
// The interrupt compares PCIFR with EIFR: they are equal only if both are 0, because no bit is used in both. PCIFR uses
// bits 0 and 1.
static_assert((pins.may_stop_on('D') & ~0x0c) == 0 && (pins.may_stop_on('E') & ~0x30) == 0);
static_assert(pins.may_stop_on('K') == 0 && pins.may_stop_on('A') == 0 && pins.may_stop_on('H') == 0);

}  // namespace passo::chip
