// The event ring of boards that switch windings themselves, for both chips. It need not be as fast as with step pins:
// it has one layout, any number of step ports, and reserves no registers for the interrupt.
#pragma once

#include "registers.hpp"
#include <stdint.h>

#ifdef __AVR_ATmega2560__
#include "passo/chip/mega_windings.hpp"
#else
#include "passo/chip/uno_windings.hpp"
#endif

#include "passo/wire/message.hpp"

namespace passo::chip {

// PASSO_WINDINGS gives the drive mode of each motor: a list of DriveMode values, in order.
using enum DriveMode;
#ifdef __AVR_ATmega2560__
inline constexpr PinMap<4> pins = driven(mega_windings, {PASSO_WINDINGS});
inline constexpr About about = {
    .firmware = PASSO_FIRMWARE_VERSION, .highest_event_rate = 30'000, .baud = 500'000, .name = "mega windings"};
inline constexpr uint8_t queue_capacity = 160;
inline constexpr uint16_t ram_address = 0x200;
#else
inline constexpr PinMap<3> pins = driven(uno_windings, {PASSO_WINDINGS});
inline constexpr About about = {
    .firmware = PASSO_FIRMWARE_VERSION, .highest_event_rate = 35'000, .baud = 500'000, .name = "uno windings"};
inline constexpr uint8_t queue_capacity = 37;
inline constexpr uint16_t ram_address = 0x100;
#endif

using StepAlarm = Ocr1al;
using StepCount = Tcnt1l;
inline constexpr uint8_t windings_off = 8;  // used instead of a motor's table index: no current
inline constexpr uint8_t flag_special = 2;
inline constexpr uint8_t flag_stop = 1;

// The ring is at the start of RAM, before everything that the linker places: a page for received bytes, then rows with
// one byte per entry. The rows are times (high and low), flags, and the bits to toggle on each step port.
inline constexpr uint16_t received_address = ram_address;
inline constexpr uint16_t ring_address = ram_address + 0x100;
inline constexpr uint8_t ring_entries = 64;
inline constexpr uint8_t most_events = 62;
inline constexpr bool ring_is_short = false;  // making an event takes longer than the time allowed between two reads of
                                              // the UART
inline constexpr uint8_t flags_row = 2;
inline constexpr uint8_t toggles_row = 3;

// As on the other boards. A direction change only carries an action.
inline constexpr uint16_t actions_address = ring_address + ring_entries * (toggles_row + pins.ports());
inline constexpr uint8_t action_bits = (actions_address & 0xff) | 0x1c;
inline constexpr uint16_t turns_address = actions_address + 0x20;
inline constexpr uint8_t turns_mask = 0x07;
// The interrupt reads all received bytes.
inline constexpr uint16_t often = 500;
inline constexpr uint8_t most_begun = 4;     // items begun and not finished
inline constexpr uint8_t most_at_once = 8;   // the expander reads the serial port at every event
inline constexpr uint8_t way_in_events = 8;  // about the number played during the call overhead of making events
inline constexpr uint16_t first_free_address = turns_address + turns_mask + 1;

inline uint16_t entry_address(uint8_t index) {
  return index;
}
// Rows do not cross pages, so only the low byte is computed.
[[gnu::always_inline]] inline volatile uint8_t* ring_byte(uint8_t row, uint8_t index) {
  const uint16_t start = static_cast<uint16_t>(ring_address + ring_entries * row);
  return reinterpret_cast<volatile uint8_t*>((start & 0xff00) | static_cast<uint8_t>((start & 0xff) + index));
}
inline volatile uint8_t* time_high_of(uint8_t index) {
  return ring_byte(0, index);
}
inline volatile uint8_t* time_low_of(uint8_t index) {
  return ring_byte(1, index);
}
inline uint16_t toggles_address(uint8_t index) {
  return static_cast<uint16_t>(ring_address + ring_entries * flags_row + index);
}
inline void clear_toggles(uint8_t index) {
  for (uint8_t row = flags_row; row < toggles_row + pins.ports(); ++row) *ring_byte(row, index) = 0;
}

inline void prepare_ring() {}
inline void forget_toggles(uint8_t /*index*/) {}

extern "C" volatile uint8_t next_entry;  // the entry that the interrupt plays next, or the one after the last event

inline uint8_t entry_of(uint16_t number) {
  return static_cast<uint8_t>(number);
}
inline uint8_t fetched_entry() {
  return next_entry;
}
inline void fetch_entry(uint8_t index) {
  next_entry = index;
}
inline void set_fetched_toggles(uint8_t /*toggles*/) {}

}  // namespace passo::chip
