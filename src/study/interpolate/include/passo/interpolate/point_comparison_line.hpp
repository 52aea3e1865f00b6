// PointComparisonLine: a line of two axes, one axis per pulse, never a diagonal. The deviation
//
//      F = |xe|·y − |ye|·x
//
// determines on which side of the line the tool is. A pulse has four phases: evaluate the deviation, step one axis,
// compute the new deviation, test for the end. F ≥ 0 steps X and reduces F by |ye|. F < 0 steps Y and increases F by
// |xe|. F stays in −|ye| … |xe| − 1.
//
// An axis that has reached its end yields to the other. With X at its end F = |xe|·(y − |ye|) is negative until Y has
// reached its end. With Y at its end F = |ye|·(|xe| − x) is positive until X has reached its end. So the deviation
// itself makes the axis yield, except if an axis has zero length.
//
// Three tests for the end give the same pulses: a counter for each axis, for the longer axis, or for all pulses. Error:
// at most one step. Lengths up to 2³¹−1. Portable.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

// One counter for each axis. The end is reached when both are zero.
template <class Length>
class EndByCoordinates {
 public:
  constexpr explicit EndByCoordinates(const Line<2, Length>& line) : x_(line.lengths[0]), y_(line.lengths[1]) {}
  constexpr void fed(uint8_t axis) { --(axis == 0 ? x_ : y_); }
  template <class Deviation>
  constexpr bool reached(Deviation) const {
    return x_ == 0 && y_ == 0;
  }

 private:
  Length x_;
  Length y_;
};

// One counter, for the longer axis. It is not sufficient that it is zero: the shorter axis must have reached its end,
// too, which F = 0 indicates.
template <class Length>
class EndByProjection {
 public:
  constexpr explicit EndByProjection(const Line<2, Length>& line)
      : left_(line.longest), longer_(line.lengths[0] < line.lengths[1] ? 1 : 0) {}
  constexpr void fed(uint8_t axis) {
    if (axis == longer_) --left_;
  }
  template <class Deviation>
  constexpr bool reached(Deviation deviation) const {
    return left_ == 0 && deviation == 0;
  }

 private:
  Length left_;
  uint8_t longer_;
};

// One counter for all pulses. It starts at |xe| + |ye|.
template <class Length>
class EndByTotal {
 public:
  constexpr explicit EndByTotal(const Line<2, Length>& line)
      : left_(static_cast<Length>(line.lengths[0] + line.lengths[1])) {}
  constexpr void fed(uint8_t) { --left_; }
  template <class Deviation>
  constexpr bool reached(Deviation) const {
    return left_ == 0;
  }

 private:
  Length left_;
};

template <class Length = uint32_t, template <class> class End = EndByTotal>
class PointComparisonLine {
 public:
  constexpr explicit PointComparisonLine(const int32_t (&distances)[2]) : line_(distances), end_(line_) {}

  constexpr bool done() const { return end_.reached(deviation_); }
  constexpr Pulse next() {
    const uint8_t axis = deviation_ >= 0 && line_.lengths[0] != 0 ? 0 : 1;
    if (axis == 0) {
      deviation_ = static_cast<Signed>(deviation_ - static_cast<Signed>(line_.lengths[1]));
    } else {
      deviation_ = static_cast<Signed>(deviation_ + static_cast<Signed>(line_.lengths[0]));
    }
    end_.fed(axis);
    return {axis_bit(axis), line_.directions};
  }

  constexpr int32_t deviation() const { return deviation_; }

 private:
  using Signed = typename LengthTraits<Length>::Signed;

  Line<2, Length> line_;
  Signed deviation_ = 0;
  End<Length> end_;
};

}  // namespace passo
