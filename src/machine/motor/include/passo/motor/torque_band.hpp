// TorqueBand: the lower and the upper bound of a motor's true pull-out torque, at each speed.
//
// A real motor is weaker or stronger than its data sheet, within its tolerance. A stronger magnet also has a higher
// back-EMF, so at high speed the stronger motor may be the weaker one. Therefore the band is taken from both.
//
//   torque  .......
//    |------.     `..   of_curve().high     The curves ignore rotor resonance. A motor that runs at a constant
//    |::::::`--.     `  of_curve().low      rate may start to oscillate by itself and lose steps far below
//    |----.  .-`--.                         the curve. The trials of motor_trials.hpp find these rates: while_steady().
//    |     `-'  while_steady()
//    +------------------- speed
//
// The curves themselves differ from the full physics: docs/ramps/physics.md. The band includes that.
//
// Cost of try_steady(): 80 trials, some milliseconds each. A query takes less than a microsecond.
#pragma once

#include <vector>

#include "passo/motor/running_motor.hpp"
#include "passo/motor/torque_curve.hpp"

namespace passo {

struct TorqueRange {
  NewtonMetres low = {};
  NewtonMetres high = {};
};

// Returns the same motor with a weaker or stronger magnet: all torques and the back-EMF are multiplied. `factor` > 0.
MotorSetup with_torque(const MotorSetup& setup, double factor);

class TorqueBand {
 public:
  // `tolerance`, 0 to 0.5, is the fraction by which the true torque may differ from the setup's. The setup's parts must
  // have passed their checks.
  TorqueBand(const MotorSetup& setup, double tolerance);

  // Finds the rates up to `fastest` at which the motor resonates. Without these trials while_steady() equals the curve.
  void try_steady(RadiansPerSecond fastest);
  bool tried() const { return !tried_.empty(); }

  // Returns the pull-out torque of a motor that does not oscillate. `speed` ≥ 0.
  TorqueRange of_curve(RadiansPerSecond speed) const;
  // Returns the lower bound for a motor that stays near that speed, long enough to oscillate. Never above the curve's.
  NewtonMetres while_steady(RadiansPerSecond speed) const;

  Hertz rate_at(RadiansPerSecond speed) const { return weak_.rate_at(speed); }
  const Rotor& rotor() const { return weak_.rotor(); }

 private:
  struct Tried {
    double speed = 0;
    double torque = 0;  // friction and damping included
  };

  MotorSetup setup_;
  double tolerance_;
  TorqueCurve weak_;
  TorqueCurve strong_;
  double factor_low_;
  double factor_high_;
  std::vector<Tried> tried_;  // speeds ascending
};

}  // namespace passo
