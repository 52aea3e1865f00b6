// QuadratureCounter: the count of an encoder with two lines A and B that are a quarter of a period apart, from their
// levels. Each edge is one count, so a period has four; up is A before B.
//
// Levels are read by an interrupt or a loop. A line that bounces counts up and down again. If both lines have changed
// since the last reading, an edge was missed: its direction is unknown, so it counts nothing and is a jump.
//
// Invariant: the count is the number of edges seen, forward minus back, modulo 2^32. Portable.
#pragma once

#include <stdint.h>

namespace passo {

class QuadratureCounter {
 public:
  // Levels are the bit of A and the bit of B.
  static constexpr uint8_t line_a = 1;
  static constexpr uint8_t line_b = 2;

  // Starts to count, from 0, at these levels.
  constexpr void begin(uint8_t levels) {
    *this = {};
    last_ = levels;
  }
  constexpr void update(uint8_t levels) {
    const uint8_t changed = static_cast<uint8_t>((levels ^ last_) & (line_a | line_b));
    // Before an edge forward, B is as A is after it.
    const bool is_forward = ((levels & line_a) != 0) != ((last_ & line_b) != 0);
    last_ = levels;
    if (changed == (line_a | line_b)) {
      ++jumps_;
    } else if (changed != 0) {
      count_ += is_forward ? 1U : ~uint32_t{0};
    }
  }

  constexpr uint32_t count() const { return count_; }
  // How often both lines had changed, modulo 65,536.
  constexpr uint16_t jumps() const { return jumps_; }

 private:
  uint32_t count_ = 0;
  uint16_t jumps_ = 0;
  uint8_t last_ = 0;
};

}  // namespace passo
