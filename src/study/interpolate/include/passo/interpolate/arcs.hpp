// Arcs of two axes about the origin, pulse by pulse. The three methods differ only in their decisions; all use
// ArcTravel (arc_travel.hpp). Any start, both directions, every quadrant and full circles; every arc ends exactly on
// its end point.
//
//   PointComparisonArc   one axis per pulse: on or outside the circle towards the centre, inside away from it. Error:
//                        one step at most.
//   MidpointArc          diagonals allowed (Bresenham's circle): one axis always steps, the other depends on the
//                        side of the circle on which the midpoint between its two positions lies. Error: half a step
//                        at most.
//   DdaArc               the integrator of each axis adds the other's distance: dx = −y·dt, dy = x·dt. Pulses in which
//                        nothing moves are part of the method. Error: docs/interpolation/arcs.md.
//
// Radii up to 2³¹−1 (uint16_t: 32 767). Sources: J. Bresenham, "A linear algorithm for incremental digital display of
// circular arcs", CACM 20 (1977); M. Pitteway, "Algorithm for drawing ellipses or hyperbolae with a digital plotter",
// Computer Journal 10 (1967). Portable.
#pragma once

#include "passo/interpolate/arc_travel.hpp"
#include "passo/interpolate/dda.hpp"

namespace passo {

template <class Length = uint32_t>
class PointComparisonArc {
 public:
  constexpr explicit PointComparisonArc(const ArcPoints& arc) : travel_(arc) {}

  constexpr bool done() const { return travel_.done(); }
  constexpr Pulse next() {
    const bool outside = travel_.deviation() >= 0;
    return travel_.step(outside, !outside);
  }
  constexpr int64_t deviation() const { return travel_.deviation(); }

 private:
  ArcTravel<Length> travel_;
};

template <class Length = uint32_t>
class MidpointArc {
 public:
  constexpr explicit MidpointArc(const ArcPoints& arc) : travel_(arc) {}

  constexpr bool done() const { return travel_.done(); }
  constexpr Pulse next() {
    const Square falling = travel_.falling();
    const Square rising = travel_.rising();
    if (falling > rising) {
      // Steep: tests F at (falling − ½, rising + 1), minus a quarter.
      return travel_.step(travel_.deviation() + 2 * rising + 1 - falling >= 0, true);
    }
    // Flat: tests F at (falling − 1, rising + ½), minus a quarter.
    return travel_.step(true, travel_.deviation() - 2 * falling + 1 + rising < 0);
  }
  constexpr int64_t deviation() const { return travel_.deviation(); }

 private:
  using Square = typename LengthTraits<Length>::Square;
  ArcTravel<Length> travel_;
};

template <class Length = uint32_t>
class DdaArc {
 public:
  static constexpr uint8_t most_bits = LengthTraits<Length>::bits - 1;

  constexpr explicit DdaArc(const ArcPoints& arc, DdaLoad load = DdaLoad::zero) : travel_(arc) {
    if (travel_.done()) return;
    unit_ = static_cast<Length>(Length{1} << (LengthTraits<Length>::bits - fewest_bits(travel_.reach())));
    falling_register_ = static_cast<Length>(travel_.falling() * unit_);
    rising_register_ = static_cast<Length>(travel_.rising() * unit_);
    if (load == DdaLoad::half) falling_sum_ = rising_sum_ = static_cast<Length>(Length{1} << most_bits);
  }

  constexpr bool done() const { return travel_.done(); }
  constexpr Pulse next() {
    const uint8_t quadrant = travel_.quadrant();
    falling_sum_ = static_cast<Length>(falling_sum_ + rising_register_);
    rising_sum_ = static_cast<Length>(rising_sum_ + falling_register_);
    bool fall = falling_sum_ < rising_register_;  // the carries
    bool rise = rising_sum_ < falling_register_;
    // Each axis stops at its own end. The remaining steps of the other axis then follow immediately, because its
    // integrand may be 0.
    if (travel_.fall_is_over()) fall = false, rise = true;
    if (travel_.rise_is_over()) rise = false, fall = true;
    const Pulse pulse = travel_.step(fall, rise);
    if (fall) falling_register_ = static_cast<Length>(falling_register_ - unit_);
    if (rise) rising_register_ = static_cast<Length>(rising_register_ + unit_);
    if (travel_.quadrant() != quadrant) change_parts();
    return pulse;
  }
  constexpr int64_t deviation() const { return travel_.deviation(); }
  // Returns the accumulator of an axis (0 or 1), in steps. It overflows at 2ᴺ, N = register_bits().
  constexpr uint32_t accumulator(uint8_t axis) const {
    if (unit_ == 0) return 0;
    const Length sum = axis == (travel_.quadrant() & 1) ? falling_sum_ : rising_sum_;
    return static_cast<uint32_t>(sum >> (fewest_bits(unit_) - 1));
  }
  constexpr uint8_t register_bits() const { return fewest_bits(travel_.reach()); }

 private:
  constexpr void change_parts() {
    falling_register_ = rising_register_;
    rising_register_ = 0;
    const Length sum = falling_sum_;
    falling_sum_ = rising_sum_;
    rising_sum_ = sum;
  }

  ArcTravel<Length> travel_;
  Length unit_ = 0;              // one step, in units of the registers
  Length falling_register_ = 0;  // distances, in the high bits of the word
  Length rising_register_ = 0;
  Length falling_sum_ = 0;  // the accumulators for the falling and for the rising axis
  Length rising_sum_ = 0;
};

}  // namespace passo
