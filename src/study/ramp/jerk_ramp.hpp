// JerkRamp: the fastest motion within limits from a speed and an acceleration to the end speed, over a given distance.
// Private to ramp/. In steps and seconds.
//
// It has three parts: acceleration from the start state to the peak speed, motion at constant peak speed, and
// deceleration from the peak to the end speed. The deceleration is stored in reverse: the distance r before the end is
// the distance r of a motion that accelerates from the end speed, so no precision is lost where the speed approaches
// zero. The peak is the maximum speed that leaves room to brake. The distance increases with the peak, so it is found
// by bisection.
#pragma once

#include <array>
#include <cstddef>

#include "passo/units/constant_jerk.hpp"

namespace passo {

struct JerkLimits {
  double speed = 0;
  double acceleration = 0;
  double jerk = 0;
  double end_speed = 0;  // at most `speed`
};

struct JerkState {
  double speed = 0;
  double acceleration = 0;
};

// A sequence of phases of constant jerk.
class JerkPhases {
 public:
  // Adds a phase at constant speed.
  void add_way(double way, double speed);
  // Adds the change from `from` to `speed` with zero acceleration at its end, as fast as the limits allow: up to three
  // phases.
  void add_change(const JerkState& from, double speed, const JerkLimits& limits);

  double way() const { return way_; }
  double duration() const { return duration_; }
  double time_at(double way) const;
  JerkState state_at(double way) const;

 private:
  static constexpr std::size_t most = 4;
  struct Phase {
    ConstantJerk motion;
    double start = 0;  // position at the start of the phase
    double start_time = 0;
    double duration = 0;
  };
  struct Found {
    const Phase* phase = nullptr;
    double time = 0;  // since the start of the phase
  };

  void add(const ConstantJerk& motion, double duration);
  Found find(double way) const;

  std::array<Phase, most> phases_;
  std::size_t count_ = 0;
  double way_ = 0;
  double duration_ = 0;
};

class JerkRamp {
 public:
  JerkRamp() = default;
  // Plans from any state of a move. `way` is at least shortest(); a deficit by rounding is ignored.
  JerkRamp(const JerkState& from, double way, const JerkLimits& limits);
  // Plans from standstill. If the end speed is not 0, the first and the last step run at it. The speed is constant if
  // there are no steps in between.
  static JerkRamp from_rest(double way, const JerkLimits& limits);
  // Returns the minimum distance from the state to the end speed, including a last step at that speed.
  static double shortest(const JerkState& from, const JerkLimits& limits);

  double way() const { return way_; }
  double time_at(double way) const;
  JerkState state_at(double way) const;

 private:
  void climb(const JerkState& from, double lead, const JerkLimits& limits);

  JerkPhases head_;
  JerkPhases tail_;  // the deceleration, stored in reverse
  double crest_ = 0;
  double way_ = 0;
  double duration_ = 0;
};

}  // namespace passo
