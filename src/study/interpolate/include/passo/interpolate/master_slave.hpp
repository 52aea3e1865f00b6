// MasterSlave: a line by rounding, the reference form. The axis with the most steps, m, is the master and steps at
// every pulse k = 1 … m. A slave with s steps is at round(k·s/m), halves away from zero.
//
// A slave at position p makes its next step when the ideal line, k·s/m, reaches p + ½, the midpoint between p and the
// next step. Both sides are multiplied by 2m, which gives integers that only increase: `reached` = 2ks, `middle` = (2p
// + 1)m.
//
// Any number of axes, lengths up to 2³¹−1. Error: at most half a step on each axis. lean.hpp is the same without
// products, for an interrupt. Portable.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <uint8_t axes, class Length = uint32_t>
class MasterSlave {
 public:
  constexpr explicit MasterSlave(const int32_t (&distances)[axes]) : line_(distances), left_(line_.longest) {
    for (Square& middle : middle_) middle = line_.longest;
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    uint8_t steps = 0;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      reached_[axis] += 2 * static_cast<Square>(line_.lengths[axis]);
      if (reached_[axis] >= middle_[axis]) {
        steps = static_cast<uint8_t>(steps | axis_bit(axis));
        middle_[axis] += 2 * static_cast<Square>(line_.longest);
      }
    }
    --left_;
    return {steps, line_.directions};
  }

  // 2ks and (2p + 1)m are at most 2·(2³¹−1)² plus 2m, which fits 63 bits.
  constexpr int64_t reached(uint8_t axis) const { return reached_[axis]; }
  constexpr int64_t middle(uint8_t axis) const { return middle_[axis]; }

 private:
  using Square = typename LengthTraits<Length>::Square;

  Line<axes, Length> line_;
  Length left_;
  Square reached_[axes] = {};
  Square middle_[axes] = {};
};

}  // namespace passo
