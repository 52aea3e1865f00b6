// Which pins of a port belong to which of the board's inputs, out of its pin map.
#pragma once

#include "registers.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

template <char port>
[[gnu::always_inline]] inline uint8_t low_pins() {
  return static_cast<uint8_t>(~*reinterpret_cast<volatile uint8_t*>(port_registers(port)));
}

// Of an input, the probe or a limit switch, which may have two pins.
template <char port>
[[gnu::always_inline]] inline uint8_t pins_of(uint16_t input) {
  uint8_t mask = 0;
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    const bool is_it = pins.limits[i].port == port && (input & (input_limit << (i % 3))) != 0;
    if (is_it) mask = static_cast<uint8_t>(mask | pins.limits[i].mask());
  }
  if (pins.probe.port == port && (input & input_probe) != 0) mask = static_cast<uint8_t>(mask | pins.probe.mask());
  return mask;
}

// The pins that stop the motors while `watched` is captured. Where that is a limit switch an axis is being homed, and
// others may be on their switches still: what is closed is no event.
template <char port>
[[gnu::noinline]] uint8_t stops_beside(uint16_t watched) {
  constexpr uint8_t stops = pins.stops_on(port);
  constexpr uint8_t limits = pins.limits_on(port);
  if (limits == 0 || (watched & input_probe) != 0) return stops;
  return static_cast<uint8_t>(stops & ~(limits & low_pins<port>()) & ~pins_of<port>(watched));
}

// The pins whose change is that of `watched`; where it is closed, those that close it.
template <char port>
[[gnu::noinline]] uint8_t watchable(uint16_t watched, bool closed) {
  const uint8_t mask = pins_of<port>(watched);
  return closed ? static_cast<uint8_t>(mask & low_pins<port>()) : mask;
}

}  // namespace passo::chip
