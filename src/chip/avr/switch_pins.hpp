// The pins of a port that belong to each of the board's inputs, taken from its pin map.
#pragma once

#include "registers.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

template <char port>
[[gnu::always_inline]] inline uint8_t low_pins() {
  return static_cast<uint8_t>(~*reinterpret_cast<volatile uint8_t*>(port_registers(port)));
}

// The pins of a limit switch, which may have two.
template <char port>
[[gnu::always_inline]] inline uint8_t pins_of(uint16_t limit) {
  uint8_t mask = 0;
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    const bool is_it = pins.limits[i].port == port && (limit & (input_limit << (i % 3))) != 0;
    if (is_it) mask = static_cast<uint8_t>(mask | pins.limits[i].mask());
  }
  return mask;
}

// The pins that stop the motors while `watched` is captured. If that is a limit switch, an axis is being homed, and
// other axes may still be on their switches. So closed switches do not count.
template <char port>
[[gnu::noinline]] uint8_t stops_beside(uint16_t watched) {
  constexpr uint8_t stops = pins.stops_on(port);
  constexpr uint8_t limits = pins.limits_on(port);
  if (limits == 0 || (watched & input_probe) != 0) return stops;
  return static_cast<uint8_t>(stops & ~(limits & low_pins<port>()) & ~pins_of<port>(watched));
}

constexpr bool has_its_pins_on_one_port(uint8_t limit) {
  const Pin second = pins.limits[limit + 3];
  return !second.exists() || second.port == pins.limits[limit].port;
}
static_assert(has_its_pins_on_one_port(0) && has_its_pins_on_one_port(1) && has_its_pins_on_one_port(2));

// Chooses what the interrupt waits for: that the input closes, or opens. Only while nothing is armed.
[[gnu::noinline]] inline void choose_watch(uint16_t watched, bool closed) {
  uint16_t port = port_registers(pins.probe.port);
  uint8_t mask = (watched & input_probe) != 0 ? pins.probe.mask() : uint8_t{0};
#pragma clang loop unroll(full)
  for (uint8_t i = 0; i < most_axis_switches; ++i) {
    if (!pins.limits[i].exists() || (watched & (input_limit << (i % 3))) == 0) continue;
    port = port_registers(pins.limits[i].port);
    mask = static_cast<uint8_t>(mask | pins.limits[i].mask());
  }
  // If it is closed: the pins that close it.
  const uint8_t high = *reinterpret_cast<volatile uint8_t*>(port);
  if (closed) mask = static_cast<uint8_t>(mask & ~high);
  watch_port = port;
  watch_pins = mask;
  watch_quiet = closed ? uint8_t{0} : uint8_t{0xff};
}

}  // namespace passo::chip
