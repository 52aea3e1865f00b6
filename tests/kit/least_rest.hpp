// The least time in which a machine can come to rest, in closed form: no motion takes less. Each axis is considered
// separately; on a line that is long enough to stop on, all of them together. It shares no code with the planner.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo::test {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The motion of an axis at an instant.
struct AxisState {
  double velocity = 0;
  double acceleration = 0;
};

// The limits of an axis, or of the motion along a line.
struct RestLimits {
  std::function<double(double velocity)> acceleration_at;
  double acceleration = 0;  // the highest
  double jerk = 0;          // 0: no limit
  double start_stop = 0;
};

// Returns the least time from a velocity to zero, if only the acceleration is limited. The motion may jump from the
// start-stop velocity to zero.
inline double least_rest_by_acceleration(const RestLimits& limits, double velocity) {
  constexpr int slices = 64;
  const double from = std::abs(velocity);
  const double to = std::min(from, limits.start_stop);
  const double slice = (from - to) / slices;
  double time = 0;
  // The limit at the lowest speed of a slice is the highest.
  for (int i = 0; i < slices; ++i) time += slice / limits.acceleration_at(to + i * slice);
  return time;
}

// Returns the least time to rest with zero acceleration, if acceleration and jerk are limited.
inline double least_rest_by_jerk(double acceleration_limit, double jerk, AxisState from) {
  const double sign = from.velocity < 0 ? -1 : 1;
  const double a = std::clamp(sign * from.acceleration, -acceleration_limit, acceleration_limit);
  const double change = a * std::abs(a) / (2 * jerk);  // of the velocity, while the acceleration returns to zero
  const double velocity = std::abs(from.velocity) + change;
  if (velocity < 0) return 0;  // it brakes harder than it needs to, and would have to reverse: the path does not
  // An axis that brakes has come from a higher velocity with zero acceleration.
  const double highest = a > 0 ? velocity : std::abs(from.velocity) - change;
  const double braking = highest * jerk > acceleration_limit * acceleration_limit
                             ? highest / acceleration_limit + acceleration_limit / jerk
                             : 2 * std::sqrt(highest / jerk);
  return std::max(a / jerk + braking, 0.0);
}

// Returns the least time to rest if both are limited and the acceleration may be higher at lower velocities: by short
// steps of time, the acceleration falls with the jerk down to the limit, follows it, and returns to zero.
inline double least_rest_by_both(const RestLimits& limits, const AxisState& from, double about) {
  constexpr int steps = 2000;
  const double step = about / steps;
  double velocity = std::abs(from.velocity) - limits.start_stop;
  double acceleration = from.velocity < 0 ? -from.acceleration : from.acceleration;
  for (int i = 0; i < 4 * steps; ++i) {
    const double easing = acceleration < 0 ? acceleration * acceleration / (2 * limits.jerk) : 0;
    // The velocity that is lost while the acceleration returns to zero, at its mean.
    if (velocity <= easing) return std::max(i - 1, 0) * step + 2 * velocity / std::max(-acceleration, 1e-300);
    const double most = limits.acceleration_at(std::max(velocity, 0.0) + limits.start_stop);
    const double next = std::max(acceleration - limits.jerk * step, std::min(-most, acceleration));
    velocity += (acceleration + next) / 2 * step;
    acceleration = acceleration < -most ? -most : next;
  }
  return about;
}

// At the start-stop velocity there is no acceleration any more.
inline double least_rest(const RestLimits& limits, const AxisState& from) {
  const double by_acceleration = least_rest_by_acceleration(limits, from.velocity);
  if (limits.jerk == 0 || std::abs(from.velocity) <= limits.start_stop) return by_acceleration;
  const AxisState above{.velocity = from.velocity - std::copysign(limits.start_stop, from.velocity),
                        .acceleration = from.acceleration};
  const double least = std::max(by_acceleration, least_rest_by_jerk(limits.acceleration, limits.jerk, above));
  // A hundredth is left for the steps, and for what rounding makes of the state.
  return std::max(least, 0.99 * least_rest_by_both(limits, from, least));
}

inline RestLimits rest_limits_of(const AxisDescription& axis) {
  return {.acceleration_at = [&axis](double speed) { return axis.acceleration_at(MmPerSecond(speed)).value(); },
          .acceleration = axis.acceleration.value(),
          .jerk = axis.jerk.value(),
          .start_stop = axis.start_stop.value()};
}

// Those of the motion along a line with this slope: an axis limits the acceleration, and another may limit the jerk.
inline RestLimits rest_limits_along(const Point& slope, const std::vector<AxisDescription>& axes) {
  RestLimits along{.acceleration_at = {}, .acceleration = infinite, .jerk = 0, .start_stop = infinite};
  for (const AxisDescription& axis : axes) {
    const double part = std::abs(slope[axis.axis]);
    if (part == 0) continue;
    along.acceleration = std::min(along.acceleration, axis.acceleration.value() / part);
    along.start_stop = std::min(along.start_stop, axis.start_stop.value() / part);
    const double jerk = axis.jerk.value() / part;
    if (jerk > 0) along.jerk = along.jerk > 0 ? std::min(along.jerk, jerk) : jerk;
  }
  along.acceleration_at = [slope, &axes](double speed) {
    double least = infinite;
    for (const AxisDescription& axis : axes) {
      const double part = std::abs(slope[axis.axis]);
      if (part > 0) least = std::min(least, axis.acceleration_at(MmPerSecond(speed * part)).value() / part);
    }
    return least;
  };
  return along;
}

struct LeastRest {
  double time = 0;
  // Whether the path is straight until then. On a bend the time may be far below what is possible: each axis is alone
  // there, but the path binds them together, and bending alone uses up part of the limits.
  bool is_on_line = false;
};

// Returns the least time to rest from the end of a move.
inline LeastRest least_rest_after(const PlannedMove& move, const std::vector<AxisDescription>& axes) {
  const Phase& last = *std::prev(move.end());
  const AxisState along{.velocity = move.exit_velocity().value(),
                        .acceleration = last.acceleration_at(last.duration).value()};
  const Curve& curve = move.segment.curve;
  const Point slope = curve.tangent(move.to);
  const Mm before = move.to * (1 - 1e-4);
  const Point slope_before = curve.tangent(before);
  double least = 0;
  for (const AxisDescription& axis : axes) {
    const double first = slope[axis.axis];
    const double second = move.to > before ? (first - slope_before[axis.axis]) / (move.to - before).value() : 0;
    const AxisState state{.velocity = first * along.velocity,
                          .acceleration = first * along.acceleration + second * along.velocity * along.velocity};
    least = std::max(least, least_rest(rest_limits_of(axis), state));
  }
  if (curve.shape() != Curve::Shape::line) return {.time = least, .is_on_line = false};
  const RestLimits limits = rest_limits_along(slope, axes);
  const double together = least_rest(limits, along);
  const double left = (curve.length() - move.to).value();
  const double raised = limits.jerk > 0 ? std::max(along.acceleration, 0.0) / limits.jerk * along.acceleration / 2 : 0;
  // While it stops, it is never faster than this.
  const bool is_on_line = (along.velocity + raised) * together < left;
  return {.time = is_on_line ? std::max(least, together) : least, .is_on_line = is_on_line};
}

}  // namespace passo::test
