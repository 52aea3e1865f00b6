// StepPins: the part of the player for motors with step and direction pins. A step is one byte written to PINx twice.
// The interrupt toggles direction pins as the queue of direction changes specifies.
//
// WindingPins (winding_pins.hpp) is the counterpart for motors whose windings the board switches itself.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

class StepPins {
 public:
  static constexpr uint8_t turn_bytes = step_port_count;

  // Reads the pins, because a queued direction change may not have been made.
  static uint8_t directions() {
    uint8_t down = 0;
    for (uint8_t m = 0; m < pins.motors; ++m) {
      const Pin pin = pins.motor[m].direction;
      const uint8_t levels = *reinterpret_cast<volatile uint8_t*>(port_registers(pin.port) + 2);
      if ((levels & pin.mask()) != 0) down = static_cast<uint8_t>(down | 1U << m);
    }
    return down;
  }
  static uint8_t to_turn(uint8_t before, uint8_t now) { return before ^ now; }
  static void load(uint8_t flips, uint8_t /*directions*/) {
    for (uint8_t p = 0; p < step_port_count; ++p) expansion.flips.on[p] = motor_pins.on[p].steps[flips];
  }
  static void queue(volatile uint8_t* turn, uint8_t motors) {
    for (uint8_t p = 0; p < step_port_count; ++p) turn[p] = motor_pins.on[p].directions[motors];
  }
  static void make(const volatile uint8_t* turn) {
    for (uint8_t p = 0; p < step_port_count; ++p) {
      const uint8_t turning = p == 0 ? static_cast<uint8_t>(turn[p] & turning_bits) : turn[p];
      *reinterpret_cast<volatile uint8_t*>(port_registers(pins.step_ports[p])) = turning;
    }
  }

  // Sets the idle levels of the step pins. Bit m: motor m idles high. Returns the levels set. Call only at standstill.
  [[gnu::noinline]] static uint8_t set_idle(uint8_t high) {
    for (uint8_t m = 0; m < pins.motors; ++m) {
      const Pin pin = pins.motor[m].step;
      volatile uint8_t* const registers = reinterpret_cast<volatile uint8_t*>(port_registers(pin.port));
      if (((registers[2] & pin.mask()) != 0) != ((high >> m & 1) != 0)) registers[0] = pin.mask();
    }
    return high & ((1 << pins.motors) - 1);
  }
  [[gnu::noinline]] static StepTiming set_timing(const StepTiming& wanted) { return step_times.set(wanted); }

 private:
  static constexpr auto motor_pins = motor_pins_by_port<step_port_count>(pins);
};

}  // namespace passo::chip
