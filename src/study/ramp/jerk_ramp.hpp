// JerkRamp: the fastest motion within limits from a speed and an acceleration to the end speed, over a given way.
// Private to ramp/. In steps and seconds.
//
// Three parts: a head from the start state to the crest speed, a stretch at the crest, and a tail from the crest to the
// end speed. The tail is kept backwards: the place r before the end is the place r of a motion that speeds up from the
// end speed. So no digit is lost where the speed goes to zero. The crest is the highest speed that leaves room to
// brake. The way grows with the crest, so that bisection finds it.
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

// Phases of constant jerk, one after the other.
class JerkPhases {
 public:
  // A stretch at constant speed.
  void add_way(double way, double speed);
  // Goes from `from` to `speed` with no acceleration at its end, as fast as the limits allow: up to three phases.
  void add_change(const JerkState& from, double speed, const JerkLimits& limits);

  double way() const { return way_; }
  double duration() const { return duration_; }
  double time_at(double way) const;
  JerkState state_at(double way) const;

 private:
  static constexpr std::size_t most = 4;
  struct Phase {
    ConstantJerk motion;
    double start = 0;  // the way at the start of the phase
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
  // From the middle of a move. `way` is at least shortest(); a lack by rounding is ignored.
  JerkRamp(const JerkState& from, double way, const JerkLimits& limits);
  // From rest. Where the end speed is not 0, the first step and the last run at it. A constant speed where no steps lie
  // between.
  static JerkRamp from_rest(double way, const JerkLimits& limits);
  // The least way from the state to the end speed, including a last step at that speed.
  static double shortest(const JerkState& from, const JerkLimits& limits);

  double way() const { return way_; }
  double time_at(double way) const;
  JerkState state_at(double way) const;

 private:
  void climb(const JerkState& from, double lead, const JerkLimits& limits);

  JerkPhases head_;
  JerkPhases tail_;  // backwards
  double crest_ = 0;
  double way_ = 0;
  double duration_ = 0;
};

}  // namespace passo
