// Rounding tolerances for a plan that keeps its limits: fractions of an axis' velocity and acceleration limits. A
// smaller jump does not count.
#pragma once

namespace passo::proof {

inline constexpr double velocity_rounding = 1e-6;
inline constexpr double acceleration_rounding = 1e-3;

}  // namespace passo::proof
