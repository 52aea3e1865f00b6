// The Uno's event ring. There is one step port, and the low byte of a time is enough (short_times.hpp). So an entry has
// two bytes, and the ring is a page: the low byte of an entry's address wraps automatically.
#pragma once

#include "registers.hpp"
#include "step_times.hpp"
#include <stdint.h>

#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

inline constexpr const PinMap<3>& pins = uno_cnc_shield;
inline constexpr uint8_t flag_special = pins.flag_special;
inline constexpr uint8_t flag_stop = pins.flag_stop;
inline constexpr StepTimes step_times = {.shortest_pulse = 18,
                                         .first_padding = 29,
                                         .event_ticks = 106,
                                         .first_turn = 22,
                                         .last_turn = 38,
                                         .beside_wait = 200};
inline constexpr About about = {.firmware = PASSO_FIRMWARE_VERSION,
                                .highest_event_rate = 150'000,
                                .baud = 500'000,
                                .name = "uno cnc shield3",
                                .step_pulse = step_times.shortest_pulse};

// The ring lies at the start of RAM, before everything that the linker places.
struct EventEntry {
  uint8_t time;
  uint8_t toggles;
};
// A wait entry has one flag set. An entry with a direction change can be a wait too: then it also has this bit, which
// no step pin uses.
inline constexpr uint8_t first_waits = 0x80;
static_assert((pins.steps_on('D') & first_waits) == 0);

inline constexpr uint16_t ring_address = 0x100;
inline constexpr uint8_t ring_entries = 128;
// Events in the ring; all of them are played. Those just played must stay readable when a capture is stored.
inline constexpr uint8_t most_events = 120;
// The ring does not last while a frame is composed, so events are made during that work.
inline constexpr bool ring_is_short = true;
inline constexpr uint8_t most_begun = 5;      // items begun and not finished
inline constexpr uint8_t most_at_once = 100;  // entries made in one call
inline constexpr uint8_t way_in_events = 24;  // about the number played during the call overhead of making events
// The registers of the step timer whose low bytes show how near its compare match is.
using StepAlarm = Ocr0a;
using StepCount = Tcnt0;
// The capacity of the item queue. A larger queue would take memory from the stack (check_program.sh).
inline constexpr uint8_t queue_capacity = 42;

// Received bytes. Both the interrupt and the main loop store them here. The ring is a page: its index is the low byte
// of the address and wraps automatically. All bytes that the host may have in flight fit.
inline constexpr uint16_t received_address = 0x200;

// Direction bits to toggle, one byte for each flagged event that waits.
inline constexpr uint16_t turns_address = 0x300;
inline constexpr uint8_t turns_mask = 0x07;

// No entry is more than this many ticks after the one before it, and the interrupt reads a byte each time. A byte takes
// 320 cycles.
inline constexpr uint16_t often = 300;

// Output actions, followed by the action at a stop. The low byte of an action's address is stored in the unused bits of
// the direction change to which it is attached.
inline constexpr uint16_t actions_address = 0x308;
inline constexpr uint8_t action_bits = 0x1c;

// The linker places its own data from here on (set in CMakeLists.txt).
inline constexpr uint16_t first_free_address = 0x31c;

// Returns the address to which the expander writes the entry.
inline uint16_t entry_address(uint8_t index) {
  return ring_address + sizeof(EventEntry) * index;
}
inline volatile EventEntry& entry(uint8_t index) {
  return reinterpret_cast<volatile EventEntry*>(ring_address)[index];
}
inline volatile uint8_t* time_low_of(uint8_t index) {
  return &entry(index).time;
}
inline uint16_t toggles_address(uint8_t index) {
  return static_cast<uint16_t>(entry_address(index) + 1);
}

// Clears the event's toggle bits, so that it does nothing.
inline void clear_toggles(uint8_t index) {
  entry(index).toggles = 0;
}

inline void prepare_ring() {}
// Nothing to clear: no event toggles a bit on a port whose motors the host does not use.
inline void forget_toggles(uint8_t /*index*/) {}

// r3:r2 points after the bytes of the entry that the interrupt has fetched, that is, to the next entry.
inline uint8_t entry_of(uint16_t next) {
  return static_cast<uint8_t>((static_cast<uint8_t>(next) / sizeof(EventEntry) - 1) & (ring_entries - 1));
}
// Returns the entry in the interrupt's registers, or the one after the last event.
inline uint8_t fetched_entry() {
  uint16_t next;
  asm volatile("movw %0, r2" : "=r"(next));
  return entry_of(next);
}
// Puts an entry into the interrupt's registers. Call only while the interrupt is stopped.
inline void fetch_entry(uint8_t index) {
  const uint16_t next = entry_address((index + 1) & (ring_entries - 1));
  asm volatile("movw r2, %0\n\tmov r5, %1" ::"r"(next), "r"(entry(index).toggles));
}
// Sets the toggle bits in the interrupt's registers, without flags.
inline void set_fetched_toggles(uint8_t toggles) {
  asm volatile("mov r5, %0" ::"r"(toggles));
}

}  // namespace passo::chip
