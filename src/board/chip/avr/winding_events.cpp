// Does the work of uno_events.cpp, uno_expander.cpp and mega_events.cpp for boards that switch windings themselves: the
// interrupt that plays an event, and the expander that makes one. Motors without drivers turn slowly, so both are in
// C++, for any pin map. docs/boards.md has the sums of their cycles.
#include "event_ring.hpp"
#include "long_times.hpp"
#include "registers.hpp"
#include "serial_line.hpp"
#include "step_interrupt.hpp"
#include "winding_pins.hpp"
#include "wiring.hpp"

namespace passo::chip {
namespace {

#ifdef __AVR_ATmega2560__
constexpr uint8_t vectors_before = 17;
#else
constexpr uint8_t vectors_before = 11;
#endif

[[gnu::always_inline]] inline volatile uint8_t& register_of(char port, uint8_t which) {
  return *reinterpret_cast<volatile uint8_t*>(port_registers(port) + which);
}

// Whether a switch of the machine has moved since the last look.
[[gnu::always_inline]] inline bool switch_moved() {
#ifdef __AVR_ATmega2560__
  return (Pcifr::read() | Eifr::read()) != 0;
#else
  return Pcifr::read() != 0;
#endif
}
[[gnu::always_inline]] inline void forget_moves() {
  Pcifr::write(7);
#ifdef __AVR_ATmega2560__
  Eifr::write(0xff);
#endif
}
[[gnu::always_inline]] inline uint8_t on_of(char port, uint8_t mask) {
  return static_cast<uint8_t>(pins_that_are_on(port) & mask);
}
[[gnu::always_inline]] inline bool must_stop() {
#ifdef __AVR_ATmega2560__
  if ((on_of('D', stops_d) | on_of('E', stops_e) | on_of('J', stops_j)) != 0) return true;
#else
  if (on_of('C', stops_c) != 0) return true;
#endif
  return on_of('B', stops_b) != 0;
}

[[gnu::always_inline]] inline uint8_t pins_that_moved() {
  return static_cast<uint8_t>((*reinterpret_cast<volatile uint8_t*>(watch_port) ^ watch_quiet) & watch_pins);
}

[[gnu::always_inline]] inline void stop_playing() {
  Timsk1::write(0);
  running = 0;
  line_is_watched = 0;
}
[[gnu::always_inline]] inline void act(uint8_t place) {
  Wiring::act(*reinterpret_cast<const volatile OutputAction*>((actions_address & 0xff00) | place));
}
// Returns false if no further step may be made. The flags are cleared before the pins are read, so that no change is
// missed.
[[gnu::always_inline]] inline bool look_at_switches(uint8_t entry) {
  forget_moves();
  if (must_stop()) {
    halted = 1;
    if (Wiring::filter() == 0) {
      stop_playing();
      act(safe_action);
      return false;
    }
  }
  if (armed == 0) return true;
  if (const uint8_t moved = pins_that_moved(); moved != 0) {
    armed = 0;  // only the first change counts
    watch_pins = moved;
    captured_entry = entry;
  }
  return true;
}

// All bytes are loaded before the first is written: a motor's windings may lie on two ports.
[[gnu::always_inline]] inline void turn_windings_over(uint8_t entry) {
  PortBits toggles;
#pragma clang loop unroll(full)
  for (uint8_t p = 0; p < step_port_count; ++p) toggles.on[p] = *ring_byte(toggles_row + p, entry);
#pragma clang loop unroll(full)
  for (uint8_t p = 0; p < step_port_count; ++p) register_of(pins.step_ports[p], 0) = toggles.on[p];
}

// Adds the bits that one step of a motor changes.
template <uint8_t motor, uint8_t p = 0>
[[gnu::always_inline]] inline void change_windings(PortBits& toggles, uint8_t from, uint8_t to) {
  if constexpr (p < step_port_count) {
    if constexpr (pins.motor[motor].winding_bits(pins.step_ports[p]) != 0) {
      const WindingBits& bits = winding_bits<motor, p>;
      toggles.on[p] = static_cast<uint8_t>(toggles.on[p] ^ bits.at[from] ^ bits.at[to]);
    }
    change_windings<motor, p + 1>(toggles, from, to);
  }
}

template <uint8_t motor = 0>
[[gnu::always_inline]] inline void step_motors(PortBits& toggles) {
  if constexpr (motor < pins.motors) {
    constexpr uint8_t bit = 1 << motor;
    constexpr uint8_t mask = winding_table(pins.motor[motor].drive).mask;
    const uint16_t before = expansion.accumulators[motor];
    const uint16_t after = static_cast<uint16_t>(before + expansion.increments[motor]);
    expansion.accumulators[motor] = after;
    if ((after < before) != ((expansion.flips & bit) != 0)) {
      uint8_t place = expansion.places[motor];
      place = static_cast<uint8_t>((expansion.directions & bit) != 0 ? place - 1 : place + 1) & mask;
      change_windings<motor>(toggles, expansion.held[motor], place);
      expansion.places[motor] = expansion.held[motor] = place;
    }
    step_motors<motor + 1>(toggles);
  }
}

}  // namespace

extern "C" {

volatile uint8_t next_entry;

[[gnu::naked, gnu::used, gnu::section(".vectors")]] void vectors() {
  asm volatile(R"(
      .rept %[before]
      jmp passo_reset
      .endr
      jmp passo_play_event
  )" ::[before] "n"(vectors_before));
}

// It calls no function: a call would cost the saving of twelve registers.
[[gnu::signal, gnu::used]] void play_event() asm("passo_play_event");
void play_event() {
  uint8_t entry = next_entry;
  if (switch_moved() && !look_at_switches(entry)) return;
  turn_windings_over(entry);

  // A byte on the line does not wait for the main loop.
  while ((Ucsr0a::read() & byte_received) != 0) {
    const uint8_t head = received_head;
    *reinterpret_cast<volatile uint8_t*>((received_address & 0xff00) | head) = Udr0::read();
    received_head = static_cast<uint8_t>(head + 1);
  }
  entry = static_cast<uint8_t>((entry + 1) & ring_mask);
  next_entry = entry;
  Ocr1ah::write(*time_high_of(entry));
  Ocr1al::write(*time_low_of(entry));

  const uint8_t flags = *ring_byte(flags_row, entry);
  if (flags == 0) return;
  uint8_t action = action_at_end;
  if ((flags & flag_stop) != 0) {
    stop_playing();
  } else {
    const uint8_t tail = turns_tail;
    action = *reinterpret_cast<volatile uint8_t*>((turns_address & 0xff00) | tail);
    turns_tail = static_cast<uint8_t>((tail + 1) & ((turns_address & 0xff) + turns_mask));
  }
  if (action != 0) act(action);
}

void expand(uint8_t events) {
  uint8_t entry = static_cast<uint8_t>(expansion.address);
  const uint8_t first = entry;
  do {
    expansion.time += expansion.interval;
    expansion.interval += static_cast<uint32_t>(expansion.change);
    set_time(entry, static_cast<uint16_t>(expansion.time >> 16));
    PortBits toggles = {};
    step_motors(toggles);
#pragma clang loop unroll(full)
    for (uint8_t p = 0; p < step_port_count; ++p) *ring_byte(toggles_row + p, entry) = toggles.on[p];
    if (entry != first) *ring_byte(flags_row, entry) = 0;
    entry = static_cast<uint8_t>((entry + 1) & ring_mask);
    SerialLine::breathe();
  } while (--events != 0);
}
}

}  // namespace passo::chip
