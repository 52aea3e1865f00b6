// OutputActions: scheduled output states, each applied after a certain event. The step timer's interrupt applies them:
// an action is attached to an entry of the queue of direction changes, or waits at the end of the ring.
//
// Invariant: an action is the complete state of the ports, not a change. So the interrupt and the main loop may both
// apply the same action, even if the main loop has not seen the interrupt's work. Actions stay in order: an action
// added while nothing plays is applied at once.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"
#include "wiring.hpp"

namespace passo::chip {

class OutputActions {
 public:
  // Drops all waiting actions. The action at a stop starts from the present state of the ports.
  static void clear() {
    action_at_end = 0;
    riding_ = 0;
    waiting_ = 0;
    store(safe_action, {});
  }
  static bool full() { return waiting_ == action_count; }

  // Adds an action after all events made so far. `rests` returns true if no event is left to play.
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
  // Call when the oldest action is done.
  static void forget() { --waiting_; }

  // Returns the low byte of the address of the action attached to the next event; 0: none.
  static uint8_t riding() { return riding_; }
  // Call when the event has received the action.
  static void taken() {
    riding_ = 0;
    action_at_end = 0;
  }

  static void act(uint8_t place) { Wiring::act(*at(place)); }
  // Switches all outputs off.
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
  static inline uint8_t waiting_ = 0;  // not applied yet, as far as the main loop knows
  static inline uint8_t riding_ = 0;
};

}  // namespace passo::chip
