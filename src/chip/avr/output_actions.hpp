// OutputActions: what the outputs are to be switched to, each with the event behind which that is to happen. The step
// timer's interrupt does it there: an action rides on the queue of turns, or waits at the end of the ring.
//
// Invariant: an action says what the ports are to be, not what is to change. So it may be done twice, by the interrupt
// and by the main loop that has not seen it, and never out of order: one that is put while nothing plays is done at
// once.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"
#include "wiring.hpp"

namespace passo::chip {

class OutputActions {
 public:
  // None waits. What happens at a stop goes on from how the ports are now.
  static void clear() {
    action_at_end = 0;
    riding_ = 0;
    waiting_ = 0;
    store(safe_action, {});
  }
  static bool full() { return waiting_ == action_count; }

  // Behind all events made so far. `rests`: there is none to come.
  static void put(const BoardOutputs& outputs, bool (*rests)()) {
    const uint8_t place = static_cast<uint8_t>(actions_address + sizeof(OutputAction) * next_);
    next_ = static_cast<uint8_t>((next_ + 1) % action_count);
    ++waiting_;
    store(place, outputs);
    riding_ = place;
    action_at_end = place;
    if (rests()) {
      act(place);
      taken();
    }
  }
  // It is done.
  static void forget() { --waiting_; }

  // Low byte of the address of the action that the next event takes with it; 0: none.
  static uint8_t riding() { return riding_; }
  // The event has it.
  static void taken() {
    riding_ = 0;
    action_at_end = 0;
  }

  static void act(uint8_t place) { Wiring::act(*at(place)); }
  // All off.
  static void make_safe() { act(safe_action); }

 private:
  static volatile OutputAction* at(uint8_t place) {
    return reinterpret_cast<volatile OutputAction*>((actions_address & 0xff00) | place);
  }
  [[gnu::noinline]] static void store(uint8_t place, const BoardOutputs& outputs) {
    const OutputAction action = Wiring::action_of(outputs);
    volatile OutputAction& stored = *at(place);
    stored.first_port = action.first_port;
    stored.second_port = action.second_port;
    stored.duty = action.duty;
    stored.control = action.control;
  }

  static inline uint8_t next_ = 0;
  static inline uint8_t waiting_ = 0;  // not done yet, as far as the main loop knows
  static inline uint8_t riding_ = 0;
};

}  // namespace passo::chip
