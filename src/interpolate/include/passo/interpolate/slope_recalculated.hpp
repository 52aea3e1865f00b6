// SlopeRecalculated: a line of two axes, from hot-wire cutters. Seen from the first octant the slope that is still to go
// is compared with the slope of the whole line: below it, a step along the longer axis; at or above it, both at once.
// The first pulse is a plain step; slope 1 is all diagonal.
//
// By cross products there is no quotient: slope to go ≥ slope  ⟺  E = height_left·length − height·length_left ≥ 0.
// A plain step adds `height` to E, a diagonal one `height − length`: E stays in height − length … height − 1.
//
// Error: below one step, always on the same side of the line (it runs ahead). Lengths up to 2³¹−1.
// Portable.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <class Length = uint32_t>
class SlopeRecalculated {
 public:
  constexpr explicit SlopeRecalculated(const int32_t (&distances)[2]) : octant_(distances), left_(octant_.length) {
    // Both slopes are equal at the start, and a plain step is wanted there, but for slope 1. Height 0 has no diagonal.
    if (octant_.height != octant_.length || left_ == 0) excess_ = -1;
    first_ = excess_ < 0 && octant_.height != 0;
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    --left_;
    if (excess_ >= 0) {
      excess_ = static_cast<Signed>(excess_ + static_cast<Signed>(octant_.height - octant_.length));
      return octant_.both;
    }
    if (first_) {
      first_ = false;
      excess_ = 0;
    }
    excess_ = static_cast<Signed>(excess_ + static_cast<Signed>(octant_.height));
    return octant_.along;
  }

  constexpr int32_t excess() const { return excess_; }

 private:
  using Signed = typename LengthTraits<Length>::Signed;

  Octant<Length> octant_;
  Length left_;
  Signed excess_ = 0;
  bool first_ = false;
};

}  // namespace passo
