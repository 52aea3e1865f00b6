// ServoMotor: a stepping motor whose field is led by an encoder, so that it obeys a torque and cannot lose a step.
//
//   field = rotor + lead        torque = pull-out · sin(lead·π/2)        lead in full steps, −1 … 1
//
// An open-loop motor gets its field from a plan, and the rotor follows or falls out of step. Here the field is set anew
// in each period, ahead of where the encoder sees the rotor. The motor is RunningMotor with its currents, back-EMF and
// friction, so the torque comes late by L/R, and falls with the speed.
#pragma once

#include "passo/feedback/shaft_encoder.hpp"
#include "passo/motor/running_motor.hpp"

namespace passo {

class ServoMotor {
 public:
  // The setup has passed its checks, and has fine microsteps: the field is set in steps of the driver.
  ServoMotor(const MotorSetup& setup, const ShaftEncoder& encoder, Seconds period);

  // One period of the control: sets the field for that torque, and lets the time pass. `speed`: as it was measured.
  void run(NewtonMetres torque, RadiansPerSecond speed);
  void set_resistance(NewtonMetres torque) { motor_.set_resistance(torque); }

  std::int64_t counts() const { return encoder_.counts_at(radians()); }
  // The true place of the shaft.
  double radians() const { return motor_.place() / steps_per_radian_; }
  RadiansPerSecond speed() const { return motor_.speed(); }
  NewtonMetres torque() const { return motor_.torque(); }
  // What the field gives at rest, one full step ahead.
  NewtonMetres most_torque() const { return {most_}; }

 private:
  RunningMotor motor_;
  ShaftEncoder encoder_;
  Seconds period_;
  double steps_per_radian_;
  double most_;
};

}  // namespace passo
