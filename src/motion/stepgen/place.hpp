// Motor positions in the board's own units: 1/65536 of a step, with half a step added. So a motor's step count is
// position/65536, rounded down. A step occurs where the position crosses a multiple of 65536.
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/kinematics/kinematics.hpp"

namespace passo {

// Position units per step.
inline constexpr double place_per_step = 65536.0;

// For a motor without a screw.
inline double place_of(const MotorRow& motor, const Point& point) {
  return (motor.steps.of(point) + motor.offset + 0.5) * place_per_step;
}

}  // namespace passo
