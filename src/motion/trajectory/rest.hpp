// The stops of a path between two of its segments, and the maximum speeds at which a motion may begin and end at a
// stop. Private to trajectory/.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// If the directions of two segments differ by more than this, the path has a corner, and the motion must stop there. At
// exactly this difference, the speed of an axis jumps by 1e-4 mm/s at 100 mm/s.
inline constexpr double tangent_tolerance = 1e-6;
// A component of a direction smaller than this is a rounding error: the axis does not move.
inline constexpr double least_part_of_direction = 1e-9;

inline bool rests_between(const Segment& before, const Segment& after) {
  if (before.mode == PathMode::exact_stop) return true;
  const Point change = after.curve.tangent(Mm(0)) - before.curve.tangent(before.curve.length());
  return std::any_of(change.values.begin(), change.values.end(),
                     [](double part) { return std::abs(part) > tangent_tolerance; });
}

// The squares of the path speeds at which a motion may begin and end at a stop. At these speeds no axis exceeds its
// start-stop velocity, and no axis' velocity jumps by more than that. An axis that can jump to any velocity is no
// limit.
class StopSpeeds {
 public:
  explicit StopSpeeds(const MotionLimits& limits)
      : limits_(limits),
        any_(std::ranges::any_of(limits.start_stop.values, [](MmPerSecond v) { return v > MmPerSecond(0); })) {}

  bool any() const { return any_; }
  // At the end of a path of this direction.
  double at_end(const Point& direction) const {
    return squared([&](std::size_t i, double velocity) { return room(velocity, direction.values[i]); });
  }
  // At the start of a path in this direction, right after a stop at which an earlier motion ended with this velocity.
  double at_start(const Point& direction, const Point& stopped) const {
    return squared([&](std::size_t i, double velocity) {
      const double part = direction.values[i];
      const double turned = std::min(part < 0 ? -stopped.values[i] : stopped.values[i], 0.0);
      return room(std::max(velocity + turned, 0.0), part);
    });
  }
  // For a path that continues in another direction: the speeds at the end of the first part and at the start of the
  // second. Each speed may be lower, independent of the other. An axis that reverses divides its velocity between the
  // two.
  struct Pair {
    double end = 0;
    double start = 0;
  };
  Pair between(const Point& before, const Point& after) const {
    Pair pair{.end = at_end(before), .start = at_end(after)};
    const double in = std::sqrt(pair.end);
    const double out = std::sqrt(pair.start);
    double share = 1;
    for (std::size_t i = 0; i < axis_count; ++i) {
      const double arriving = std::abs(before.values[i]);
      const double leaving = std::abs(after.values[i]);
      const bool turns_back = before.values[i] * after.values[i] < 0;
      if (!turns_back || !(limits_.acceleration.values[i] > MmPerSecond2(0))) continue;
      if (std::min(arriving, leaving) < least_part_of_direction) continue;
      const double jump = in * arriving + out * leaving;
      const double most = std::max(limits_.start_stop.values[i].value(), 0.0);
      if (jump > most) share = std::min(share, most / jump);
    }
    pair.end *= share * share;
    pair.start *= share * share;
    return pair;
  }

 private:
  static double room(double velocity, double part) {
    return std::abs(part) < least_part_of_direction ? fastest : std::min(velocity / std::abs(part), fastest);
  }
  template <class SpeedOfAxis>
  double squared(const SpeedOfAxis& speed_of_axis) const {
    if (!any_) return 0;
    double speed = fastest;
    for (std::size_t i = 0; i < axis_count; ++i) {
      if (!(limits_.acceleration.values[i] > MmPerSecond2(0))) continue;
      speed = std::min(speed, speed_of_axis(i, std::max(limits_.start_stop.values[i].value(), 0.0)));
    }
    return speed * speed;
  }

  const MotionLimits& limits_;
  bool any_;
};

}  // namespace passo
