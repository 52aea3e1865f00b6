// RampSetup: the parameters of a ramp: the motor, its clock and the acceleration; and the capabilities of a table of N
// entries.
//
// K_b = f_ck √(2α/a) is the first interval from standstill, in ticks, with the step angle α = 2π / steps per
// revolution. Real numbers of ticks are doubles; counted ticks are integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "passo/units/units.hpp"

namespace passo {

struct RampSetup {
  Hertz clock{0};
  std::int32_t steps_per_turn = 0;
  RadiansPerSecond2 acceleration;
};

constexpr Radians step_angle(std::int32_t steps_per_turn) {
  return {2 * std::numbers::pi / steps_per_turn};
}

// Returns K_b², in ticks².
constexpr double first_interval_squared(const RampSetup& setup) {
  const double f = setup.clock.value();
  return f * f * 2 * step_angle(setup.steps_per_turn).value / setup.acceleration.value;
}
// Returns K_b, in ticks.
inline double first_interval(const RampSetup& setup) {
  return std::sqrt(first_interval_squared(setup));
}

// Returns the minimum acceleration with which a table of N entries reaches `rate`: a_lim = π f² / (N · steps per
// revolution).
constexpr RadiansPerSecond2 least_acceleration(Hertz rate, std::int64_t table_size, std::int32_t steps_per_turn) {
  const double f = rate.value();
  return {std::numbers::pi * f * f / (static_cast<double>(table_size) * steps_per_turn)};
}
// Returns the rate after N steps from standstill: f = √(2aN/α). The motor keeps it at the end of a table of N entries.
inline Hertz reached_rate(RadiansPerSecond2 acceleration, std::int64_t table_size, std::int32_t steps_per_turn) {
  const double square = 2 * acceleration.value * static_cast<double>(table_size) / step_angle(steps_per_turn).value;
  return Hertz(std::sqrt(square));
}

}  // namespace passo
