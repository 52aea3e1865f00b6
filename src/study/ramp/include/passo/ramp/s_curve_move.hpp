// SCurveMove: whole moves of one motor with bounded jerk. A move can be stopped or given a new target on the way.
//
//   rate            ________________        Up to seven phases of constant jerk: + 0 − to the cruising rate, cruise,
//                 /                  \      − 0 + to rest. One planner finds the way to rest from any rate and
//               /                      \    acceleration. It plans the whole move, a stop, and the way to another
//               target;
//   start     _|                        |_  only the state at the start differs.
//
// The time of each step comes from the position polynomial, solved for a whole number of steps. It is solved from the
// start of the plan or from its end, whichever is at rest. Ticks are rounded from times since the motor last stood
// still, so errors do not add up: each step is within half a tick in a move of any length. The count of steps is exact.
// Where `start` is not 0, the first and the last step of every leg take 1/start. They are inside the start/stop region,
// and between them the rate does not fall below it. Where `start` is 0 the motor starts from rest, its acceleration
// from zero. A wanted rate inside the region is kept constant.
// acceleration from zero. A wanted rate inside the region is kept constant.
//
// Ranges: positions within ±2^53 steps. Limits are positive and finite; only the rate may be infinite.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/ramp/ramp_setup.hpp"

namespace passo {

struct SCurveLimits {
  RampSetup setup;  // with the greatest acceleration
  RadiansPerSecond3 jerk;
  Hertz rate{0};   // the greatest rate, in steps a second
  Hertz start{0};  // the rate of the start/stop region; 0: none
};

class SCurveMove {
 public:
  explicit SCurveMove(const SCurveLimits& limits);
  ~SCurveMove();
  SCurveMove(SCurveMove&&) noexcept;
  SCurveMove& operator=(SCurveMove&&) noexcept;

  bool done() const;
  // The next interval. The step comes at its end, in direction up() or down. Only when not done().
  Ticks next();
  // The last interval before it was rounded, in ticks.
  double real_interval() const;
  bool up() const;
  Steps position() const;
  // The rate at the last step.
  Hertz rate() const;
  RadiansPerSecond2 acceleration() const;  // negative where the motor brakes

  // Sets the target, also in mid-move. If the motor can no longer stop before the target, it brakes, stops and comes
  // back.
  void move_to(Steps target);
  // Stops as soon as the limits allow, on a whole step. The move is then done() at that place.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace passo
