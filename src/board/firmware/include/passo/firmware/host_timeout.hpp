// HostTimeout: measures the time since the board last received something from its host, and selects the outputs to
// switch off.
//
// A board whose host was killed or disconnected ends its motion and then switches its outputs off. Later motion must
// not run with a stopped spindle, so the board accepts no queue update until the host has sent outputs or a hello.
// Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

class HostTimeout {
 public:
  // Call when the host has sent something.
  void end() { tenths_ = 0; }
  // Call ten times a second.
  void count() {
    if (tenths_ != most) ++tenths_;
  }
  void allow(const Silence& silence) { allowed_ = silence; }
  // Returns the outputs whose time is over, as bits of OutputSwitch.
  uint8_t late() const {
    uint8_t late = 0;
    if (is_over(allowed_.spindle)) late |= spindle_on;
    if (is_over(allowed_.mist)) late |= mist_on;
    if (is_over(allowed_.flood)) late |= flood_on;
    return late;
  }

  // Returns true if the host has been silent for this number of tenths of a second. Never true for 0.
  bool is_over(uint8_t allowed) const { return allowed != 0 && tenths_ >= allowed; }

  // Processes a hello.
  void begin() { off_ = let_go_ = false; }
  // Call when outputs were switched off; forget_off(): the host has sent outputs since.
  void set_off() { off_ = true; }
  void forget_off() { off_ = false; }
  // Call when the drivers were switched off. Cleared by a hello.
  void set_released() { let_go_ = true; }
  // Returns both states, as bits of a status's inputs.
  uint16_t bits() const {
    return static_cast<uint16_t>((off_ ? outputs_timed_out : 0) | (let_go_ ? drivers_timed_out : 0));
  }

 private:
  static constexpr uint8_t most = 0xFF;

  uint8_t tenths_ = 0;  // tenths of a second since the host last sent something
  Silence allowed_;     // as set in the last session
  bool off_ : 1 = false, let_go_ : 1 = false;
};

}  // namespace passo
