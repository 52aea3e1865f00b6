#include "rest_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phase_chain.hpp"

namespace passo {
namespace {

// In seconds. A rise of the acceleration that takes less is a jump.
constexpr double shortest_rise = 1e-9;
constexpr int halvings = 60;  // of a bisection: down to rounding

// A change of the speed, from no acceleration to none.
struct Ramp {
  double rise = 0;    // s, in which the acceleration reaches its strongest, and again in which it falls to 0
  double steady = 0;  // s, with the strongest acceleration
  double strongest = 0;

  double time() const { return 2 * rise + steady; }
};

Ramp ramp_over(double change, const PathLimits& limits) {
  const double strongest = std::min(limits.acceleration, std::sqrt(std::max(change, 0.0) * limits.jerk));
  if (!(strongest > 0)) return {};
  const double rise = strongest / limits.jerk;
  return {.rise = rise, .steady = std::max(change / strongest - rise, 0.0), .strongest = strongest};
}

double length_of(const Ramp& ramp, double low, double high) {
  return ramp.time() * (low + high) / 2;
}

// The highest speed of a motion from standstill to standstill over this way.
double peak_from_standstill(double way, const PathLimits& limits) {
  const double sharp = std::cbrt(way * way * limits.jerk / 4);  // the strongest acceleration is not reached
  const double rise = limits.acceleration / limits.jerk;
  if (sharp <= limits.acceleration * rise) return std::min(sharp, limits.speed);
  const double root = std::sqrt(rise * rise + 4 * way / limits.acceleration);
  return std::min((root - rise) * limits.acceleration / 2, limits.speed);
}

// The highest number from `low` to `high` that fits. The lowest one does.
template <class Fits>
double highest_that(const Fits& fits, double low, double high) {
  if (fits(high)) return high;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

void add_rest_to_rest(const WayBetweenStops& between, const PathLimits& limits_of_path, PlannedMove& move) {
  const auto [from, to, most_entry, most_exit] = between;
  const double way = to - from;
  PathLimits limits = limits_of_path;
  const bool jumps = limits.acceleration < limits.jerk * shortest_rise;
  if (jumps) limits.jerk = std::numeric_limits<double>::infinity();
  double entry = std::min(most_entry, limits.speed);
  double exit = std::min(most_exit, limits.speed);
  double peak = 0;
  if (entry == 0 && exit == 0) {
    peak = peak_from_standstill(way, limits);
  } else {
    // The faster end may be too fast for the slower one.
    double& faster = entry > exit ? entry : exit;
    const double slower = std::min(entry, exit);
    faster =
        highest_that([&](double speed) { return length_of(ramp_over(speed - slower, limits), slower, speed) <= way; },
                     slower, faster);
    peak = highest_that(
        [&](double speed) {
          return length_of(ramp_over(speed - entry, limits), entry, speed) +
                     length_of(ramp_over(speed - exit, limits), exit, speed) <=
                 way;
        },
        faster, limits.speed);
  }
  const Ramp up = ramp_over(peak - entry, limits);
  const Ramp down = ramp_over(peak - exit, limits);
  const double braking = length_of(down, exit, peak);
  const double cruise = std::max(way - length_of(up, entry, peak) - braking, 0.0) / peak;

  PhaseChain chain{.at = from, .speed = entry};
  const auto add = [&](double duration, double own_jerk) {
    if (const auto phase = chain.next(duration, own_jerk)) move.add(*phase);
  };
  add(up.rise, limits.jerk);
  chain.acceleration = up.strongest;
  add(up.steady, 0);
  add(up.rise, -limits.jerk);
  // The way back is the mirror image. It begins just where it has to, so that no rounding is left at its end.
  chain = {.at = to - braking - peak * cruise, .speed = peak};
  add(cruise, 0);
  chain = {.at = to - braking, .speed = peak};
  add(down.rise, -limits.jerk);
  chain.acceleration = -down.strongest;
  add(down.steady, 0);
  add(down.rise, limits.jerk);
  move.to = Mm(to);
}

}  // namespace passo
