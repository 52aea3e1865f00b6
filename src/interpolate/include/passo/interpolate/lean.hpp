// Lean: a line with master and slaves in the form for an interrupt. The same pulses as master_slave.hpp.
//
// One decision variable an axis, D, starts at −m; each pulse adds 2s; where it is ≥ 0 the axis steps and 2m is taken
// off. All three are even or odd together with m, so half of it decides as well: d starts at −⌈m/2⌉, gains s, loses m.
// Then d stays in −m … −1 and fits the word of a length, and "≥ 0" is the carry of the addition:
//
//      d:  −m ─────────── −1 │ 0 … s−1        word: 2ᵂ−m ───── 2ᵂ−1 │ 0 … s−1
//                  + s ──────▶ steps, − m                  + s ──────▶ carry
//
// One variable for all axes, or a start at +m, as a listing that circulates has it, ends a step too far:
// docs/interpolation/master-slave.md shows it.
//
// Any number of axes, lengths up to 2³¹−1. Error: at most half a step on each axis.
// Portable. Cost: docs/interpolation/costs.md.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <uint8_t axes, class Length = uint32_t>
class Lean {
 public:
  constexpr explicit Lean(const int32_t (&distances)[axes]) : line_(distances), left_(line_.longest) {
    const Length half = static_cast<Length>(line_.longest - line_.longest / 2);
    for (Length& decision : decision_) decision = static_cast<Length>(0 - half);
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    uint8_t steps = 0;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      const Length length = line_.lengths[axis];
      Length decision = static_cast<Length>(decision_[axis] + length);
      if (decision < length) {  // the carry
        steps = static_cast<uint8_t>(steps | axis_bit(axis));
        decision = static_cast<Length>(decision - line_.longest);
      }
      decision_[axis] = decision;
    }
    --left_;
    return {steps, line_.directions};
  }

  // D = −m + 2ks − 2pm of an axis that stands at p after k pulses.
  constexpr int64_t decision(uint8_t axis) const {
    if (line_.longest == 0) return 0;
    const int64_t half = static_cast<int64_t>(decision_[axis]) - (int64_t{1} << LengthTraits<Length>::bits);
    return 2 * half + (line_.longest & 1);
  }

 private:
  Line<axes, Length> line_;
  Length left_;
  Length decision_[axes] = {};
};

}  // namespace passo
