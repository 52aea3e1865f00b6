// BresenhamLine: a line with a master and slaves, in a form for an interrupt. It makes the same pulses as
// master_slave.hpp.
//
// m is the number of the master's steps, s that of an axis. Each axis has one decision variable D. D starts at −m, and
// each pulse adds 2s. If D ≥ 0 the axis steps and D is reduced by 2m. D has the same parity as m, so ⌊D/2⌋ decides
// equally well: d starts at −⌈m/2⌉, is increased by s and reduced by m. Then d stays in −m … −1 between pulses and in
// −m … s−1 within one, and fits the signed word of a length:
//
//      d:  −m ─────────── −1 │ 0 … s−1
//                  + s ──────▶ steps, − m
//
// "d ≥ 0" tests a single bit. On an 8-bit chip that is cheaper than a comparison of all bytes.
//
// A widely copied listing uses one variable for all axes, or a start at +m. It ends one step too far:
// docs/interpolation/master-slave.md shows it.
//
// Any number of axes, lengths up to 2³¹−1. Error: at most half a step on each axis. Portable. Cost:
// docs/interpolation/costs.md.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <uint8_t axes, class Length = uint32_t>
class BresenhamLine {
 public:
  constexpr explicit BresenhamLine(const int32_t (&distances)[axes]) : line_(distances), left_(line_.longest) {
    const Length half = static_cast<Length>(line_.longest - line_.longest / 2);
    for (uint8_t axis = 0; axis < axes; ++axis) {
      decision_[axis] = static_cast<Signed>(-static_cast<Signed>(half));
      if (line_.lengths[axis] == line_.longest) masters_ = static_cast<uint8_t>(masters_ | axis_bit(axis));
    }
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    uint8_t steps = masters_;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      if ((masters_ & axis_bit(axis)) != 0) continue;
      Signed decision = static_cast<Signed>(decision_[axis] + static_cast<Signed>(line_.lengths[axis]));
      if (decision >= 0) {
        steps = static_cast<uint8_t>(steps | axis_bit(axis));
        decision = static_cast<Signed>(decision - static_cast<Signed>(line_.longest));
      }
      decision_[axis] = decision;
    }
    --left_;
    return {steps, line_.directions};
  }

  // Returns D = −m + 2ks − 2pm of an axis at position p after k pulses.
  constexpr int64_t decision(uint8_t axis) const {
    if (line_.longest == 0) return 0;
    return 2 * int64_t{decision_[axis]} + (line_.longest & 1);
  }

 private:
  using Signed = typename LengthTraits<Length>::Signed;

  Line<axes, Length> line_;
  Length left_;
  uint8_t masters_ = 0;  // the axes that step at every pulse, without a decision
  Signed decision_[axes] = {};
};

}  // namespace passo
