// PhaseClock: computes the time at which the path reaches s, by inverting the phases of one move. s must not decrease
// between calls.
//
// Times count from the start of the move, so that errors do not accumulate from step to step. units/constant_jerk.hpp
// inverts a phase. With jerk the search begins at an extrapolation from the last event, and takes one or two
// iterations. About 3 ns per event, 30 ns with jerk.
#pragma once

#include "lanes.hpp"

#include "passo/trajectory/phase.hpp"
#include "passo/units/constant_jerk.hpp"

namespace passo {

class PhaseClock {
 public:
  struct Moment {
    double time = 0;          // seconds from the start of the move
    double speed = 0;         // mm/s
    double acceleration = 0;  // mm/s²
  };

  // `move` must exist until the clock is started for the next move.
  void start(const PlannedMove& move);
  void move_lives_in(const PlannedMove& move) { move_ = &move; }
  // `s` must not be less than in the last call.
  Moment at(double s) {
    find_phase(s);
    const double way = s - start_;
    time_ = motion_.jerk == 0 ? motion_.time_to(way, duration_) : time_with_jerk(way);
    return {.time = phase_start_ + time_,
            .speed = motion_.speed_after(time_),
            .acceleration = motion_.acceleration_after(time_)};
  }
  // The same for s[first] to s[end - 1], but only up to the end of the first one's phase. Returns the lane after the
  // last one.
  struct Moments {
    Lanes time;
    Lanes speed;
    Lanes acceleration;
    Moment operator[](std::size_t i) const { return {time[i], speed[i], acceleration[i]}; }
  };
  std::size_t at(const Lanes& s, std::size_t first, std::size_t end, Moments& moments);
  // Returns the duration of the whole move.
  double duration() const;
  bool ends_at_rest() const { return move_->ends_at_rest(); }

 private:
  void find_phase(double s) {
    while (s > end_ && phase_ + 1 < move_->phase_count) begin_phase(phase_ + 1, phase_start_ + duration_);
  }
  double time_with_jerk(double way) const;
  void begin_phase(std::size_t phase, double time);

  const PlannedMove* move_ = nullptr;
  // The current phase.
  std::size_t phase_ = 0;
  ConstantJerk motion_;
  double phase_start_ = 0;  // seconds from the start of the move
  double start_ = 0;        // the s at which the phase begins
  double end_ = 0;
  double duration_ = 0;
  double time_ = 0;  // within the phase, at the last call
};

}  // namespace passo
