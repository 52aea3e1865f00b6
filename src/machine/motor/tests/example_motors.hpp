// Motors for the tests: one of each size with typical data sheet values, and random ones.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "passo/motor/example_motor.hpp"

namespace passo::test {

using passo::small_motor;

// 57 mm square, 76 mm long.
inline MotorData large_motor() {
  return {.rotor = {.steps_per_revolution = 200, .inertia = {48e-6}},
          .holding_torque = {1.9},
          .rated_current = {2.8},
          .resistance = {1.13},
          .inductance = {3.6e-3}};
}

// Returns a motor on the test bench: with a 24 V drive, a load inertia equal to the rotor's, and that fraction of
// critical damping.
inline MotorSetup on_the_bench(const MotorData& motor, const std::string& excitation, double damping,
                               Regulation regulation = Regulation::chopper) {
  MotorSetup setup{.motor = motor,
                   .drive = {.supply = {24}, .regulation = regulation},
                   .excitation = *Excitation::named(excitation)};
  setup.load.inertia = motor.rotor.inertia;
  setup.damping = damping_of(motor, damping);
  return setup;
}

struct Driven {
  MotorData motor;
  MotorDrive drive;
};

// Returns random plausible values, each over a decade or more, with a uniform distribution of the logarithm.
inline Driven random_motor(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
  };
  const double current = between(0.3, 5);
  const double resistance = between(1, 6) / current;
  MotorData motor{
      .rotor = {.steps_per_revolution = 4 * static_cast<int>(between(6, 101)), .inertia = {between(1e-6, 3e-4)}},
      .holding_torque = {between(0.05, 4)},
      .rated_current = {current},
      .resistance = {resistance},
      .inductance = {resistance * between(5e-4, 4e-3)}};
  return {motor, {.supply = {current * resistance * between(1.2, 20)}}};
}

}  // namespace passo::test
