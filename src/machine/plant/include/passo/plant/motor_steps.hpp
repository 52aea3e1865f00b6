// MotorSteps: how far the motors of a plant were told to go. MotorPositions: where the motors are.
#pragma once

#include <array>
#include <cstdint>

#include "passo/wire/board_segment.hpp"

namespace passo {

using MotorSteps = std::array<std::int64_t, max_motors>;  // pulses up minus pulses down
using MotorPositions = std::array<double, max_motors>;    // in steps; a real motor may stand between two steps

}  // namespace passo
