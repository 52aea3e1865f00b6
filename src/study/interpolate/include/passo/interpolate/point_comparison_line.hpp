// PointComparisonLine: a line of two axes, one axis a pulse, never a diagonal. The deviation
//
//      F = |xe|·y − |ye|·x
//
// tells on which side of the line the tool stands. A pulse has four beats: judge the deviation, feed one axis, compute
// the new deviation, judge the end. F ≥ 0 feeds X, and F loses |ye|. F < 0 feeds Y, and F gains |xe|. F stays in −|ye|
// … |xe| − 1.
//
// An axis that has arrived yields to the other. With X at its end F = |xe|·(y − |ye|) is negative until Y has arrived.
// With Y at its end F = |ye|·(|xe| − x) is positive until X has arrived. So the deviation itself makes the axis yield,
// except where an axis has no length at all.
//
// Three ways to judge the end make the same pulses: count each axis, the longer axis, or all pulses.
// Error: at most one step. Lengths up to 2³¹−1.
// Portable.
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

// One counter, of the longer axis. Its zero is not enough: the shorter axis must have arrived too, which F = 0 shows.
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

// One counter of all pulses. It starts at |xe| + |ye|.
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
