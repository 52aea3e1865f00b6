// EventRing: the events of the near future, made in the main loop, played by the step timer's interrupt.
//
// An entry is when (the timer's count) and what (the bits to turn over in each of the step ports). How entries lie in
// RAM is what suits the board's interrupt, so that it comes from one to the next without an instruction that changes
// the flags, and need not save them.
//
// Invariant: the entry behind the last event has both flags set, in the first step port's byte: there the interrupt
// stops. One flag alone: the interrupt has to turn over direction pins, out of `turns`, before that event.
#pragma once

#include <stdint.h>

#ifdef PASSO_WINDINGS
#include "winding_ring.hpp"
#elif defined __AVR_ATmega2560__
#include "mega_ring.hpp"
#else
#include "uno_ring.hpp"
#endif

namespace passo::chip {

inline constexpr uint8_t ring_mask = ring_entries - 1;
inline constexpr uint8_t step_port_count = pins.ports();

// A byte for each of the step ports.
struct PortBits {
  uint8_t on[step_port_count];
};

// How the outputs are to be: their two ports as a whole, and the PWM of the spindle, whose pin is not connected to it
// where the duty is 0: even that would be a pulse of one count.
struct OutputAction {
  uint8_t first_port;
  uint8_t second_port;
  uint8_t duty;
  uint8_t control;
};
inline constexpr uint8_t action_count = 4;
inline constexpr uint8_t safe_action = (actions_address & 0xff) + sizeof(OutputAction) * action_count;
// Of a turn's first byte.
inline constexpr uint8_t turning_bits = pins.directions_on(pins.step_ports[0]);
static_assert((turning_bits & action_bits) == 0);
static_assert((actions_address & 0xff & ~action_bits) == 0 && (safe_action & ~action_bits) == 0);
static_assert(actions_address >> 8 == turns_address >> 8, "turns and actions are on one page");
static_assert(first_free_address >= actions_address + sizeof(OutputAction) * (action_count + 1));

// The byte of an entry with the flags: the first step port's, or one of their own.
inline volatile uint8_t& flagged_byte(uint8_t index) {
  return *reinterpret_cast<volatile uint8_t*>(toggles_address(index));
}
inline uint16_t time_of(uint8_t index) {
  return static_cast<uint16_t>(*time_high_of(index) << 8 | *time_low_of(index));
}
inline void set_time(uint8_t index, uint16_t time) {
  *time_high_of(index) = static_cast<uint8_t>(time >> 8);
  *time_low_of(index) = static_cast<uint8_t>(time);
}

}  // namespace passo::chip
