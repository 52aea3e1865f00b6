// The exact, the recursive and the midpoint ramp in real numbers. The integers on the chip are compared with them, and
// `passo ramp` prints them.
//
// They walk over the index n, like interpolate/table_ramp.hpp and exact_ramp.hpp, and can be used in a RampMove. Ticks
// are real numbers. The maximum relative differences of an interval from the exact one are:
//
//   exact       c_n = K_b / (√(n+1) + √n)         none; 1e-15 of rounding, without a difference of large numbers
//   recursive   c_n = c_(n−1) / (1 + 2 (c_(n−1)/K_b)²)   too short: by 19.5 % at n = 1, always by less than
//               (ln n + 2.4) / 8n
//   midpoint    c_n² + (c_(n−1) + K_b²/c_(n−1))·c_n − K_b² = 0   none: another formula for the exact sequence
//
// tests/real_ramp_test.cpp measures these differences, and those of the table.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace passo {

class RealExactRamp {
 public:
  using Interval = double;

  explicit RealExactRamp(double first_interval) : first_(first_interval) {}

  double interval() const { return first_ / (std::sqrt(number() + 1) + std::sqrt(number())); }
  double fastest() const { return 0; }
  // Returns K_b √(n+1), in ticks: the time from standstill to the end of the current step.
  double end() const { return first_ * std::sqrt(number() + 1); }
  void rise() { ++index_; }
  void fall() { --index_; }

 private:
  double number() const { return static_cast<double>(index_); }

  double first_;
  std::int64_t index_ = 0;
};

class RealRecursiveRamp {
 public:
  using Interval = double;

  explicit RealRecursiveRamp(double first_interval) : first_(first_interval), interval_(first_interval) {}

  double interval() const { return interval_; }
  double fastest() const { return 0; }
  void rise() {
    const double share = interval_ / first_;
    interval_ /= 1 + 2 * share * share;
    ++index_;
  }
  // Computes the previous interval: the smaller root of the recursion. A rounding error at index n grows to n times its
  // size at index 0.
  void fall() {
    const double share = interval_ / first_;
    --index_;
    interval_ = index_ == 0 ? first_ : 2 * interval_ / (1 + std::sqrt(1 - 8 * share * share));
  }

 private:
  double first_;
  double interval_;
  std::int64_t index_ = 0;
};

// The recursion with the time between the *midpoints* of two intervals, (c_(n−1) + c_n)/2, because a mean speed is
// reached at the midpoint: ω_n = ω_(n−1) + a·(c_(n−1) + c_n)/2f. This is a quadratic equation in c_n. From c_0 = K_b
// its positive roots are the exact intervals: 1/c_n − 1/c_(n−1) = (√(n+1) − √(n−1))/K_b = (c_(n−1) + c_n)/K_b².
class RealMidpointRamp {
 public:
  using Interval = double;

  explicit RealMidpointRamp(double first_interval) : first_(first_interval), interval_(first_interval) {}

  double interval() const { return interval_; }
  double fastest() const { return 0; }
  void rise() {
    const double half = (interval_ + first_ / interval_ * first_) / 2;
    // The root as a quotient: a difference of two nearly equal numbers would lose digits.
    interval_ = first_ * first_ / (half + std::hypot(half, first_));
    ++index_;
  }
  // The same equation for c_(n−1): c_(n−1)² − (K_b²/c_n − c_n)·c_(n−1) + K_b² = 0, the smaller root. Rounding errors
  // grow when decelerating: starting from index n, the relative error of the first intervals reaches n²·10⁻¹⁶.
  void fall() {
    --index_;
    const double half = (first_ / interval_ * first_ - interval_) / 2;
    interval_ =
        index_ == 0 ? first_ : first_ * first_ / (half + std::sqrt(std::max(0.0, (half - first_) * (half + first_))));
  }

 private:
  double first_;
  double interval_;
  std::int64_t index_ = 0;
};

}  // namespace passo
