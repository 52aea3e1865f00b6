// JerkRamp: from a speed and an acceleration to the end speed, over a given way, as fast as the limits let it.
// Private to ramp/. Steps and seconds.
//
// Three parts: a head from the state to the crest speed, a stretch at the crest, and a tail from the crest to the end
// speed. The tail is kept backwards, from the end on: a step that lies r before the end is r steps of a move from the
// end speed upwards, and where the speed goes to nothing no digit is lost. The crest is the highest speed that leaves
// room to come down again; the way grows with it, so that it is found by halving.
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

// Phases of constant jerk, one after another.
class JerkPhases {
 public:
  // A stretch at constant speed.
  void add_way(double way, double speed);
  // From `from` to `speed` without acceleration, as fast as the limits let it: up to three phases.
  void add_change(const JerkState& from, double speed, const JerkLimits& limits);

  double way() const { return way_; }
  double duration() const { return duration_; }
  double time_at(double way) const;
  JerkState state_at(double way) const;

 private:
  static constexpr std::size_t most = 4;
  struct Phase {
    ConstantJerk motion;
    double start = 0;  // way
    double start_time = 0;
    double duration = 0;
  };
  struct Found {
    const Phase* phase = nullptr;
    double time = 0;  // within it
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
  // From the middle of a move. `way` not below shortest(); what rounding lacks is ignored.
  JerkRamp(const JerkState& from, double way, const JerkLimits& limits);
  // From rest: the first step and the last at the end speed where that is not 0, a constant speed where there is
  // nothing between.
  static JerkRamp from_rest(double way, const JerkLimits& limits);
  // The way that the state needs to come to the end speed, with the last step at that.
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
