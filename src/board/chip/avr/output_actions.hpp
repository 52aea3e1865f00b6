// OutputActions: states to which the outputs will be switched, each after a certain event. The step timer's interrupt
// switches them: an action rides on the queue of turns, or waits at the end of the ring.
//
// Invariant: an action is the state of the ports, not a change of it. So the interrupt and the main loop, which may not
// have seen the interrupt's work, may both do the same action. Actions never come out of order: an action that is put
// while nothing plays is done at once.
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

  // Adds an action after all events made so far. `rests` tells whether none is to come.
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
  // The oldest action is done.
  static void forget() { --waiting_; }

  // Low byte of the address of the action that rides on the next event; 0: none.
  static uint8_t riding() { return riding_; }
  // Called when the event has the action.
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
  static inline uint8_t waiting_ = 0;  // not done yet, as far as the main loop knows
  static inline uint8_t riding_ = 0;
};

}  // namespace passo::chip
