// EventRing: the events of the near future, made in the main loop, played by the step timer's interrupt.
//
// An entry is when (the timer's count, high byte first, as the timer wants it), what (the bits to turn over in the step
// ports) and the high byte of the next entry's address: the interrupt comes from one page to the next, and from the end
// to the start, without an instruction that changes the flags, and need not save them.
//
// Invariant: the entry behind the last event has both flags set, in the first step port's byte: there the interrupt
// stops. One flag alone: the interrupt has to turn over direction pins, out of `turns`, before that event.
#pragma once

#include <stdint.h>

namespace passo::chip {

// Of one step port. Lies at the start of RAM, before everything that the linker places.
struct EventEntry {
  uint8_t time_high;
  uint8_t time_low;
  uint8_t toggles;
  uint8_t next_page;
};

inline constexpr uint16_t ring_address = 0x100;
inline constexpr uint8_t ring_entries = 128;
inline constexpr uint8_t ring_mask = ring_entries - 1;

// Bytes off the line, put there by whoever finds one: the interrupt, or the main loop. A page: the index is the low
// byte of the address and wraps by itself. All that the host may have under way fits.
inline constexpr uint16_t received_address = 0x300;

// Direction bits to turn over, one for each flagged event that waits.
inline constexpr uint16_t turns_address = 0x400;
inline constexpr uint8_t turns_mask = 0x03;

// From here on the linker places its own (CMakeLists.txt says so to it).
inline constexpr uint16_t first_free_address = 0x404;

inline volatile EventEntry& entry(uint8_t index) {
  return reinterpret_cast<volatile EventEntry*>(ring_address)[index];
}

}  // namespace passo::chip
