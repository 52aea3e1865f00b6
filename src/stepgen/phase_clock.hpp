// PhaseClock: when the path is at s. The phases of one move, inverted; s only grows from call to call.
//
// Times are from the start of the move, so that no error adds up from step to step. How a phase inverts:
// units/constant_jerk.hpp.
#pragma once

#include "passo/trajectory/phase.hpp"

namespace passo {

// The time within `phase` at which it has come to `s`.
Seconds time_at(const Phase& phase, Mm s);

class PhaseClock {
 public:
  PhaseClock() = default;
  // The move must outlive the clock.
  explicit PhaseClock(const PlannedMove& move) : move_(&move), duration_(move.duration()) {}

  struct Moment {
    double time = 0;          // seconds from the start of the move
    double speed = 0;         // mm/s
    double acceleration = 0;  // mm/s²
  };
  // `s` not less than at the last call.
  Moment at(double s);
  double duration() const { return duration_.value(); }
  bool ends_at_rest() const;

 private:
  double end_of(std::size_t phase) const;

  const PlannedMove* move_ = nullptr;
  Seconds duration_{0};
  std::size_t phase_ = 0;
  double phase_start_ = 0;  // seconds from the start of the move
};

}  // namespace passo
