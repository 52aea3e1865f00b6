// SCurveMove: whole moves of one motor with a jerk limit. A move can be stopped or given a new target at any time.
//
//   rate            ________________      Up to seven phases of constant jerk: + 0 − to the cruising rate, cruise,
//                 /                \     − 0 + to the stop. One planner finds the path to a stop from any rate and
//                /                  \    acceleration. It plans the whole move, a stop, and the move to another
//   start      _|                    |_  target; only the state at the start differs.
//
// The time of each step is computed from the position polynomial, solved for a whole number of steps. It is solved from
// the start of the plan or from its end, whichever is at standstill. Ticks are rounded from times since the motor last
// stopped, so errors do not accumulate: each step is within half a tick in a move of any length. The number of steps is
// exact. If `start` is not 0, the first and the last step of every leg take 1/start. They are within the start/stop
// region, and between them the rate does not fall below it. If `start` is 0, the motor starts from standstill with zero
// acceleration. A target rate within the region is kept constant.
//
// Ranges: positions within ±2^53 steps. Limits are positive and finite; only the rate may be infinite.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/ramp/ramp_setup.hpp"

namespace passo {

struct SCurveLimits {
  RampSetup setup;  // setup, including the acceleration limit
  RadiansPerSecond3 jerk;
  Hertz rate{0};   // maximum rate, steps/s
  Hertz start{0};  // pull-in rate of the start/stop region; 0: none
};

class SCurveMove {
 public:
  explicit SCurveMove(const SCurveLimits& limits);
  ~SCurveMove();
  SCurveMove(SCurveMove&&) noexcept;
  SCurveMove& operator=(SCurveMove&&) noexcept;

  bool done() const;
  // Returns the next interval. The step is at its end, in direction up() or down. Requires !done().
  Ticks next();
  // Returns the last interval before rounding, in ticks.
  double real_interval() const;
  bool up() const;
  Steps position() const;
  // Returns the rate at the last step.
  Hertz rate() const;
  RadiansPerSecond2 acceleration() const;  // negative during braking

  // Sets the target, also during a move. If the motor can no longer stop before the target, it brakes, stops and
  // returns.
  void move_to(Steps target);
  // Stops as soon as the limits allow, on a whole step. The move is then done() at that position.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace passo
