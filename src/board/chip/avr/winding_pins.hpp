// WindingPins: the counterpart of StepPins for motors whose windings the board switches itself. There are no direction
// pins to toggle: the expander turns each step into the winding bits that change.
//
// Invariant: while the ring is empty, expansion.held gives the current of each motor. A motor has no current before its
// first step. Its index in the table then continues from its last value.
#pragma once

#include "event_ring.hpp"
#include "serial_line.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

// A motor's winding table, in the bits of one port.
struct WindingBits {
  uint8_t at[windings_off + 1] = {};

  constexpr WindingBits(const MotorPins& motor, char port) {
    const WindingTable table = winding_table(motor.drive);
    for (uint8_t place = 0; place < windings_off; ++place) at[place] = motor.winding_bits(port, table.at(place));
  }
};

template <uint8_t motor, uint8_t p>
inline constinit WindingBits winding_bits{pins.motor[motor], pins.step_ports[p]};

class WindingPins {
 public:
  static constexpr uint8_t turn_bytes = 1;

  // Events in the ring that were not played have moved nothing. So the table indices are read from the pins.
  static uint8_t directions() {
    find_places<0>();
    return 0;
  }
  static uint8_t to_turn(uint8_t /*before*/, uint8_t /*now*/) { return 0; }
  static void load(uint8_t flips, uint8_t directions) {
    expansion.flips = flips;
    expansion.directions = directions;
  }
  static void queue(volatile uint8_t* turn, uint8_t /*motors*/) { *turn = 0; }
  static void make(const volatile uint8_t* /*turn*/) {}

  // There are no step pins.
  static uint8_t set_idle(uint8_t /*high*/) { return 0; }
  static StepTiming set_timing(StepTiming wanted) {
    wanted.event_ticks = 16'000'000 / about.highest_event_rate;
    return wanted;
  }

  // Switches all windings off; each motor keeps its table index. Call only while the interrupt is not playing.
  static void release() {
    clear_windings<0>();
    for (uint8_t& held : expansion.held) held = windings_off;
  }

 private:
  template <uint8_t p>
  [[gnu::always_inline]] static void clear_windings() {
    if constexpr (p < step_port_count) {
      constexpr uint8_t windings = pins.windings_on(pins.step_ports[p]);
      volatile uint8_t* const registers = reinterpret_cast<volatile uint8_t*>(port_registers(pins.step_ports[p]));
      registers[0] = static_cast<uint8_t>(registers[2] & windings);
      clear_windings<p + 1>();
    }
  }
  template <uint8_t motor>
  static void find_places() {
    if constexpr (motor < pins.motors) {
      find_place<motor>();
      find_places<motor + 1>();
    }
  }
  // Tries the motor's last table index first, because it is the most likely.
  template <uint8_t motor>
  [[gnu::noinline]] static void find_place() {
    constexpr uint8_t mask = winding_table(pins.motor[motor].drive).mask;
    uint8_t place = expansion.places[motor];
    for (uint8_t left = mask + 1; left != 0; --left) {
      SerialLine::breathe();
      if (shows<motor>(place)) {
        expansion.held[motor] = expansion.places[motor] = place;
        return;
      }
      place = static_cast<uint8_t>((place + 1) & mask);
    }
    expansion.held[motor] = windings_off;
  }
  template <uint8_t motor, uint8_t p = 0>
  static bool shows(uint8_t place) {
    if constexpr (p < step_port_count) {
      constexpr char port = pins.step_ports[p];
      constexpr uint8_t all = pins.motor[motor].winding_bits(port);
      if constexpr (all != 0) {
        const uint8_t latches = *reinterpret_cast<volatile uint8_t*>(port_registers(port) + 2);
        if ((latches & all) != winding_bits<motor, p>.at[place]) return false;
      }
      return shows<motor, p + 1>(place);
    }
    return true;
  }
};

}  // namespace passo::chip
