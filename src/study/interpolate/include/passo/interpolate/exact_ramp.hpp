// ExactRamp: constant acceleration with exact times. Step n happens at t_n = K_b √n. T_n is t_n rounded to a tick, and
// c_n = T_(n+1) − T_n.
//
// T_n is stored with its remainder R_n = K_b² n − T_n², so errors do not accumulate. From one step to the next R grows
// by K_b² (when decelerating it shrinks), and T moves by an estimate of the interval. T is the rounded root when −T < R
// <= T; until then T is corrected by R / 2T (Newton). The estimate is c_(n+1) = c_n − 2 c_n / (4n + 5), so good that
// nearly all corrections are a single tick or none. It takes one 32-bit division per step. 64-bit divisions, at most
// three, occur in 49 of the first 10 000 steps for K_b = 10^4 and in 166 for K_b = 10^5, most of them at the beginning.
//
// Errors: each T_n is within half a tick and each interval within one tick of the real value, without limit. K_b² is
// given as a whole number; rounding a real K_b² shifts t_n by √n / 4K_b ticks more. Ranges: 1 <= K_b < 2^32 ticks,
// steps up to 2^30. R is computed modulo 2^64 until T is nearly right. Portable.
#pragma once

#include <stdint.h>

#include "passo/interpolate/root.hpp"

namespace passo {

class ExactRamp {
 public:
  using Interval = uint32_t;

  // `first_squared`: K_b², in ticks².
  explicit constexpr ExactRamp(uint64_t first_squared)
      : first_squared_(first_squared),
        interval_(rounded_root(first_squared)),
        end_(interval_),
        remainder_(first_squared - uint64_t{interval_} * interval_) {}

  constexpr uint32_t index() const { return index_; }
  // Returns c_n of the current index n, in ticks. It may become 0 at high n: from about n = K_b²/4 on.
  constexpr uint32_t interval() const { return interval_; }
  constexpr uint32_t fastest() const { return 1; }
  // Returns T_(n+1), in ticks: the time from the start to the end of the current step.
  constexpr uint64_t end() const { return static_cast<uint64_t>(end_); }

  // Goes to n + 1.
  constexpr void rise() {
    const int64_t start = end_;
    ++index_;
    remainder_ += first_squared_;
    move_by(index_ == 1 ? interval_ / 2 : interval_ - 2 * interval_ / (4 * index_ + 1));
    settle();
    interval_ = static_cast<uint32_t>(end_ - start);
  }
  // Goes to n − 1. Requires n > 0.
  constexpr void fall() {
    remainder_ -= first_squared_;
    move_by(-int64_t{interval_});
    if (index_ == 1) {
      interval_ = static_cast<uint32_t>(end_);
    } else {
      const int64_t end = end_;
      remainder_ -= first_squared_;
      move_by(-int64_t{interval_ + 2 * interval_ / (4 * index_ - 1)});
      settle();
      interval_ = static_cast<uint32_t>(end - end_);
      remainder_ += first_squared_;
      move_by(interval_);
    }
    --index_;
  }

 private:
  // Moves T to another value with the same T² + R.
  constexpr void move_by(int64_t ticks) {
    remainder_ -= static_cast<uint64_t>(ticks) * static_cast<uint64_t>(2 * end_ + ticks);
    end_ += ticks;
  }
  // Makes T the rounded root. Most corrections are a single tick and need no division.
  constexpr void settle() {
    for (;;) {
      const int64_t rest = static_cast<int64_t>(remainder_);
      if (rest > end_) {
        move_by(rest > 3 * end_ && end_ > 0 ? rest / (2 * end_) : 1);
      } else if (rest <= -end_ && end_ > 0) {
        move_by(rest < -3 * end_ ? rest / (2 * end_) : -1);
      } else {
        return;
      }
    }
  }

  uint64_t first_squared_;
  uint32_t index_ = 0;
  uint32_t interval_;
  int64_t end_;         // T_(n+1)
  uint64_t remainder_;  // K_b² (n+1) − T_(n+1)², in two's complement
};

}  // namespace passo
