#include "rest_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

// In seconds. A rise of the acceleration that takes less is a jump.
constexpr double shortest_rise = 1e-9;
// In seconds. A shorter phase is rounding.
constexpr double shortest_phase = 1e-12;

// The highest speed of a motion from rest to rest over this way.
double peak_speed(double way, const PathLimits& limits, double jerk) {
  const double sharp = std::cbrt(way * way * jerk / 4);  // the strongest acceleration is not reached
  const double rise = limits.acceleration / jerk;
  if (sharp <= limits.acceleration * rise) return std::min(sharp, limits.speed);
  const double root = std::sqrt(rise * rise + 4 * way / limits.acceleration);
  return std::min((root - rise) * limits.acceleration / 2, limits.speed);
}

}  // namespace

void add_rest_to_rest(double from, double to, const PathLimits& limits, PlannedMove& move) {
  const double way = to - from;
  const bool jumps = limits.acceleration < limits.jerk * shortest_rise;
  const double jerk = jumps ? std::numeric_limits<double>::infinity() : limits.jerk;
  const double peak = peak_speed(way, limits, jerk);
  const double strongest_used = std::min(limits.acceleration, std::sqrt(peak * jerk));
  const double rise = strongest_used / jerk;
  const double steady = std::max(peak / strongest_used - rise, 0.0);
  const double ramp_time = 2 * rise + steady;
  const double cruise = std::max(way / peak - ramp_time, 0.0);

  double at = from;
  double speed = 0;
  double acceleration = 0;
  const auto add = [&](double duration, double own_jerk) {
    if (!(duration > shortest_phase)) return;
    const Phase phase{.duration = Seconds(duration),
                      .start = Mm(at),
                      .velocity = MmPerSecond(speed),
                      .acceleration = MmPerSecond2(acceleration),
                      .jerk = MmPerSecond3(own_jerk)};
    move.add(phase);
    at = phase.position_at(phase.duration).value();
    speed = phase.velocity_at(phase.duration).value();
    acceleration += own_jerk * duration;
  };
  add(rise, jerk);
  acceleration = strongest_used;
  add(steady, 0);
  add(rise, -jerk);
  // The way back is the mirror image. It begins just where it has to, so that no rounding is left at its end.
  at = to - peak * ramp_time / 2 - peak * cruise;
  speed = peak;
  acceleration = 0;
  add(cruise, 0);
  at = to - peak * ramp_time / 2;
  speed = peak;
  add(rise, -jerk);
  acceleration = -strongest_used;
  add(steady, 0);
  add(rise, jerk);
  move.to = Mm(to);
}

}  // namespace passo
