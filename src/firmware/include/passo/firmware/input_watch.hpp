// InputWatch: the one input of a board that is captured, and the motors' place when it changed first.
//
// The input is the probe, or the one limit switch that a host has named. That switch captures instead of stopping, so
// that an axis can be homed by it. All other limit switches stop the motors. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

template <uint8_t most_motors>
class InputWatch {
 public:
  // `limit` is the bit of a limit switch; 0: the probe.
  void watch(uint8_t limit) { limit_ = limit; }
  uint8_t limit() const { return limit_; }
  // From now on the next change counts as the first one.
  void forget() { kept_ = Kept::nothing; }

  // Bits of BoardInput: input() is the one that is captured, stopping() those that stop the motors when they go on.
  uint16_t input() const { return limit_ != 0 ? uint16_t{limit_} : uint16_t{input_probe}; }
  uint16_t stopping() const {
    return static_cast<uint16_t>(input_emergency_stop | (all_limits & static_cast<uint8_t>(~limit_)));
  }

  bool has_kept() const { return kept_ != Kept::nothing; }
  // The input bits of a captured that reports what was kept.
  uint16_t kept_input() const {
    uint16_t input = captured_kept;
    if (kept_ != Kept::nothing) input |= this->input();
    if (kept_ == Kept::opening) input |= captured_released;
    return input;
  }
  // Whether this is the first change; its positions must then be kept. `captured` is the input of a captured.
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
