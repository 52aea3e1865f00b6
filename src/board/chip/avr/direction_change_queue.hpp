// DirectionChangeQueue: the direction changes and output actions that wait for their flagged events. The step timer's
// interrupt makes them; while it is stopped, make_next() does.
#pragma once

#include "event_ring.hpp"
#include "output_actions.hpp"
#include "step_interrupt.hpp"
#ifdef PASSO_WINDINGS
#include "winding_pins.hpp"
#else
#include "step_pins.hpp"
#endif

namespace passo::chip {

#ifdef PASSO_WINDINGS
using MotorOutputs = WindingPins;
#else
using MotorOutputs = StepPins;
#endif

class DirectionChangeQueue {
 public:
  static void clear() { head_ = turns_tail; }
  // Adds the motors that reverse, and the action attached to them. Returns false if there is no room.
  static bool put(uint8_t motors) {
    const uint8_t head = behind(head_);
    if (head == turns_tail) return false;
    volatile uint8_t* const turn = at(head_);
    MotorOutputs::queue(turn, motors);
    turn[0] = static_cast<uint8_t>(turn[0] | OutputActions::riding());
    head_ = head;
    return true;
  }
  // Makes the oldest direction change.
  static void make_next() {
    const uint8_t tail = turns_tail;
    const volatile uint8_t* const turn = at(tail);
    MotorOutputs::make(turn);
    if ((turn[0] & action_bits) != 0) OutputActions::act(turn[0] & action_bits);
    turns_tail = behind(tail);
  }

 private:
  static volatile uint8_t* at(uint8_t turn) {
    return reinterpret_cast<volatile uint8_t*>((turns_address & 0xff00) | turn);
  }
  static uint8_t behind(uint8_t turn) {
    const uint8_t low = static_cast<uint8_t>(turns_address & 0xff);
    return static_cast<uint8_t>((turn + MotorOutputs::turn_bytes) & (low + turns_mask));
  }

  static inline uint8_t head_ = turns_address & 0xff;
};

}  // namespace passo::chip
