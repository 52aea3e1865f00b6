// JerkProfile: makes phases of constant jerk of the planned squares of speeds, and measures what the phases ask of each
// axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "jerk_profile.hpp"
#include "parabola.hpp"

namespace passo {
namespace {

constexpr double most_above_cap = 4;
// In a bend a demand may be higher between the places looked at, so that only a share of a limit may be seen. Five
// places of a cell are looked at, with a parabola through each three. Where the most that is seen is near that share,
// four times as many places are looked at, and nearly all of the limit may be seen.
constexpr double share_seen = 0.99;
constexpr double share_seen_closely = 0.999;
constexpr double looked_at_closely = 0.96;
constexpr double not_worth_a_look = 1.02;
constexpr double looked_at_velocity = 0.99995;
constexpr std::size_t close_parts = 4;
constexpr std::size_t most_places = 2 * close_parts + 1;  // of half a cell
constexpr double much_of_slope = 0.1;
constexpr double far_below = 0.95;  // a share of a limit, less than `share_seen` times `looked_at_closely`
constexpr double unseen_change = 1e-6;
constexpr double weak = 100;       // mm/s², where axes have no limit
constexpr double no_speed = 1e-9;  // times the speed beside it: rounding

// The largest share of a falling limit that is asked for where the limit goes on with its next line. There a demand may
// have a peak, which no parabola through three places shows. `pace`, `force`: the axis's speed and acceleration there.
double highest_at_bends(const LimitedAxis& axis, const std::array<double, 3>& pace,
                        const std::array<double, 3>& force) {
  double most = 0;
  for (std::size_t at = 1; at < pace.size(); ++at) {
    const double from = pace[at - 1] * pace[at - 1];
    const double to = pace[at] * pace[at];
    for (const double bend : axis.falling->bends_between(std::min(from, to), std::max(from, to))) {
      const double asked = std::lerp(force[at - 1], force[at], (bend - from) / (to - from));
      most = std::max(most, std::abs(asked) / axis.acceleration_at(bend));
    }
  }
  return most;
}

// Raises `worst` to value / limit. The quotient is mostly below `worst`, and a product tells that sooner.
void raise_to(double& worst, double value, double limit) {
  if (value > worst * limit) worst = value / limit;
}

}  // namespace

PhasePair JerkProfile::pair_of(std::size_t i) const {
  return PhasePair::over(cells_[i].length, states_[i], states_[i + 1]);
}

double JerkProfile::highest(const NodeState& from, double jerk, double time) {
  const bool turns = from.acceleration > 0 && from.acceleration + jerk * time < 0;
  return turns ? from.speed - from.acceleration * from.acceleration / (2 * jerk) : from.speed;
}

// Whether the phases exist and never run backwards, at any speed.
bool JerkProfile::is_possible(const PhasePair& pair, const NodeState& from) {
  const auto lowest = [](const NodeState& at, double jerk, double time) {
    const bool turns = at.acceleration < 0 && at.acceleration + jerk * time > 0;
    return turns ? at.speed - at.acceleration * at.acceleration / (2 * jerk) : at.speed;
  };
  const double least = -no_speed * std::max(from.speed, pair.middle.speed);
  return pair.half > 0 && pair.middle.speed >= 0 && lowest(from, pair.first, pair.half) >= least &&
         lowest(pair.middle, pair.second, pair.half) >= least;
}

JerkProfile::Inside JerkProfile::inside(const NodeState& from, double jerk, double time) {
  return {.state = {.speed = from.speed + time * (from.acceleration + time * jerk / 2),
                    .acceleration = from.acceleration + time * jerk},
          .way = time * (from.speed + time * (from.acceleration / 2 + time * jerk / 6))};
}

// The largest demands in a cell, as multiples of the limits.
JerkProfile::Excess JerkProfile::excess(std::size_t i) const {
  const PhasePair pair = pair_of(i);
  const NodeState from = states_[i];
  if (!is_possible(pair, from)) return {.force = 2, .jolt = 2};
  const NodeState to = states_[i + 1];
  const JerkCell& cell = cells_[i];
  // Rounding off the corner between straight pieces lifts the speed at a low place. Where a jump must stay unseen, that
  // may be too much.
  if (from.speed * from.speed > most_above_cap * passing_cap_[i]) return {.pace = 2};
  const double top =
      std::max({to.speed, highest(from, pair.first, pair.half), highest(pair.middle, pair.second, pair.half)});
  if (cell.straight) {
    const double jerk = std::max(std::abs(pair.first), std::abs(pair.second)) / cell.jerk;
    const double acceleration =
        std::max({std::abs(from.acceleration), std::abs(to.acceleration), std::abs(pair.middle.acceleration)}) /
        cell.acceleration;
    return {.force = acceleration, .jolt = jerk, .pace = top * top / cell.top_squared};
  }
  Excess worst{.pace = top * top / cell.top_squared};
  const std::uint32_t near = axes_near_limits(
      i,
      {.speed = top,
       .acceleration =
           std::max({std::abs(from.acceleration), std::abs(to.acceleration), std::abs(pair.middle.acceleration)})},
      std::max(std::abs(pair.first), std::abs(pair.second)));
  if (near == 0) return worst;
  const auto look = [&](std::size_t parts) {
    check_half(i, near, from, pair.first, pair.half, 0, parts, worst);
    const double way = inside(from, pair.first, pair.half).way;
    check_half(i, near, pair.middle, pair.second, pair.half, way, parts, worst);
  };
  const double pace = worst.pace;
  look(1);
  const double most = std::max({worst.force, worst.jolt, turns_much(i, near) ? worst.pace : 0});
  if (most > looked_at_closely && most < not_worth_a_look) {
    worst = {.pace = pace};
    look(close_parts);
  }
  return worst;
}

// The axes that may be near a limit in a cell, one bit each: those whose largest derivatives, with the largest speed,
// acceleration and jerk anywhere in the cell, demand that much.
std::uint32_t JerkProfile::axes_near_limits(std::size_t i, const NodeState& most, double jerk) const {
  const double x = most.speed * most.speed;
  const double length = cells_[i].length;
  const AxisShape* shape = shapes(i);
  std::uint32_t near = 0;
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double third = std::max(std::abs(shape->third_in), std::abs(shape->third_out));
    const double bend = std::max(std::abs(shape->bend_in), std::abs(shape->bend_out));
    const double slope = std::max(std::abs(shape->slope_in), std::abs(shape->slope_out)) + length * length / 8 * third;
    const double force = slope * most.acceleration + bend * x;
    const double jolt = slope * jerk + most.speed * (3 * bend * most.acceleration + third * x);
    const bool is_far = !axes_[k].falls_at(slope * slope * x) && slope * most.speed < far_below * axes_[k].velocity &&
                        force < far_below * axes_[k].acceleration && jolt < far_below * axes_[k].jerk;
    if (!is_far) near |= std::uint32_t{1} << k;
  }
  return near;
}

