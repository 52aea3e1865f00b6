// JerkProfile: the speeds and accelerations with which a motion may begin or end at a stop, by the start-stop
// velocities.
#include <array>
#include <cmath>
#include <span>

#include "arithmetic.hpp"
#include "jerk_profile.hpp"

namespace passo {

// The stop at the start or at the end of the window. A motion may begin or end there in any state in which no axis with
// a jerk limit has an acceleration, except for rounding, and no axis exceeds a limit. So each axis leaves an interval
// of a:
//
//     |q' a + q'' x| <= S        a between (-q'' x - S) / q' and (-q'' x + S) / q'
//
// The intervals have a value in common if each two of them have, which limits x. Where the path bends, a is not 0: an
// axis with a jerk limit keeps its velocity while the direction changes.
JerkOptimizer::Stop JerkProfile::stop_at(bool begins) const {
  const std::size_t cell = begins ? 0 : cells_.size() - 1;
  const double velocity = begins
                              ? node_cap_[0]
                              : planned_velocity * planned_velocity *
                                    velocity_cap(cell, [](const AxisShape& shape, double) { return shape.slope_out; });
  JerkOptimizer::Stop stop{.square = std::min(begins ? ends_.start_squared : ends_.end_squared, velocity)};
  if (stop.square == 0 || cells_[cell].straight) return stop;
  struct Demand {
    double slope, bend, third, strength, jerk;
  };
  std::array<Demand, most_limited_axes> demands{};
  const AxisShape* shape = shapes(cell);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double slope = begins ? shape->slope_in : shape->slope_out;
    demands[k] = {.slope = slope,
                  .bend = begins ? shape->bend_in : shape->bend_out,
                  .third = begins ? shape->third_in : shape->third_out,
                  .strength = axes_[k].limits_jerk() ? unseen_jump * axes_[k].acceleration
                                                     : axes_[k].acceleration_at(slope * slope * stop.square),
                  .jerk = axes_[k].jerk};
  }
  const std::span<const Demand> axes(demands.data(), axes_.size());
  // The greatest factor with which each two axes leave something in common.
  const auto most_of = [&axes](const auto& turn_of, double Demand::*limit) {
    double most = infinity;
    for (const Demand& one : axes) {
      for (const Demand& other : axes) {
        const double crossed = std::abs(turn_of(one) * other.slope - turn_of(other) * one.slope);
        const double allowed = one.*limit * std::abs(other.slope) + other.*limit * std::abs(one.slope);
        if (crossed * most > allowed) most = allowed / crossed;
      }
    }
    return most;
  };
  stop.square = std::min(stop.square, most_of([](const Demand& axis) { return axis.bend; }, &Demand::strength));
  double least = -infinity;
  double greatest = infinity;
  for (const Demand& axis : axes) {
    if (axis.slope == 0) continue;
    const double middle = -axis.bend * stop.square / axis.slope;
    const double room = axis.strength / std::abs(axis.slope);
    least = std::max(least, middle - room);
    greatest = std::min(greatest, middle + room);
  }
  stop.bend = std::max(std::min(0.0, greatest), least) / stop.square;
  const auto turn_of = [&](const Demand& axis) { return 3 * axis.bend * stop.bend + axis.third; };
  stop.square = std::min(stop.square, std::pow(most_of(turn_of, &Demand::jerk), 2.0 / 3));
  return stop;
}

}  // namespace passo
