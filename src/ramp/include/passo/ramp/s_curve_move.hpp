// SCurveMove: whole moves of one motor with bounded jerk, on request turned round or stopped in mid-move.
//
//   rate            ________________        Up to seven phases of constant jerk: + 0 − to the cruising rate, cruise,
//                 /                  \      − 0 + to rest. One piece of machinery plans the way to rest from any
//               /                      \    rate and acceleration: the whole move, the stop and the way to another
//   start     _|                        |_  target are the same plan from another state.
//
// The time of each step is the position polynomial inverted at a whole number of steps, from the start of the plan or
// from its end, whichever has the rest; ticks are rounded from times since the motor last stood still, so that no
// error adds up: each step is within half a tick, however long the move. The count of steps is exact.
//
// start: where it is not 0, the first and the last step of every leg take 1/start: they are inside the start/stop
// region, and between them the rate does not fall below it. Else the motor starts from rest, with jerk and
// acceleration from zero. A wanted rate inside the region is kept constant.
//
// Ranges: positions within ±2^53 steps; limits positive and finite, but for the rate, which may be infinite.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/ramp/ramp_setup.hpp"

namespace passo {

struct SCurveLimits {
  RampSetup setup;  // its acceleration is the greatest
  RadiansPerSecond3 jerk;
  Hertz rate{0};   // the greatest, in steps a second
  Hertz start{0};  // the start/stop region's; 0: none
};

class SCurveMove {
 public:
  explicit SCurveMove(const SCurveLimits& limits);
  ~SCurveMove();
  SCurveMove(SCurveMove&&) noexcept;
  SCurveMove& operator=(SCurveMove&&) noexcept;

  bool done() const;
  // The next interval; then comes the step, in direction up() or down. Only when not done().
  Ticks next();
  // The same interval before it was rounded, in ticks.
  double real_interval() const;
  bool up() const;
  Steps position() const;
  // At the last step.
  Hertz rate() const;
  RadiansPerSecond2 acceleration() const;  // negative where the motor brakes

  // Where to go from wherever it is. In mid-move, and behind what can still be reached: brake, stop, and come back.
  void move_to(Steps target);
  // As soon as the limits let it, on a whole step; the move is done() there.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace passo
