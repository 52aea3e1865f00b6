// The Mega's event ring, for four step ports. Each byte of an entry lies in a page of its own, at the entry's index. So
// the interrupt has to keep only the index, an 8-bit register that wraps at the ring's end.
#pragma once

#include "registers.hpp"
#include "step_times.hpp"
#include <stdint.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

inline constexpr const PinMap<6>& pins = mega_ramps;
inline constexpr uint8_t flag_special = pins.flag_special;
inline constexpr uint8_t flag_stop = pins.flag_stop;
inline constexpr StepTimes step_times = {
    .shortest_pulse = 18, .first_padding = 27, .event_ticks = 145, .first_turn = 23, .last_turn = 39, .beside_wait = 0};
inline constexpr About about = {.firmware = PASSO_FIRMWARE_VERSION,
                                .highest_event_rate = 110'000,
                                .baud = 500'000,
                                .name = "mega ramps 1.4",
                                .step_pulse = step_times.shortest_pulse};

// Pages at the start of RAM, before everything that the linker places: the times' high and low bytes, then the bits to
// toggle on each step port, in the pin map's order.
inline constexpr uint16_t times_high_address = 0x200;
inline constexpr uint16_t times_low_address = 0x300;
inline constexpr uint16_t first_toggles_address = 0x400;
inline constexpr uint16_t ring_entries = 256;
inline constexpr uint8_t most_events = 220;   // two milliseconds at the highest rate; all of them are played
inline constexpr bool ring_is_short = false;  // it lasts while a frame is composed
inline constexpr uint8_t most_begun = 8;      // items begun and not finished
inline constexpr uint8_t most_at_once = 100;  // entries made in one call
inline constexpr uint8_t way_in_events = 8;   // about the number played during the call overhead of making events
using StepAlarm = Ocr1al;
using StepCount = Tcnt1l;
// The capacity of the item queue. From 100 on the host fits motion finely.
inline constexpr uint8_t queue_capacity = 160;

// As on the Uno. A direction change has a byte for each step port.
inline constexpr uint16_t received_address = 0x800;
inline constexpr uint16_t turns_address = 0x900;
inline constexpr uint8_t turns_mask = 0x3f;
// If events are fewer ticks apart than this, the interrupt reads every byte: a byte takes 320 cycles, the UART holds
// two, and the interrupt reads all of them.
inline constexpr uint16_t often = 500;

inline constexpr uint16_t actions_address = 0x940;
inline constexpr uint8_t action_bits = 0x7c;

inline constexpr uint16_t first_free_address = 0x954;

inline uint16_t entry_address(uint8_t index) {
  return index;
}
inline volatile uint8_t* time_high_of(uint8_t index) {
  return reinterpret_cast<volatile uint8_t*>(times_high_address + index);
}
inline volatile uint8_t* time_low_of(uint8_t index) {
  return reinterpret_cast<volatile uint8_t*>(times_low_address + index);
}
inline uint16_t toggles_address(uint8_t index) {
  return first_toggles_address + index;
}

// Clears the event's toggle bits, so that it does nothing.
inline void clear_toggles(uint8_t index) {
  for (uint16_t port = 0; port != 0x400; port += 0x100) {
    *reinterpret_cast<volatile uint8_t*>(toggles_address(index) + port) = 0;
  }
}

inline void prepare_ring() {}
// Clears a byte of each port whose motors the host does not use: the expander skips these ports.
inline void forget_toggles(uint8_t index) {
  for (uint16_t port = 0x100; port != 0x400; port += 0x100) {
    *reinterpret_cast<volatile uint8_t*>(toggles_address(index) + port) = 0;
  }
}

inline uint8_t entry_of(uint16_t number) {
  return static_cast<uint8_t>(number);
}
// Returns the entry that the interrupt plays next, or the one after the last event.
inline uint8_t fetched_entry() {
  uint8_t number;
  asm volatile("mov %0, r2" : "=r"(number));
  return number;
}
// Puts an entry into the interrupt's registers. Call only while the interrupt is stopped.
inline void fetch_entry(uint8_t index) {
  const uint8_t toggles = *reinterpret_cast<volatile uint8_t*>(toggles_address(index));
  asm volatile("mov r2, %0\n\tmov r5, %1" ::"r"(index), "r"(toggles));
}
// Sets the toggle bits in the interrupt's registers, without flags.
inline void set_fetched_toggles(uint8_t toggles) {
  asm volatile("mov r5, %0" ::"r"(toggles));
}

}  // namespace passo::chip
