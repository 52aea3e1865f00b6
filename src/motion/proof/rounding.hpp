// What rounding may leave in a plan that keeps its limits: shares of an axis's limit of velocity and of acceleration. A
// jump by less is none.
#pragma once

namespace passo::proof {

inline constexpr double velocity_rounding = 1e-6;
inline constexpr double acceleration_rounding = 1e-3;

}  // namespace passo::proof
