// The pins of a port that belong to each of the board's inputs, taken from its pin map.
#pragma once

#include "registers.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

// The levels of a port's pins while their switches are open.
#ifdef __AVR_ATmega2560__
inline constexpr char input_ports[] = {'B', 'D', 'E', 'J'};
[[gnu::always_inline]] inline uint8_t quiet_levels(char port) {
  return port == 'B' ? quiet_b : port == 'D' ? quiet_d : port == 'E' ? quiet_e : port == 'J' ? quiet_j : uint8_t{0xff};
}
[[gnu::always_inline]] inline void set_quiet_levels(char port, uint8_t levels) {
  if (port == 'B') quiet_b = levels;
  if (port == 'D') quiet_d = levels;
  if (port == 'E') quiet_e = levels;
  if (port == 'J') quiet_j = levels;
}
#else
inline constexpr char input_ports[] = {'B', 'C'};
[[gnu::always_inline]] inline uint8_t quiet_levels(char port) {
  return port == 'B' ? Ocr0b::read() : Eearl::read();
}
[[gnu::always_inline]] inline void set_quiet_levels(char port, uint8_t levels) {
  port == 'B' ? Ocr0b::write(levels) : Eearl::write(levels);
}
#endif

// The pins of a port whose switches are triggered.
[[gnu::always_inline]] inline uint8_t pins_that_are_on(char port) {
  return static_cast<uint8_t>(*reinterpret_cast<volatile uint8_t*>(port_registers(port)) ^ quiet_levels(port));
}

// The pins of limit switches on a port.
template <char port>
[[gnu::always_inline]] inline uint8_t pins_of(uint16_t limit) {
  uint8_t mask = 0;
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    const bool is_it = pins.limits[i].port == port && (limit & (input_limit << i)) != 0;
    if (is_it) mask = static_cast<uint8_t>(mask | pins.limits[i].mask());
  }
  return mask;
}

// The inputs that a host may configure as drive alarms.
inline constexpr uint16_t may_be_alarms = [] {
  uint16_t known = 0;
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    if (pins.limits[i].exists()) known |= static_cast<uint16_t>(input_limit << i);
  }
  if (pins.feed_hold.exists()) known |= input_hold;
  if (pins.cycle_start.exists()) known |= input_start;
  return known;
}();

// The pins of buttons on a port that are drive alarms.
template <char port>
[[gnu::always_inline]] inline uint8_t buttons_of(uint16_t alarms) {
  uint8_t mask = 0;
  if (pins.feed_hold.port == port && (alarms & input_hold) != 0) mask |= pins.feed_hold.mask();
  if (pins.cycle_start.port == port && (alarms & input_start) != 0) mask |= pins.cycle_start.mask();
  return mask;
}

// Returns the pins that stop the motors while `watched` is captured. If `watched` is a limit switch, an axis is being
// homed, and other axes may still be on their switches. So switches that are already triggered are ignored.
template <char port>
[[gnu::noinline]] uint8_t stops_beside(uint16_t watched, uint16_t alarms) {
  constexpr uint8_t always = pins.stops_on(port);
  constexpr uint8_t limits = pins.limits_on(port);
  const uint8_t stops = static_cast<uint8_t>(always | buttons_of<port>(alarms));
  if (limits == 0 || (watched & input_probe) != 0) return stops;
  return static_cast<uint8_t>(stops & ~(limits & pins_that_are_on(port)) & ~pins_of<port>(watched));
}

// The interrupt can watch only one port.
[[gnu::noinline]] inline bool are_on_one_port(uint8_t limits) {
  char port = 0;
  bool good = limits >> most_axis_switches == 0;
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    if ((limits >> i & 1) == 0) continue;
    const char own = pins.limits[i].port;
    if (own == 0 || (port != 0 && own != port)) good = false;
    port = own;
  }
  return good;
}

// Chooses the change that the interrupt waits for: the input becomes triggered, or open. Only while nothing is armed.
[[gnu::noinline]] inline void choose_watch(uint16_t watched, bool is_on) {
  char port = pins.probe.port;
  uint8_t mask = (watched & input_probe) != 0 ? pins.probe.mask() : uint8_t{0};
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    if (!pins.limits[i].exists() || (watched & (input_limit << i)) == 0) continue;
    port = pins.limits[i].port;
    mask = static_cast<uint8_t>(mask | pins.limits[i].mask());
  }
  const uint8_t quiet = quiet_levels(port);
  const uint16_t address = port_registers(port);
  // If the input is triggered: the pins that trigger it.
  if (is_on) mask = static_cast<uint8_t>(mask & (*reinterpret_cast<volatile uint8_t*>(address) ^ quiet));
  watch_port = address;
  watch_pins = mask;
  watch_quiet = is_on ? static_cast<uint8_t>(~quiet) : quiet;
}

// Returns which of the watched inputs changed when the interrupt captured. Several inputs are limit switches of one
// port.
[[gnu::noinline]] inline uint16_t inputs_that_moved(uint16_t watched) {
  if ((watched & (watched - 1)) == 0) return watched;
  uint16_t moved = 0;
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    const bool is_it = pins.limits[i].exists() && (watch_pins & pins.limits[i].mask()) != 0;
    if (is_it) moved |= static_cast<uint16_t>(input_limit << i);
  }
  return moved & watched;
}

}  // namespace passo::chip
