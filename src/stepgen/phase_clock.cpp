#include "phase_clock.hpp"

namespace passo {

void PhaseClock::start(const PlannedMove& move) {
  move_ = &move;
  begin_phase(0, 0);
}

void PhaseClock::begin_phase(std::size_t index, double time) {
  const Phase& phase = move_->phases[index];
  const bool last = index + 1 == move_->phase_count;
  phase_ = index;
  motion_ = {phase.velocity.value(), phase.acceleration.value(), phase.jerk.value()};
  phase_start_ = time;
  start_ = phase.start.value();
  end_ = last ? move_->to.value() : move_->phases[index + 1].start.value();
  duration_ = phase.duration.value();
  time_ = 0;
}

double PhaseClock::time_with_jerk(double way) const {
  const ConstantJerk now{motion_.speed_after(time_), motion_.acceleration_after(time_), motion_.jerk};
  const double guess = time_ + now.soon(way - motion_.way_after(time_));
  return motion_.time_to(way, duration_, guess, ConstantJerk::rounding * way);
}

double PhaseClock::duration() const {
  double sum = phase_start_;
  for (std::size_t i = phase_; i < move_->phase_count; ++i) sum += move_->phases[i].duration.value();
  return sum;
}

}  // namespace passo
