// Motor trials: the behaviour of a motor on the test bench, simulated with its physics instead of computed from a
// formula.
//
// Rates are in full steps/s, independent of microstepping. The load is that of the setup. Each trial is a run of a
// RunningMotor from rest, so the same setup gives the same numbers.
#pragma once

#include <vector>

#include "passo/motor/running_motor.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Returns the largest torque against the motion, in addition to the setup's friction, with which the motor keeps
// running at that rate. A gentle ramp accelerates the motor, then the torque increases slowly. 0: the motor does not
// reach that rate.
NewtonMetres tried_pull_out(const MotorSetup& setup, Hertz rate);

// Returns the largest torque against the motion, in addition to the setup's friction, with which the motor starts at
// that rate without a ramp, runs, and stops without a ramp, without step loss. 0: it cannot even without that torque.
NewtonMetres tried_pull_in(const MotorSetup& setup, Hertz rate);

// Returns the largest lag, in full steps, of a motor that has run at that rate for a while: it is large where the rate
// excites the rotor's resonance. 2 or more: steps are lost.
double tried_lag(const MotorSetup& setup, Hertz rate);

// A sample of a motion.
struct MotorMoment {
  Seconds time{0};
  double commanded = 0;  // full steps
  double place = 0;      // full steps
  RadiansPerSecond speed = {};
  Amperes current_a = {};
  Amperes current_b = {};
  NewtonMetres torque = {};
};

// Simulates `steps` driver steps at a constant rate, started and stopped without a ramp, and the oscillation after
// them. Samples are `apart` apart. One step at any rate gives the single-step response.
std::vector<MotorMoment> tried_motion(const MotorSetup& setup, int steps, Hertz rate, Seconds whole, Seconds apart);

}  // namespace passo
