// MotorSteps: the commanded steps of a plant's motors. MotorPositions: the true positions of the motors.
#pragma once

#include <array>
#include <cstdint>

#include "passo/wire/board_segment.hpp"

namespace passo {

using MotorSteps = std::array<std::int64_t, max_motors>;  // pulses up minus pulses down
using MotorPositions = std::array<double, max_motors>;    // in steps; a real motor may be between two steps

}  // namespace passo
