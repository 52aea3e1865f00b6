#include "speed_profile.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic.hpp"

namespace passo {
namespace {

// Adds motion of constant acceleration from one speed to another over `distance`. The time follows from way and speeds,
// not from speed and acceleration. A difference of two nearly equal speeds has few good digits, while their sum has
// all. So the phase ends where it should, however short it is.
void add_stretch(double start, double distance, double from, double to, double limit, PlannedMove& move) {
  if (!(distance > 0)) return;
  const double duration = 2 * distance / (from + to);
  const double acceleration = std::clamp((to - from) / duration, -limit, limit);
  // The speed at rest is exactly 0, because the end of the phase subtracts this same product.
  if (to == 0) from = -(duration * acceleration);
  move.add({.duration = Seconds(duration),
            .start = Mm(start),
            .velocity = MmPerSecond(from),
            .acceleration = MmPerSecond2(acceleration),
            .jerk = MmPerSecond3(0)});
}

}  // namespace

void add_phases(const SpeedProfile& profile, PlannedMove& move) {
  const double begin = profile.start;
  const double length = profile.length;
  const double twice = 2 * profile.acceleration;
  const double crest = (profile.entry_squared + profile.exit_squared) / 2 + profile.acceleration * length;
  const double peak = std::clamp(crest, std::max(profile.entry_squared, profile.exit_squared), profile.top_squared);

  const double speeding = std::clamp((peak - profile.entry_squared) / twice, 0.0, length);
  double braking = std::clamp((peak - profile.exit_squared) / twice, 0.0, length - speeding);
  double cruising = length - speeding - braking;
  if (crest <= profile.top_squared) {  // no cruising: the two phases meet, whatever rounding says
    braking = length - speeding;
    cruising = 0;
  }

  const double entry = std::sqrt(profile.entry_squared);
  const double top = std::sqrt(peak);
  const double exit = std::sqrt(profile.exit_squared);
  add_stretch(begin, speeding, entry, top, profile.acceleration, move);
  add_stretch(begin + speeding, cruising, top, top, profile.acceleration, move);
  add_stretch(begin + length - braking, braking, top, exit, profile.acceleration, move);
}
void add_phase(double start, double length, double entry_squared, double exit_squared, PlannedMove& move) {
  const double entry = std::sqrt(entry_squared);
  if (entry_squared == exit_squared && move.phase_count > 0) {
    Phase& before = move.phases[move.phase_count - 1];
    if (before.acceleration == MmPerSecond2(0) && before.velocity == MmPerSecond(entry)) {
      before.duration += Seconds(length / entry);
      return;
    }
  }
  add_stretch(start, length, entry, std::sqrt(exit_squared), infinity, move);
}

void add_ride(const Segment& segment, const Cell& cell, double entry_squared, const Ride& ride,
              std::vector<PlannedMove>& plan) {
  const bool has_room = !plan.empty() && plan.back().phase_count < PlannedMove::most_phases &&
                        plan.back().to < plan.back().segment.curve.length();
  if (!has_room) plan.emplace_back().begin_on(segment);
  add_phase(cell.start, ride.way, entry_squared, ride.exit, plan.back());
  plan.back().to = Mm(ride.way < cell.length ? cell.start + ride.way : cell.end);
}

}  // namespace passo
