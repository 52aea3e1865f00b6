#include "passo/motor/driven_winding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {

DrivenWinding::DrivenWinding(const MotorData& data, const MotorDrive& drive)
    : teeth_(data.rotor.teeth()),
      voltage_(drive.supply.value - drive.drop.value),
      limits_current_(drive.regulation == Regulation::chopper) {
  const MotorData winding = as_wound(data, drive.winding);
  current_ = winding.rated_current.value;
  inductance_ = winding.inductance.value;
  torque_constant_ = winding.holding_torque.value / (std::numbers::sqrt2 * current_);
  resistance_ = winding.resistance.value;
  // Where the winding's resistance alone keeps the current below the rated one, there is no resistor.
  if (!limits_current_) resistance_ = std::max(resistance_, voltage_ / current_);
}

NewtonMetres DrivenWinding::pull_out(RadiansPerSecond speed) const {
  const double reactance = teeth_ * speed.value * inductance_;
  const double current = best_current(reactance, torque_constant_ * speed.value);
  return {torque_constant_ * std::max(current, 0.0)};
}

//            i_q
//             |  a        a: the current alone limits. Without i_d the torque per ampere is best.
//        .----+----.      b: the voltage alone limits. Its circle has the centre −E/(R + jX), left of and below 0.
//      c/     |     \     c: both limit, where the circles cross.
//   .--/--.   |      |
//  /   | b \  |      |
//  |   |  . | 0      |    With higher speed the voltage circle shrinks, and its centre moves from 0 to −K/(N·L).
double DrivenWinding::best_current(double reactance, double back_emf) const {
  const double impedance_squared = resistance_ * resistance_ + reactance * reactance;
  const double impedance = std::sqrt(impedance_squared);
  const double top_q = voltage_ / impedance - back_emf * resistance_ / impedance_squared;
  if (!limits_current_) return top_q;

  if (std::hypot(resistance_ * current_ + back_emf, reactance * current_) <= voltage_) return current_;
  const double top_d = -back_emf * reactance / impedance_squared;
  if (std::hypot(top_d, top_q) <= current_) return top_q;
  // First from 0 towards the centre of the voltage circle, then at a right angle to that.
  const double distance = back_emf / impedance;
  const double radius = voltage_ / impedance;
  const double along = (distance * distance + current_ * current_ - radius * radius) / (2 * distance);
  const double across_squared = current_ * current_ - along * along;
  if (across_squared < 0) return 0;  // the circles do not meet: the back-EMF is more than the supply can hold against
  return (std::sqrt(across_squared) * reactance - along * resistance_) / impedance;
}

}  // namespace passo
