// Computes the sweep angle of an RS274/NGC arc.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace passo {

// Returns the angle from start to end in the direction given by the sign of `turns`. For 1 or -1 it is at most one full
// circle. As in LinuxCNC's canon layer, directions closer than a millionth of a radian count as equal, and the arc is
// then a full circle.
inline double sweep_between(double start_angle, double end_angle, std::int32_t turns) {
  constexpr double same_direction = 1e-6;
  constexpr double full = 2 * std::numbers::pi;
  const double sense = turns > 0 ? 1 : -1;
  double sweep = sense * (end_angle - start_angle);
  if (sweep < same_direction) sweep += full;
  return sense * (sweep + full * (std::abs(static_cast<double>(turns)) - 1));
}

}  // namespace passo
