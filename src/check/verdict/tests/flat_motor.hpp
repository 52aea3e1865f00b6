// A motor for tests: 1 N·m at all rates, without friction, on a screw with 5 mm lead.
#pragma once

#include <numbers>

#include "passo/motor/running_motor.hpp"

namespace passo::test {

inline constexpr double flat_radians_per_mm = 2 * std::numbers::pi / 5;
inline constexpr double flat_inertia = 1e-4;

inline MotorSetup flat_setup() {
  const auto curve = TorqueCurve::from_points({.steps_per_revolution = 200, .inertia = {flat_inertia}},
                                              {{Hertz(0), {1.0}}, {Hertz(1e5), {0.999999}}});
  return measured_setup(*curve, *Excitation::named("microsteps:8"));
}

// Returns the axis acceleration for this torque, in mm/s².
inline double flat_acceleration(double torque) {
  return torque / flat_inertia / flat_radians_per_mm;
}

}  // namespace passo::test
