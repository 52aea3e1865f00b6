// ArcTravel: tracks the progress along an arc in steps. Point comparison, DDA and midpoint share it; they only decide
// which axis is to step.
//
// The centre is the origin, R² = xs² + ys². An arc is divided where it crosses an axis. In each piece one axis falls
// towards zero and the other rises; in the next piece they swap roles:
//
//            y                   counterclockwise:
//        1   │   0               quadrant 0: x falls, y rises      direction bits  x down
//     ───────┼─────── x                   1: y falls, x rises                      x down, y down
//        2   │   3                        2: x falls, y rises                      y down
//            │                            3: y falls, x rises                      -
//
// Clockwise is the same with y mirrored. A piece ends at the axis crossing (0, R rounded), the last one at the end
// point. An axis that has reached its end yields to the other, so every arc ends exactly.
//
// Start and end may be any points whose distances from the centre differ by less than a step. Equal points are a full
// circle. Coordinates up to 2³¹−1. The deviation F = x² + y² − R² stays within 2·2³¹ of zero. Portable: one integer
// square root and no division, before the first pulse.
#pragma once

#include "passo/interpolate/line.hpp"
#include "passo/interpolate/root.hpp"

namespace passo {

struct ArcPoints {  // in steps, from the centre
  int32_t start[2] = {0, 0};
  int32_t end[2] = {0, 0};
  bool clockwise = false;
};

template <class Length = uint32_t>
class ArcTravel {
 public:
  using Square = typename LengthTraits<Length>::Square;

  constexpr explicit ArcTravel(const ArcPoints& arc) {
    const int32_t mirror = arc.clockwise ? -1 : 1;
    const int32_t start[2] = {arc.start[0], arc.start[1] * mirror};
    const int32_t end[2] = {arc.end[0], arc.end[1] * mirror};
    mirror_ = arc.clockwise ? axis_bit(1) : uint8_t{0};
    if (start[0] == 0 && start[1] == 0) return;
    quadrant_ = quadrant_after(start);
    crossings_ = static_cast<uint8_t>((quadrant_before(end) - quadrant_) & 3);
    const int64_t ahead = int64_t{start[0]} * end[1] - int64_t{start[1]} * end[0];
    if (crossings_ == 0 && ahead <= 0) crossings_ = 4;

    const uint8_t falls = quadrant_ & 1;
    falling_ = magnitude<Length>(start[falls]);
    rising_ = magnitude<Length>(start[1 - falls]);
    const uint8_t falls_last = quadrant_before(end) & 1;
    end_falling_ = magnitude<Length>(end[falls_last]);
    end_rising_ = magnitude<Length>(end[1 - falls_last]);
    crossing_ = static_cast<Length>(rounded_root(square_of(falling_) + square_of(rising_)));
    begin_piece();
  }

  constexpr bool done() const { return crossings_ == 0 && falling_ == falls_to_ && rising_ == rises_to_; }

  // The tool's distances from the axes: that of the falling axis and that of the rising one.
  constexpr Length falling() const { return falling_; }
  constexpr Length rising() const { return rising_; }
  constexpr Square deviation() const { return deviation_; }
  // Returns the maximum of either distance anywhere on the arc.
  constexpr Length reach() const {
    const Length end = end_falling_ > end_rising_ ? end_falling_ : end_rising_;
    return crossing_ > end ? crossing_ : end;
  }
  // Returns true when that axis has reached the end of the piece; it then yields to the other.
  constexpr bool fall_is_over() const { return falling_ == falls_to_; }
  constexpr bool rise_is_over() const { return rising_ == rises_to_; }
  // The current quadrant. It changes where the arc crosses an axis.
  constexpr uint8_t quadrant() const { return quadrant_; }

  // Makes one pulse: the requested steps, as far as the piece allows them. At least one axis steps if any is requested.
  constexpr Pulse step(bool fall, bool rise) {
    if (fall && fall_is_over()) {
      fall = false;
      rise = true;
    }
    if (rise && rise_is_over()) {
      rise = false;
      fall = !fall_is_over();
    }
    const uint8_t falls = quadrant_ & 1;
    Pulse pulse{0, static_cast<uint8_t>(down_in(quadrant_) ^ mirror_)};
    if (fall) {
      deviation_ -= 2 * static_cast<Square>(falling_) - 1;
      --falling_;
      pulse.steps = axis_bit(falls);
    }
    if (rise) {
      deviation_ += 2 * static_cast<Square>(rising_) + 1;
      ++rising_;
      pulse.steps = static_cast<uint8_t>(pulse.steps | axis_bit(static_cast<uint8_t>(1 - falls)));
    }
    if (crossings_ != 0 && fall_is_over() && rise_is_over()) cross();
    return pulse;
  }

 private:
  // Return the quadrant that a counterclockwise arc enters at `point`, and the one that it leaves there.
  static constexpr uint8_t quadrant_after(const int32_t (&point)[2]) {
    if (point[0] > 0 && point[1] >= 0) return 0;
    if (point[0] <= 0 && point[1] > 0) return 1;
    return point[0] < 0 ? 2 : 3;
  }
  static constexpr uint8_t quadrant_before(const int32_t (&point)[2]) {
    if (point[0] >= 0 && point[1] > 0) return 0;
    if (point[0] < 0 && point[1] >= 0) return 1;
    return point[0] <= 0 && point[1] < 0 ? 2 : 3;
  }
  static constexpr uint8_t down_in(uint8_t quadrant) {
    const uint8_t x = quadrant < 2 ? axis_bit(0) : uint8_t{0};
    const uint8_t y = quadrant == 1 || quadrant == 2 ? axis_bit(1) : uint8_t{0};
    return x | y;
  }
  static constexpr uint64_t square_of(Length length) { return static_cast<uint64_t>(length) * length; }

  constexpr void begin_piece() {
    falls_to_ = crossings_ == 0 ? end_falling_ : Length{0};
    rises_to_ = crossings_ == 0 ? end_rising_ : crossing_;
    // After the crossing, the axis that rises now falls to the end point. So it must first rise that far.
    if (crossings_ == 1 && rises_to_ < end_falling_) rises_to_ = end_falling_;
  }
  constexpr void cross() {
    falling_ = rising_;
    rising_ = 0;
    quadrant_ = (quadrant_ + 1) & 3;
    --crossings_;
    begin_piece();
  }

  uint8_t quadrant_ = 0;
  uint8_t crossings_ = 0;  // number of remaining crossings
  uint8_t mirror_ = 0;     // the direction bits that a clockwise arc inverts
  Length falling_ = 0;
  Length rising_ = 0;
  Length falls_to_ = 0;
  Length rises_to_ = 0;
  Length crossing_ = 0;
  Length end_falling_ = 0;
  Length end_rising_ = 0;
  Square deviation_ = 0;
};

}  // namespace passo
