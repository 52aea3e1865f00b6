#include "rest_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phase_chain.hpp"

namespace passo {
namespace {

// In seconds. A rise of the acceleration that takes less is a jump.
constexpr double shortest_rise = 1e-9;

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

  PhaseChain chain{.at = from};
  const auto add = [&](double duration, double own_jerk) {
    if (const auto phase = chain.next(duration, own_jerk)) move.add(*phase);
  };
  add(rise, jerk);
  chain.acceleration = strongest_used;
  add(steady, 0);
  add(rise, -jerk);
  // The way back is the mirror image. It begins just where it has to, so that no rounding is left at its end.
  chain = {.at = to - peak * ramp_time / 2 - peak * cruise, .speed = peak};
  add(cruise, 0);
  chain = {.at = to - peak * ramp_time / 2, .speed = peak};
  add(rise, -jerk);
  chain.acceleration = -strongest_used;
  add(steady, 0);
  add(rise, jerk);
  move.to = Mm(to);
}

}  // namespace passo
