// RecursiveRamp: constant acceleration. Each interval is computed from the previous one, with one division per step.
//
// The speed grows by the acceleration times the last interval. With the speed v = K_b²/c this is v_n = v_(n−1) + 2
// c_(n−1) and c_n = K_b² / v_n, rounded. It equals c_n = c_(n−1) · α f² / (α f² + a c_(n−1)²) without its products.
//
// The method itself gives intervals that are too short: by 19.5 % at n = 1, and always by less than (ln n + 2.4) / 8n.
// The integers are within one tick of the method. It only accelerates: decelerating would need a root per step.
//
// Square is uint32_t for K_b < 65536 (one 32-bit division per step, for chips) or uint64_t for K_b < 2^32. Ranges: K_b
// >= 1, and K_b² is a whole number. Up to 2^28 steps with 32 bits, 2^30 with 64. Portable.
#pragma once

#include <stdint.h>

namespace passo {

template <class Square = uint64_t>
class RecursiveRamp {
 public:
  using Interval = uint32_t;

  // K_b² in ticks², and c_0 = K_b rounded to a tick.
  constexpr RecursiveRamp(Square first_squared, uint32_t first_interval)
      : first_squared_(first_squared), speed_(first_squared / first_interval), interval_(first_interval) {}

  // Returns c_n of the current step, in ticks.
  constexpr uint32_t interval() const { return interval_; }

  // Goes to the next step.
  constexpr void rise() {
    speed_ += Square{2} * interval_;
    const Square quotient = first_squared_ / speed_;
    const Square rest = first_squared_ - quotient * speed_;
    const bool up = rest >= speed_ - rest;  // the remainder is half a tick or more: round up
    interval_ = static_cast<uint32_t>(quotient + (up ? 1 : 0));
  }

 private:
  Square first_squared_;
  Square speed_;  // K_b² / c_n
  uint32_t interval_;
};

}  // namespace passo
