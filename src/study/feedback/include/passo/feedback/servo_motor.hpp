// ServoMotor: a stepper motor in closed loop: the encoder sets the field's position, so that the motor follows a torque
// command and cannot lose steps.
//
//   field = rotor + lead        torque = pull-out · sin(lead·π/2)        lead in full steps, −1 … 1
//
// In open loop the field follows a plan, and the rotor follows the field or loses synchronism. Here the field is set in
// each period, ahead of the rotor position measured by the encoder. The motor is a RunningMotor with its currents,
// back-EMF and friction, so the torque is delayed by L/R, and decreases with speed.
#pragma once

#include "passo/feedback/shaft_encoder.hpp"
#include "passo/motor/running_motor.hpp"

namespace passo {

class ServoMotor {
 public:
  // The setup must have passed its checks, and must have fine microsteps: the field is set in steps of the driver.
  ServoMotor(const MotorSetup& setup, const ShaftEncoder& encoder, Seconds period);

  // Runs one control period: sets the field for that torque, and simulates the period. `speed`: as measured.
  void run(NewtonMetres torque, RadiansPerSecond speed);
  void set_resistance(NewtonMetres torque) { motor_.set_resistance(torque); }

  std::int64_t counts() const { return encoder_.counts_at(radians()); }
  // Returns the actual position of the shaft.
  double radians() const { return motor_.place() / steps_per_radian_; }
  RadiansPerSecond speed() const { return motor_.speed(); }
  NewtonMetres torque() const { return motor_.torque(); }
  // Returns the torque at standstill with a lead of one full step.
  NewtonMetres most_torque() const { return {most_}; }

 private:
  RunningMotor motor_;
  ShaftEncoder encoder_;
  Seconds period_;
  double steps_per_radian_;
  double most_;
};

}  // namespace passo
