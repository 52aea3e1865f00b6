#include "passo/feedback/servo_motor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

// The checks of the setup's parts passed, so there is a curve.
double torque_at_rest(const MotorSetup& setup) {
  if (setup.measured) return setup.measured->pull_out({0}).value;
  return TorqueCurve::from_motor(setup.motor, setup.drive)->pull_out({0}).value;
}

}  // namespace

ServoMotor::ServoMotor(const MotorSetup& setup, const ShaftEncoder& encoder, Seconds period)
    : motor_(setup),
      encoder_(encoder),
      period_(period),
      steps_per_radian_(setup.motor.rotor.steps_per_revolution * setup.excitation.steps_per_full_step() /
                        (2 * std::numbers::pi)),
      most_(torque_at_rest(setup)) {}

void ServoMotor::run(NewtonMetres torque, RadiansPerSecond speed) {
  const double share = std::clamp(torque.value / most_, -1.0, 1.0);
  const double lead = std::asin(share) * 2 / std::numbers::pi * motor_.steps_per_full_step();
  // The field stands still for a period while the rotor goes on: it is right in the middle of the period.
  const double rotor = encoder_.radians_of(counts()) + speed.value * period_.value() / 2;
  const std::int64_t field = std::llround(rotor * steps_per_radian_ + lead);
  for (std::int64_t left = field - motor_.commanded(); left != 0; left += left > 0 ? -1 : 1) {
    motor_.step(left > 0 ? 1 : -1);
  }
  motor_.run(period_);
}

}  // namespace passo
