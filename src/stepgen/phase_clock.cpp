#include "phase_clock.hpp"

#include "passo/units/constant_jerk.hpp"

namespace passo {
namespace {

// Slower than this at the end of a move is rest; a step at this speed would take half a minute on the finest machine.
constexpr double rest_speed = 1e-6;  // mm/s

}  // namespace

Seconds time_at(const Phase& phase, Mm s) {
  const ConstantJerk stretch{phase.velocity.value(), phase.acceleration.value(), phase.jerk.value()};
  return Seconds(stretch.time_to((s - phase.start).value(), phase.duration.value()));
}

double PhaseClock::end_of(std::size_t phase) const {
  return phase + 1 < move_->phase_count ? move_->phases[phase + 1].start.value()
                                        : move_->segment.curve.length().value();
}

PhaseClock::Moment PhaseClock::at(double s) {
  while (phase_ + 1 < move_->phase_count && s > end_of(phase_)) {
    phase_start_ += move_->phases[phase_].duration.value();
    ++phase_;
  }
  const Phase& phase = move_->phases[phase_];
  const Seconds t = time_at(phase, Mm(s));
  return {.time = phase_start_ + t.value(),
          .speed = phase.velocity_at(t).value(),
          .acceleration = phase.acceleration.value() + phase.jerk.value() * t.value()};
}

bool PhaseClock::ends_at_rest() const {
  if (move_->phase_count == 0) return true;
  const Phase& last = move_->phases[move_->phase_count - 1];
  return last.velocity_at(last.duration).value() < rest_speed;
}

}  // namespace passo
