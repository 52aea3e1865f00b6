// HostSilence: how long a board has not heard its host, and which outputs are to end for it.
//
// A board whose host was killed or cut off ends its motion and then switches its outputs off. What comes after may not
// move with a spindle that stands: the board takes no replacement until the host has sent outputs or a hello. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

class HostSilence {
 public:
  // The host was heard.
  void end() { tenths_ = 0; }
  // Call ten times a second.
  void count() {
    if (tenths_ != most) ++tenths_;
  }
  void allow(const Silence& silence) { allowed_ = silence; }
  // The outputs whose time is over. Bits of OutputSwitch.
  uint8_t late() const {
    uint8_t late = 0;
    if (is_over(allowed_.spindle)) late |= spindle_on;
    if (is_over(allowed_.mist)) late |= mist_on;
    if (is_over(allowed_.flood)) late |= flood_on;
    return late;
  }

  // The host has been silent for so many tenths of a second; never for 0.
  bool is_over(uint8_t allowed) const { return allowed != 0 && tenths_ >= allowed; }

  // A host has said hello.
  void begin() { off_ = let_go_ = false; }
  // Outputs were switched off, and no host has sent outputs since.
  void set_off() { off_ = true; }
  void forget_off() { off_ = false; }
  // The drivers were switched off, and no host has said hello since.
  void set_released() { let_go_ = true; }
  // Both, as bits of a status's inputs.
  uint16_t bits() const {
    return static_cast<uint16_t>((off_ ? outputs_timed_out : 0) | (let_go_ ? drivers_timed_out : 0));
  }

 private:
  static constexpr uint8_t most = 0xFF;

  uint8_t tenths_ = 0;  // of a second, since the host was heard
  Silence allowed_;     // as the last session said
  bool off_ : 1 = false, let_go_ : 1 = false;
};

}  // namespace passo
