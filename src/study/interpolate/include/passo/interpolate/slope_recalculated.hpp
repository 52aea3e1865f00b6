// SlopeRecalculated: a line of two axes; the method comes from hot-wire cutters. In the first octant, each pulse
// compares the slope of the remaining line with the slope of the whole line. If it is smaller, the longer axis steps;
// otherwise both axes step. The first pulse is a plain step. At slope 1 all pulses are diagonal.
//
// Cross products avoid the quotient: remaining slope ≥ slope  ⟺  E = height_left·length − height·length_left ≥ 0. A
// plain step adds `height` to E, a diagonal one `height − length`: E stays in height − length … height − 1.
//
// Error: along the shorter axis the tool is −E/length off the line: up to 1 − slope ahead and up to slope behind. It is
// ahead by ½ − slope on average, so the error is biased unless the slope is ½. Lengths up to 2³¹−1. Portable.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <class Length = uint32_t>
class SlopeRecalculated {
 public:
  constexpr explicit SlopeRecalculated(const int32_t (&distances)[2])
      : octant_(distances), left_(octant_.length), starting_(octant_.height != octant_.length) {
    if (octant_.height == 0) excess_ = -1;  // stays negative: no diagonals
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    --left_;
    if (excess_ >= 0 && !starting_) {
      excess_ = static_cast<Signed>(excess_ + static_cast<Signed>(octant_.height - octant_.length));
      return octant_.both;
    }
    starting_ = false;
    excess_ = static_cast<Signed>(excess_ + static_cast<Signed>(octant_.height));
    return octant_.along;
  }

  constexpr int32_t excess() const { return excess_; }

 private:
  using Signed = typename LengthTraits<Length>::Signed;

  Octant<Length> octant_;
  Length left_;
  bool starting_;  // the first pulse is a plain step although both slopes are equal
  Signed excess_ = 0;
};

}  // namespace passo
