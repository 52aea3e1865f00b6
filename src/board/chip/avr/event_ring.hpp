// EventRing: the events of the near future. The main loop makes them, and the step timer's interrupt plays them.
//
// An entry has a time (the timer's count, or its low byte) and the bits to toggle in each of the step ports. The layout
// in RAM depends on the board's interrupt, which must step from one entry to the next without an instruction that
// changes the CPU flags, so that it need not save them.
//
// Invariant: the entry after the last event has both flag bits set in the first step port's byte; the interrupt stops
// there. One flag alone means that the interrupt must toggle direction pins, taken from `turns`, before that event.
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

// One byte for each step port.
struct PortBits {
  uint8_t on[step_port_count];
};

// A complete output state: the two port values and the duty of the spindle's PWM. At duty 0 the spindle's pin is
// disconnected from the PWM, which would otherwise still make a pulse of one count.
struct OutputAction {
  uint8_t first_port;
  uint8_t second_port;
  uint8_t duty;
  uint8_t control;
};
inline constexpr uint8_t action_count = 4;
inline constexpr uint8_t safe_action = (actions_address & 0xff) + sizeof(OutputAction) * action_count;
// The bits of a direction change's first byte that toggle direction pins.
inline constexpr uint8_t turning_bits = pins.directions_on(pins.step_ports[0]);
static_assert((turning_bits & action_bits) == 0);
static_assert((actions_address & 0xff & ~action_bits) == 0 && (safe_action & ~action_bits) == 0);
static_assert(actions_address >> 8 == turns_address >> 8, "turns and actions are on one page");
static_assert(first_free_address >= actions_address + sizeof(OutputAction) * (action_count + 1));

// The byte of an entry that has the flags: the first step port's byte, or a separate byte for the flags.
inline volatile uint8_t& flagged_byte(uint8_t index) {
  return *reinterpret_cast<volatile uint8_t*>(toggles_address(index));
}
}  // namespace passo::chip
