// RampMove: whole moves of one motor with constant acceleration. A move can be stopped or given a new target at any
// time.
//
//   rate
//    cruise   ____________        The ramp's index n rises while the rate is below the target rate and there is room
//            /            \       to brake. The index falls when the remaining steps are just enough to brake. The
//           /              \      intervals of braking are those of the start, mirrored.
//   start  |                |
//
// A single comparison decides. At `height` indices above the ramp's first one, the motor needs height + 1 intervals to
// stop, and height < left always holds. Trapezoid, triangle, constant rate, stop and reversal all follow from this
// rule, and the number of steps is always exact.
//
// `start` is the shortest interval with which the motor starts, stops and reverses without a ramp (its pull-in rate).
// The ramp begins and ends at the fastest of its indices within this start/stop region; slower steps would waste time.
// If the target rate is itself within the region, the rate is constant. If the ramp's own first interval is shorter
// than `start`, the move would not begin within the region, and set_rates() refuses.
//
// Ramp is TableRamp, ExactRamp or a similar class, at index 0. Count may be uint16_t, which is cheaper on a chip, for
// moves below 65536 steps. Positions stay within ±2^30 steps. A step costs one addition and two comparisons in addition
// to the ramp's own work. Portable: no division.
#pragma once

#include <stdint.h>

namespace passo {

template <class Ramp, class Count = uint32_t>
class RampMove {
 public:
  using Interval = typename Ramp::Interval;
  using Position = int32_t;

  explicit constexpr RampMove(const Ramp& ramp) : ramp_(ramp) {}

  // `start` and `cruise` are intervals in ticks, at least 1. `start` 0 means that the motor has no start/stop region; a
  // move then begins with the ramp's first interval. Returns false if the ramp begins outside the region. May be called
  // only at standstill, and once per ramp: it advances the ramp to its first index.
  [[nodiscard]] constexpr bool set_rates(Interval start, Interval cruise) {
    cruise_ = cruise > ramp_.fastest() ? cruise : ramp_.fastest();
    if (start == 0) return true;
    if (cruise_ >= start) {
      while (ramp_.interval() > cruise_) ramp_.rise();
      return true;
    }
    if (ramp_.interval() < start) return false;
    while (ramp_.interval() >= start) ramp_.rise();
    ramp_.fall();  // the last rise() left the region: one index back
    return true;
  }

  constexpr bool done() const { return left_ == 0 && leg_end_ == target_; }

  // Returns the next interval, in ticks. The step is at its end, in direction up() or down. Requires !done().
  constexpr Interval next() {
    if (left_ == 0) begin_leg();
    const Interval raw = ramp_.interval();
    const Interval interval = raw > cruise_ ? raw : cruise_;
    --left_;
    if (height_ == left_) {
      if (height_ != 0) {
        ramp_.fall();
        --height_;
      }
    } else if (raw > cruise_ && static_cast<Count>(left_ - height_) > 1) {
      ramp_.rise();
      ++height_;
    }
    return interval;
  }
  // Returns the direction of the step at the end of the last interval.
  constexpr bool up() const { return up_; }
  // Returns the position after that step.
  constexpr Position position() const { return up_ ? leg_end_ - steps(left_) : leg_end_ + steps(left_); }

  // Sets the target, also during a move. If the motor can no longer stop before the target, it brakes, stops and
  // returns.
  constexpr void move_to(Position target) {
    target_ = target;
    if (left_ == 0) return;
    const Position here = position();
    const Position ahead = up_ ? target - here : here - target;
    const Position shortest = static_cast<Position>(height_) + 1;
    left_ = static_cast<Count>(ahead < shortest ? shortest : ahead);
    leg_end_ = up_ ? here + steps(left_) : here - steps(left_);
  }
  // Stops as soon as the ramp allows. The move is then done() at that position.
  constexpr void stop() {
    move_to(position());
    target_ = leg_end_;
  }

 private:
  static constexpr Position steps(Count count) { return static_cast<Position>(count); }

  constexpr void begin_leg() {
    up_ = target_ > leg_end_;
    left_ = static_cast<Count>(up_ ? target_ - leg_end_ : leg_end_ - target_);
    leg_end_ = target_;
  }

  Ramp ramp_;
  Interval cruise_ = 1;
  Count left_ = 0;        // intervals to the end of the leg
  Count height_ = 0;      // indices above the first one of the move; below left_ while any steps are left
  Position leg_end_ = 0;  // position at the end of this leg
  Position target_ = 0;
  bool up_ = true;
};

}  // namespace passo
