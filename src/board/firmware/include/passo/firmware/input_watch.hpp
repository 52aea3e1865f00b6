// InputWatch: the captured input of a board, and the motors' positions at its first change.
//
// The input is the probe, or the limit switches that a host has selected. They capture instead of stopping, so that an
// axis can be homed with them. All other limit switches stop the motors. Several selected switches act as one, which is
// triggered while any of them is. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

template <uint8_t most_motors>
class InputWatch {
 public:
  // `limit` has the bits of the selected limit switches; 0: the probe.
  void watch(uint8_t limit) { limit_ = limit; }
  uint8_t limit() const { return limit_; }
  // Returns the inputs in `changed` that count. A change of one of several watched switches counts only if it changes
  // whether any of them is triggered.
  uint16_t that_count(uint16_t changed, uint16_t before, uint16_t now) const {
    const bool several = (limit_ & (limit_ - 1)) != 0;
    if (!several || ((before & input()) != 0) != ((now & input()) != 0)) return changed;
    return static_cast<uint16_t>(changed & ~input());
  }
  // From now on the next change counts as the first one.
  void forget() { kept_ = Kept::nothing; }

  // Bits of BoardInput: input() is the captured input, stopping() are the inputs that stop the motors when triggered.
  uint16_t input() const { return limit_ != 0 ? uint16_t{limit_} : uint16_t{input_probe}; }
  uint16_t stopping() const {
    return static_cast<uint16_t>(input_emergency_stop | (all_limits & static_cast<uint8_t>(~limit_)));
  }

  // Bits of BoardState.
  uint8_t state() const {
    return static_cast<uint8_t>((kept_ != Kept::nothing ? board_kept : 0) | (limit_ != 0 ? board_homes : 0));
  }
  // Returns the input bits of a `captured` message that reports the stored change.
  uint16_t kept_input() const {
    uint16_t input = captured_kept;
    if (kept_ != Kept::nothing) input |= this->input();
    if (kept_ == Kept::opening) input |= captured_released;
    return input;
  }
  // Returns whether this is the first change; its positions must then be stored. `captured` is the input of a
  // `captured` message.
  bool keeps(uint16_t captured) {
    if ((captured & input()) == 0 || kept_ != Kept::nothing) return false;
    kept_ = (captured & captured_released) != 0 ? Kept::opening : Kept::closing;
    return true;
  }

  int32_t positions[most_motors] = {};  // at that change

 private:
  enum class Kept : uint8_t { nothing, closing, opening };
  static constexpr uint8_t all_limits = 0xFF;

  uint8_t limit_ = 0;
  Kept kept_ = Kept::nothing;
};

}  // namespace passo
