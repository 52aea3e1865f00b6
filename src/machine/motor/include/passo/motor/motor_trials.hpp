// Motor trials: what a motor does on the test bench, tried out with its physics instead of computed from a formula.
//
// Rates are in full steps/s, independent of microstepping. The load is the setup's. Each trial is a run of a
// RunningMotor from rest, so the same setup gives the same numbers.
#pragma once

#include <vector>

#include "passo/motor/running_motor.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The most torque against the motion, beside the setup's friction, with which the motor still runs at that rate. The
// motor is brought there by a gentle ramp, then the torque grows slowly. 0: the motor does not get there.
NewtonMetres tried_pull_out(const MotorSetup& setup, Hertz rate);

// The most torque against the motion, beside the setup's friction, with which the motor starts at that rate at once,
// runs, and stops at once, without loss. 0: not even without that torque.
NewtonMetres tried_pull_in(const MotorSetup& setup, Hertz rate);

// The largest lag, in full steps, of a motor that has run at that rate for a while: it is large where the rate excites
// the rotor's own ringing. 2 or more: steps are lost.
double tried_lag(const MotorSetup& setup, Hertz rate);

// A moment of a motion.
struct MotorMoment {
  Seconds time{0};
  double commanded = 0;  // full steps
  double place = 0;      // full steps
  RadiansPerSecond speed = {};
  Amperes current_a = {};
  Amperes current_b = {};
  NewtonMetres torque = {};
};

// `steps` of the driver at an even rate from rest, which then end without a ramp, and the ringing after them. Moments
// are `apart` apart. One step at any rate is the single-step response.
std::vector<MotorMoment> tried_motion(const MotorSetup& setup, int steps, Hertz rate, Seconds whole, Seconds apart);

}  // namespace passo
