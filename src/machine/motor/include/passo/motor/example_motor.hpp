// The small motor of the examples: `passo loop` without a machine file, docs/ramps/torque.md, tests and benchmarks.
//
// A 1.8° NEMA 17 motor, 42 mm square and 48 mm long, with typical data sheet values.
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

// On a 24 V chopper drive, with a load inertia equal to the rotor's. `excitation`: a name accepted by
// Excitation::named().
inline MotorSetup small_motor_setup(std::string_view excitation, NewtonMetres friction) {
  MotorSetup setup{.motor = small_motor(), .drive = {.supply = {24}}, .excitation = *Excitation::named(excitation)};
  setup.load = {.inertia = setup.motor.rotor.inertia, .friction = friction, .friction_per_speed = {}};
  setup.damping = damping_of(setup.motor);
  return setup;
}

}  // namespace passo
