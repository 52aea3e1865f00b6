// The Uno's event ring. There is one step port, so an entry has four bytes. It ends with the high byte of the next
// entry's address. This takes the interrupt from one page to the next, and from the end to the start.
#pragma once

#include <stdint.h>

#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

inline constexpr const PinMap<3>& pins = uno_cnc_shield;
inline constexpr uint8_t flag_special = pins.flag_special;
inline constexpr uint8_t flag_stop = pins.flag_stop;
// The interrupt makes a pulse of so many cycles, or of more if the pin map wants a longer one.
inline constexpr uint8_t pulse_without_padding = 19;
inline constexpr About about = {
    .firmware = 101,
    .highest_event_rate = 140'000,
    .baud = 500'000,
    .name = "uno cnc shield3",
    .step_pulse = pins.shortest_pulse > pulse_without_padding ? pins.shortest_pulse : pulse_without_padding};

// The ring lies at the start of RAM, before everything that the linker places.
struct EventEntry {
  uint8_t time_high;
  uint8_t time_low;
  uint8_t toggles;
  uint8_t next_page;
};

inline constexpr uint16_t ring_address = 0x100;
inline constexpr uint8_t ring_entries = 128;
inline constexpr uint8_t most_events = 126;   // in the ring; all of them will be played
inline constexpr uint8_t most_at_once = 100;  // made in one call
// In the list of items. More would take memory from the stack (check_program.sh).
inline constexpr uint8_t queue_capacity = 31;

// Received bytes. The interrupt or the main loop puts them here, whichever finds one. The ring is a page: its index is
// the low byte of the address and wraps by itself. All bytes that the host may have under way fit.
inline constexpr uint16_t received_address = 0x300;

// Direction bits to toggle, one byte for each flagged event that waits.
inline constexpr uint16_t turns_address = 0x400;
inline constexpr uint8_t turns_mask = 0x07;

// If events come at fewer ticks than this, the interrupt sees every byte: a byte takes 320 cycles, and the interrupt
// takes one.
inline constexpr uint16_t often = 300;

// Actions of the outputs, and after them the action at a stop. The low byte of an action's address is told beside the
// directions of the turn on which it rides, in bits that turn nothing.
inline constexpr uint16_t actions_address = 0x408;
inline constexpr uint8_t action_bits = 0x1c;

// The linker places its own data from here on (CMakeLists.txt tells it so).
inline constexpr uint16_t first_free_address = 0x41c;

// The address to which the expander writes the entry.
inline uint16_t entry_address(uint8_t index) {
  return ring_address + sizeof(EventEntry) * index;
}
inline volatile EventEntry& entry(uint8_t index) {
  return reinterpret_cast<volatile EventEntry*>(ring_address)[index];
}
inline volatile uint8_t* time_high_of(uint8_t index) {
  return &entry(index).time_high;
}
inline volatile uint8_t* time_low_of(uint8_t index) {
  return &entry(index).time_low;
}
inline uint16_t toggles_address(uint8_t index) {
  return static_cast<uint16_t>(entry_address(index) + 2);
}

// Makes the event do nothing.
inline void clear_toggles(uint8_t index) {
  entry(index).toggles = 0;
}

inline void prepare_ring() {
  for (uint8_t i = 0; i < ring_entries; ++i) {
    entry(i).next_page = static_cast<uint8_t>(entry_address((i + 1) & (ring_entries - 1)) >> 8);
  }
}
// No event toggles a bit on a port of motors that the host does not know.
inline void forget_toggles(uint8_t /*index*/) {}

// r3:r2 points after the bytes of the entry that the interrupt has fetched, so at the next entry.
inline uint8_t entry_of(uint16_t next) {
  return static_cast<uint8_t>(((next - ring_address) / sizeof(EventEntry) - 1) & (ring_entries - 1));
}
// The entry that the interrupt has in its registers, or the one after the last event.
inline uint8_t fetched_entry() {
  uint16_t next;
  asm volatile("movw %0, r2" : "=r"(next));
  return entry_of(next);
}
// Puts an entry into the interrupt's registers. Only while the interrupt does not run.
inline void fetch_entry(uint8_t index) {
  const uint16_t next = entry_address((index + 1) & (ring_entries - 1));
  asm volatile("movw r2, %0\n\tmov r5, %1" ::"r"(next), "r"(entry(index).toggles));
}
// Sets the bits to toggle there, without flags.
inline void set_fetched_toggles(uint8_t toggles) {
  asm volatile("mov r5, %0" ::"r"(toggles));
}

}  // namespace passo::chip
