#include "passo/motor/torque_band.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/motor/motor_trials.hpp"

namespace passo {
namespace {

constexpr int trials = 16;  // a motor
constexpr double first_rate = 30;
// By which share the physics differs from the curve: docs/ramps/physics.md. Full steps and half steps have 4/π of the
// sines' fundamental.
constexpr double curve_too_high = 0.97;
constexpr double curve_too_low = 1.06;
constexpr double of_whole_steps = 1.3;

double whole_torque(const MotorSetup& setup, Hertz rate, RadiansPerSecond speed) {
  const double tried = tried_pull_out(setup, rate).value;
  return tried > 0 ? tried + setup.load.friction_at(speed).value + setup.damping.value * speed.value : 0;
}

// Swinging that grows slowly is not seen by a trial of pull-out, whose torque damps it.
bool keeps_step(const MotorSetup& setup, Hertz rate) {
  constexpr double in_step = 2;  // full steps
  return tried_lag(setup, rate) < in_step;
}

}  // namespace

MotorSetup with_torque(const MotorSetup& setup, double factor) {
  MotorSetup changed = setup;
  changed.motor.holding_torque.value *= factor;
  if (changed.measured) changed.measured = changed.measured->scaled(factor);
  return changed;
}

TorqueBand::TorqueBand(const MotorSetup& setup, double tolerance)
    : setup_(setup),
      tolerance_(tolerance),
      weak_(pull_out_curve(with_torque(setup, 1 - tolerance))),
      strong_(pull_out_curve(with_torque(setup, 1 + tolerance))),
      factor_low_(curve_too_high),
      factor_high_(setup.excitation.is_sine() ? curve_too_low : of_whole_steps) {}

void TorqueBand::try_steady(RadiansPerSecond fastest) {
  tried_.clear();
  const double last_rate = rate_at(fastest).value();
  if (last_rate <= first_rate) return;
  MotorSetup usual = setup_;
  usual.weight = {};  // counts as a load, not as something that the motor lacks
  const MotorSetup weak = with_torque(usual, 1 - tolerance_);
  const MotorSetup strong = with_torque(usual, 1 + tolerance_);
  for (int i = 0; i < trials; ++i) {
    const Hertz rate(first_rate * std::pow(last_rate / first_rate, i / double{trials - 1}));
    const RadiansPerSecond speed = weak_.speed_at(rate);
    const bool all_keep_step = keeps_step(usual, rate) && keeps_step(weak, rate) && keeps_step(strong, rate);
    const double torque =
        all_keep_step ? std::min(whole_torque(weak, rate, speed), whole_torque(strong, rate, speed)) : 0;
    tried_.push_back({speed.value, torque});
  }
}

TorqueRange TorqueBand::of_curve(RadiansPerSecond speed) const {
  const auto [low, high] = std::minmax({weak_.pull_out(speed).value, strong_.pull_out(speed).value});
  return {{factor_low_ * low}, {factor_high_ * high}};
}

NewtonMetres TorqueBand::while_steady(RadiansPerSecond speed) const {
  const double low = of_curve(speed).low.value;
  const auto next = std::ranges::lower_bound(tried_, speed.value, {}, &Tried::speed);
  if (tried_.empty() || (next == tried_.begin() && speed.value < next->speed)) return {low};
  // Between two rates the weaker one counts, because a resonance is narrow. The curve's fall between the two is not
  // taken for swinging.
  const auto share_of = [&](const Tried& tried) {
    const double there = of_curve({tried.speed}).low.value;
    return there > 0 ? std::min(1.0, tried.torque / there) : 0.0;
  };
  double share = share_of(next == tried_.end() ? tried_.back() : *next);
  if (next != tried_.begin()) share = std::min(share, share_of(*std::prev(next)));
  return {share * low};
}

}  // namespace passo
