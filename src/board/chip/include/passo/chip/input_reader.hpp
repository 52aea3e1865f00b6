// InputReader: finds the state of the board's switches from the state of its pins.
//
// Buttons that the operator presses are debounced: a state counts after three equal samples, some milliseconds apart. A
// limit switch or a probe counts at once. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

class InputReader {
 public:
  static constexpr uint16_t pressed_by_people = input_door | input_hold | input_start;
  static constexpr uint8_t steady_looks = 3;

  // `raw` has bits of BoardInput, set where the switch is on. `tick` means that some milliseconds have passed since the
  // last tick. `by_people`: the debounced inputs. Returns the inputs that have just become triggered.
  uint16_t update(uint16_t raw, bool tick, uint16_t by_people = pressed_by_people) {
    const uint16_t before = inputs_;
    const uint16_t buttons = raw & by_people;
    if (buttons != candidate_) {
      candidate_ = buttons;
      looks_ = 0;
    } else if (tick && looks_ < steady_looks) {
      ++looks_;
    }
    const uint16_t steady = looks_ == steady_looks ? candidate_ : static_cast<uint16_t>(inputs_ & by_people);
    inputs_ = static_cast<uint16_t>((raw & ~by_people) | steady);
    return static_cast<uint16_t>(inputs_ & ~before);
  }
  uint16_t inputs() const { return inputs_; }

 private:
  uint16_t inputs_ = 0;
  uint16_t candidate_ = 0;
  uint8_t looks_ = 0;
};

}  // namespace passo
