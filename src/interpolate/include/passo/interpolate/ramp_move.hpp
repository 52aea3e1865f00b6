// RampMove: whole moves of one motor with constant acceleration, on request turned round or stopped in mid-move.
//
//   rate
//    cruise   ____________          The ramp's index n rises while the rate is below the wanted one and there is room
//            /            \         to come back down; it falls when what is left is just the way down. The intervals
//   start  _|              |_       of braking are those of the start, mirrored.
//
// One comparison decides: with `height` indices above where the ramp starts, the motor needs height + 1 intervals to
// come to rest, and height < left always holds. Trapezoid, triangle, a constant rate, stop and reversal are that one
// rule; the count of steps cannot be wrong.
//
// start: the shortest interval with which the motor starts, stops and reverses without a ramp (its pull-in rate). The
// ramp begins at the fastest of its indices that is inside, and ends there: nothing slower is worth the time. Where
// the wanted rate is itself inside, it is constant. Where the ramp's own first interval is shorter than `start`, the
// move would not begin inside, and set_rates() refuses.
//
// Ramp: TableRamp, ExactRamp or one of their kind, at index 0. Count: uint16_t makes it cheaper on a chip, with moves
// below 65536 steps. Positions stay within ±2^30 steps. One addition and two comparisons a step beside the ramp's own.
// Portable: no division.
#pragma once

#include <stdint.h>

namespace passo {

template <class Ramp, class Count = uint32_t>
class RampMove {
 public:
  using Interval = typename Ramp::Interval;
  using Position = int32_t;

  explicit constexpr RampMove(const Ramp& ramp) : ramp_(ramp) {}

  // In ticks, at least 1; start 0: the motor has no such region, a move begins with the ramp's first interval. False:
  // the ramp begins outside the region. At rest only, and once for a ramp: it is walked up to where it starts.
  [[nodiscard]] constexpr bool set_rates(Interval start, Interval cruise) {
    cruise_ = cruise > ramp_.fastest() ? cruise : ramp_.fastest();
    if (start == 0) return true;
    if (cruise_ >= start) {
      while (ramp_.interval() > cruise_) ramp_.rise();
      return true;
    }
    if (ramp_.interval() < start) return false;
    while (ramp_.interval() >= start) ramp_.rise();
    ramp_.fall();  // it had just left the region
    return true;
  }

  constexpr bool done() const { return left_ == 0 && leg_end_ == target_; }

  // The next interval, in ticks; then comes the step, in direction up() or down. Only when not done().
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
  // The direction of the step that next() told.
  constexpr bool up() const { return up_; }
  // After the last step that next() told.
  constexpr Position position() const { return up_ ? leg_end_ - steps(left_) : leg_end_ + steps(left_); }

  // Where to go from wherever it is. In mid-move, and behind what can still be reached: brake, stop, and come back.
  constexpr void move_to(Position target) {
    target_ = target;
    if (left_ == 0) return;
    const Position here = position();
    const Position ahead = up_ ? target - here : here - target;
    const Position shortest = static_cast<Position>(height_) + 1;
    left_ = static_cast<Count>(ahead < shortest ? shortest : ahead);
    leg_end_ = up_ ? here + steps(left_) : here - steps(left_);
  }
  // As soon as the ramp lets it; the move is done() there.
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
  Count left_ = 0;        // intervals to the leg's end
  Count height_ = 0;      // indices above the one that the ramp starts with; below left_ while there are any
  Position leg_end_ = 0;  // where this leg comes to rest
  Position target_ = 0;
  bool up_ = true;
};

}  // namespace passo
