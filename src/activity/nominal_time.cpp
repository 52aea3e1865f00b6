#include "passo/activity/nominal_time.hpp"

#include <algorithm>
#include <variant>

namespace passo {
namespace {

// The highest speed on the path, at most `speed`, at which no axis with such slopes is faster than it can be.
double speed_within(const Point& slopes, double speed, const MotionLimits& limits) {
  for (const Axis axis : all_axes) {
    if (slopes[axis] > 0) speed = std::min(speed, limits.velocity[axis].value() / slopes[axis]);
  }
  return speed;
}

}  // namespace

Seconds nominal_time_of(const PathItem& item, const MotionLimits& limits) {
  if (const auto* action = std::get_if<Action>(&item)) return action->dwell;
  const auto& segment = std::get<Segment>(item);
  double speed = speed_within(segment.curve.steepest_bound(), segment.speed.value(), limits);
  // The exact slopes cost the trigonometry of an arc. They count only where the bound is felt.
  if (speed < segment.speed.value()) speed = speed_within(segment.curve.steepest(), segment.speed.value(), limits);
  return speed > 0 ? segment.curve.length() / MmPerSecond(speed) : Seconds(0);
}

}  // namespace passo
