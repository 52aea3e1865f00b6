// The small motor of the examples: `passo loop` without a machine file, docs/ramps/torque.md, tests and benchmarks.
//
// 1.8 degrees, 42 mm square, 48 mm long: the motor of many small machines, with values of typical data sheets.
#pragma once

#include <string_view>

#include "passo/motor/running_motor.hpp"

namespace passo {

inline MotorData small_motor() {
  return {.rotor = {.steps_per_revolution = 200, .inertia = {6.8e-6}},
          .holding_torque = {0.45},
          .rated_current = {1.7},
          .resistance = {1.5},
          .inductance = {2.8e-3}};
}

// On a chopper of 24 V, with a load as heavy as the rotor. `excitation`: a name that Excitation::named() knows.
inline MotorSetup small_motor_setup(std::string_view excitation, NewtonMetres friction) {
  MotorSetup setup{.motor = small_motor(), .drive = {.supply = {24}}, .excitation = *Excitation::named(excitation)};
  setup.load = {.inertia = setup.motor.rotor.inertia, .friction = friction, .friction_per_speed = {}};
  setup.damping = damping_of(setup.motor);
  return setup;
}

}  // namespace passo
