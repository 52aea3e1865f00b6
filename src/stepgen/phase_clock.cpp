#include "phase_clock.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// Slower than this at the end of a move is rest; a step at this speed would take half a minute on the finest machine.
constexpr double rest_speed = 1e-6;  // mm/s

// The root of s(t) = `distance` in [0, duration]: s grows with t, so that a bracket always holds.
double time_with_jerk(const Phase& phase, double distance) {
  double low = 0;
  double high = phase.duration.value();
  double t = high / 2;
  for (int i = 0; i < 64; ++i) {
    const double excess = (phase.position_at(Seconds(t)) - phase.start).value() - distance;
    (excess > 0 ? high : low) = t;
    const double speed = phase.velocity_at(Seconds(t)).value();
    double next = speed > 0 ? t - excess / speed : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

Seconds time_at(const Phase& phase, Mm s) {
  const double distance = (s - phase.start).value();
  if (distance <= 0) return Seconds(0);
  if (phase.jerk.value() != 0) return Seconds(time_with_jerk(phase, distance));
  // v t + a t²/2 = d, in the form that loses no digits when a is small or the speed falls to zero.
  const double v = phase.velocity.value();
  const double square = v * v + 2 * phase.acceleration.value() * distance;
  const double t = 2 * distance / (v + std::sqrt(std::max(square, 0.0)));
  return Seconds(std::min(t, phase.duration.value()));
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