// Whether the slope of one of the axes changes much in a cell. Else a parabola shows its velocity to six digits.
bool JerkProfile::turns_much(std::size_t i, std::uint32_t axes) const {
  const AxisShape* shape = shapes(i);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double change = std::abs(shape->slope_out - shape->slope_in);
    if ((axes >> k & 1) != 0 &&
        change > much_of_slope * std::max(std::abs(shape->slope_in), std::abs(shape->slope_out))) {
      return true;
    }
  }
  return false;
}

// Looks at half the time of a cell that is not straight, in `parts` parts. `way` is the distance from the cell's start
// to the start of that half. `axes`: those to look at, one bit each.
void JerkProfile::check_half(std::size_t i, std::uint32_t axes, const NodeState& start, double jerk, double time,
                             double way, std::size_t parts, Excess& worst) const {
  const double length = cells_[i].length;
  const double seen = parts > 1 ? share_seen_closely : share_seen;
  const std::size_t count = 2 * parts + 1;
  std::array<Inside, most_places> places;
  for (std::size_t at = 0; at < count; ++at) {
    places[at] = inside(start, jerk, time * static_cast<double>(at) / static_cast<double>(count - 1));
  }
  std::array<double, most_places> force{};
  std::array<double, most_places> jolt{};
  std::array<double, most_places> pace{};
  const auto three_from = [](const std::array<double, most_places>& list, std::size_t at) {
    return std::array<double, 3>{list[at], list[at + 1], list[at + 2]};
  };
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if ((axes >> k & 1) == 0) continue;
    const LimitedAxis& axis = axes_[k];
    const ShapeInside own(shapes(i)[k], length);
    for (std::size_t at = 0; at < count; ++at) {
      const double share = (way + places[at].way) / length;
      const double bend = own.bend(share);
      const double slope = own.slope(share);
      const double v = places[at].state.speed;
      const double a = places[at].state.acceleration;
      pace[at] = slope * v;
      force[at] = slope * a + bend * v * v;
      jolt[at] = slope * jerk + v * (3 * bend * a + own.third(share) * v * v);
    }
    if (any_falls_ && axis.falling != nullptr) {
      for (std::size_t at = 0; at + 2 < count; at += 2) {
        raise_to(worst.force, highest_at_bends(axis, three_from(pace, at), three_from(force, at)), seen);
      }
      for (std::size_t at = 0; at < count; ++at)
        force[at] *= axis.acceleration / axis.acceleration_at(pace[at] * pace[at]);
    }
    const double velocity = axis.velocity * looked_at_velocity;
    for (std::size_t at = 0; at + 2 < count; at += 2) {
      const double fastest_here = highest_through(three_from(pace, at));
      raise_to(worst.pace, fastest_here * fastest_here, velocity * velocity);
      raise_to(worst.force, highest_through(three_from(force, at)), axis.acceleration * seen);
      raise_to(worst.jolt, highest_through(three_from(jolt, at)), axis.jerk * seen);
    }
  }
}

