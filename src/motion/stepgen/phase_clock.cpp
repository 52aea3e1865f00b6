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

// Without jerk the time is that of ConstantJerk::time_to.
std::size_t PhaseClock::at(const Lanes& s, std::size_t first, std::size_t end, Moments& moments) {
  find_phase(s[first]);
  const bool is_last = phase_ + 1 == move_->phase_count;
  std::size_t behind = first + 1;
  while (behind < end && (s[behind] <= end_ || is_last)) ++behind;
  if (motion_.jerk != 0) {
    for (std::size_t i = first; i < behind; ++i) {
      const Moment moment = at(s[i]);
      moments.time[i] = moment.time;
      moments.speed[i] = moment.speed;
      moments.acceleration[i] = moment.acceleration;
    }
    return behind;
  }
  // Copies: a loop over values becomes vectors, one over what might change on the way does not.
  const ConstantJerk motion = motion_;
  const double start = start_;
  const double before = phase_start_;
  const double longest = duration_;
  for (std::size_t i = first; i < behind; ++i) {
    const double way = s[i] - start;
    const double square = motion.speed * motion.speed + 2 * motion.acceleration * way;
    const double exact = 2 * way / (motion.speed + std::sqrt(square > 0 ? square : 0));
    const double at_most = exact < longest ? exact : longest;
    const double time = way > 0 ? at_most : 0;
    moments.time[i] = before + time;
    moments.speed[i] = motion.speed + time * motion.acceleration;
    moments.acceleration[i] = motion.acceleration;
  }
  return behind;
}

double PhaseClock::duration() const {
  double sum = phase_start_;
  for (std::size_t i = phase_; i < move_->phase_count; ++i) sum += move_->phases[i].duration.value();
  return sum;
}

}  // namespace passo
