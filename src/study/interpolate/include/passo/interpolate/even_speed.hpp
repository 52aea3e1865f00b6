// PulseDurations: the duration of each pulse of a line that makes the tool move at constant speed.
//
// There are two rules. Both divide the time T of the move among its pulses:
//
//   by_roots   a pulse of two axes moves the tool √2 times as far as a plain one, of three √3 times: with N1, N2, N3 …
//              pulses of each kind a plain one lasts T / (N1 + N2·√2 + N3·√3 …). Any path, if its pulses are counted.
//              The tool's speed is constant; its position along the ideal path is not exact in time.
//   exact      the projection of the tool onto the ideal line moves at constant speed: a step of an axis with length d
//              moves it by d/L, so it lasts T·d/L² (L² = Σd²), and a pulse lasts the sum of its axes. Σ d·T·d/L² = T.
//              Any line method.
//
// Durations are in timer ticks, in 32.32 fixed point: over 2³¹ pulses the sum is within a tick of T. next() returns
// whole ticks and carries the fraction over. Divisions use shift and subtract, before the first pulse only. T is below
// 2³² ticks, Σd² below 2⁶⁴ (four axes of full length). Portable.
#pragma once

#include "passo/interpolate/line.hpp"
#include "passo/interpolate/root.hpp"

namespace passo {

// Returns numerator / denominator in 32.32, rounded to nearest. The quotient is below 2³²; denominator > 0.
constexpr uint64_t fixed_quotient(uint64_t numerator, uint64_t denominator) {
  uint64_t quotient = numerator / denominator;
  uint64_t rest = numerator % denominator;
  for (uint8_t bit = 0; bit < 33; ++bit) {  // the last iteration rounds the quotient
    const bool carry = (rest >> 63) != 0;
    rest <<= 1;
    const bool one = carry || rest >= denominator;
    if (one) rest -= denominator;
    if (bit == 32) return quotient + (one ? 1 : 0);
    quotient = quotient << 1 | (one ? 1 : 0);
  }
  return quotient;
}

template <uint8_t axes>
class PulseDurations {
 public:
  // Returns √n in 2.30 fixed point.
  static constexpr uint32_t root(uint8_t n) { return rounded_root(static_cast<uint64_t>(n) << 60); }

  // `pulses[n]` is the number of pulses that move n axes; at least one of them is above 0.
  static constexpr PulseDurations by_roots(uint32_t ticks, const uint32_t (&pulses)[axes + 1]) {
    PulseDurations durations(true);
    uint64_t length = 0;
    for (uint8_t n = 1; n <= axes; ++n) length += static_cast<uint64_t>(pulses[n]) * root(n);
    for (uint8_t n = 1; n <= axes; ++n) {
      durations.share_[n - 1] = fixed_quotient(static_cast<uint64_t>(ticks) * root(n), length);
    }
    return durations;
  }
  // At least one distance must be non-zero.
  static constexpr PulseDurations exact(uint32_t ticks, const int32_t (&distances)[axes]) {
    PulseDurations durations(false);
    const Line<axes, uint32_t> line(distances);
    uint64_t square = 0;
    for (const uint32_t length : line.lengths) square += static_cast<uint64_t>(length) * length;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      durations.share_[axis] = fixed_quotient(static_cast<uint64_t>(ticks) * line.lengths[axis], square);
    }
    return durations;
  }

  // Returns the duration of a pulse in 32.32 ticks; 0 if nothing moves.
  constexpr uint64_t of(Pulse pulse) const {
    uint64_t sum = 0;
    uint8_t count = 0;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      if ((pulse.steps & axis_bit(axis)) == 0) continue;
      sum += share_[axis];
      ++count;
    }
    if (!by_count_) return sum;
    return count == 0 ? 0 : share_[count - 1];
  }
  // Returns the duration in whole ticks, carrying the fraction over.
  constexpr uint32_t next(Pulse pulse) {
    const uint64_t sum = of(pulse) + fraction_;
    fraction_ = static_cast<uint32_t>(sum);
    return static_cast<uint32_t>(sum >> 32);
  }

 private:
  constexpr explicit PulseDurations(bool by_count) : by_count_(by_count) {}

  bool by_count_;
  uint64_t share_[axes] = {};              // for a pulse of n + 1 axes, or for axis n
  uint32_t fraction_ = uint32_t{1} << 31;  // starts at half a tick, so that the running time is rounded and not
                                           // truncated
};

}  // namespace passo