void JerkProfile::add_phases(std::size_t i, PlannedMove& move) const {
  const PhasePair pair = pair_of(i);
  const NodeState from = states_[i];
  const JerkCell& cell = cells_[i];
  const double change = std::max(std::abs(pair.first), std::abs(pair.second)) * pair.half;
  if (change <= unseen_change * std::min(cell.acceleration, weak) && from.speed > 0 && states_[i + 1].speed > 0) {
    add_steady(cell, from, states_[i + 1].speed, move);
    return;
  }
  const double way = pair.half * (from.speed + pair.half * (from.acceleration / 2 + pair.half * pair.first / 6));
  move.add({.duration = Seconds(pair.half),
            .start = Mm(cell.start),
            .velocity = MmPerSecond(from.speed),
            .acceleration = MmPerSecond2(from.acceleration),
            .jerk = MmPerSecond3(pair.first)});
  move.add({.duration = Seconds(pair.half),
            .start = Mm(cell.start + way),
            .velocity = MmPerSecond(pair.middle.speed),
            .acceleration = MmPerSecond2(pair.middle.acceleration),
            .jerk = MmPerSecond3(pair.second)});
}

// Adds a phase without jerk. If the phase before has the same acceleration, it is made longer instead.
void JerkProfile::add_steady(const JerkCell& cell, const NodeState& from, double exit, PlannedMove& move) const {
  Phase phase{.duration = Seconds(0),
              .start = Mm(cell.start),
              .velocity = MmPerSecond(from.speed),
              .acceleration = MmPerSecond2(0),
              .jerk = MmPerSecond3(0)};
  if (move.phase_count > 0) {
    const Phase& before = move.phases[move.phase_count - 1];
    if (before.jerk == MmPerSecond3(0) && std::abs(before.acceleration.value() - from.acceleration) <=
                                              4 * unseen_change * std::min(cell.acceleration, weak)) {
      phase = before;
      --move.phase_count;
    }
  }
  const double way = cell.start + cell.length - phase.start.value();
  phase.duration = Seconds(2 * way / (phase.velocity.value() + exit));
  phase.acceleration = MmPerSecond2((exit - phase.velocity.value()) / phase.duration.value());
  move.add(phase);
}

}  // namespace passo
