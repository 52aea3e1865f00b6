// JerkProfile: from planned squares of speeds to phases of constant jerk, and what these ask of each axis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "jerk_profile.hpp"

namespace passo {
namespace {

constexpr double most_growth = 3;  // of x within a cell where more cannot be played
constexpr double most_above_cap = 4;
constexpr double least_share = 0.2;
constexpr double looked_at = 0.99;  // curves are looked at in five places of a cell
constexpr double unseen_change = 1e-6;
constexpr double weak = 100;    // mm/s², for axes without a limit
constexpr double accepted = 1;  // of a limit

}  // namespace

JerkProfile::State JerkProfile::state(std::size_t node) const {
  const std::size_t n = cells_.size();
  if (node == 0 && frozen_ > 0) return start_;
  if (node == 0 || node == n || x_[node] <= 0) return {};
  const double left = cells_[node - 1].length;
  const double right = cells_[node].length;
  const double before = slope(node - 1);
  const double after = slope(node);
  if (x_[node - 1] <= 0) return {.speed = std::sqrt(x_[node]), .acceleration = before * 4 / 3};
  if (x_[node + 1] <= 0) return {.speed = std::sqrt(x_[node]), .acceleration = after * 4 / 3};
  const double share = left / (left + right);
  return {.speed = std::sqrt(std::max(x_[node] + (after - before) * share * right / 2, 0.0)),
          .acceleration = before + (after - before) * share};
}

// From one state to the other over the cell's length: h = (v0 + v1) t - (a1 - a0) t²/3 with t half the time.
JerkProfile::Pair JerkProfile::pair_of(std::size_t i) const {
  const State from = state(i);
  const State to = state(i + 1);
  const double h = cells_[i].length;
  const double sum = from.speed + to.speed;
  const double change = to.acceleration - from.acceleration;
  const double root = sum * sum - 4.0 / 3 * change * h;
  Pair pair;
  if (!(root > 0)) return pair;
  const double t = 2 * h / (sum + std::sqrt(root));
  pair.half = t;
  pair.first = ((to.speed - from.speed) / t - 2 * from.acceleration - change / 2) / t;
  pair.second = change / t - pair.first;
  pair.middle = {.speed = from.speed + t * (from.acceleration + t * pair.first / 2),
                 .acceleration = from.acceleration + t * pair.first};
  return pair;
}

double JerkProfile::highest(const State& from, double jerk, double time) {
  const bool turns = from.acceleration > 0 && from.acceleration + jerk * time < 0;
  return turns ? from.speed - from.acceleration * from.acceleration / (2 * jerk) : from.speed;
}

JerkProfile::Inside JerkProfile::inside(const State& from, double jerk, double time) {
  return {.state = {.speed = from.speed + time * (from.acceleration + time * jerk / 2),
                    .acceleration = from.acceleration + time * jerk},
          .way = time * (from.speed + time * (from.acceleration / 2 + time * jerk / 6))};
}

// The largest multiples of the limits.
JerkProfile::Excess JerkProfile::excess(std::size_t i) const {
  const Pair pair = pair_of(i);
  if (!(pair.half > 0) || pair.middle.speed < 0) return {2, 2};
  const State from = state(i);
  const State to = state(i + 1);
  const JerkCell& cell = cells_[i];
  // Straight pieces are rounded above the low place between them: where a jump is to stay unseen, too much.
  if (from.speed * from.speed > most_above_cap * cap_[i]) return {2, 0};
  const double top =
      std::max({to.speed, highest(from, pair.first, pair.half), highest(pair.middle, pair.second, pair.half)});
  Excess worst;
  if (cell.straight) {
    const double jerk = std::max(std::abs(pair.first), std::abs(pair.second)) / cell.jerk;
    const double acceleration =
        std::max({std::abs(from.acceleration), std::abs(to.acceleration), std::abs(pair.middle.acceleration)}) /
        cell.acceleration;
    return {std::max(acceleration, top / std::sqrt(cell.top_squared)), jerk};
  }
  const AxisShape* shape = shapes(i);
  // The middle of the cell's time, and of its halves.
  const Inside middle = inside(from, pair.first, pair.half);
  const Inside early = inside(from, pair.first, pair.half / 2);
  Inside late = inside(pair.middle, pair.second, pair.half / 2);
  late.way += middle.way;
  worst.force = top * top / cell.top_squared;
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const auto see = [&](double first, double second, double third_here, const State& at, double jerk) {
      const double v = at.speed;
      const double force = std::abs(first * at.acceleration + second * v * v) / (axes_[k].acceleration * looked_at);
      const double jolt = std::abs(first * jerk + 3 * second * v * at.acceleration + third_here * v * v * v) /
                          (axes_[k].jerk * looked_at);
      worst.force = std::max(worst.force, force);
      worst.jolt = std::max(worst.jolt, jolt);
    };
    const auto see_inside = [&](const Inside& place, double jerk) {
      const double share = place.way / cell.length;
      const double third = shape->third_in + share * (shape->third_out - shape->third_in);
      const double bend = shape->bend_in + share * (shape->bend_out - shape->bend_in);
      const double slope = shape->slope_in + share * (shape->slope_out - shape->slope_in) -
                           cell.length * cell.length * share * (1 - share) / 2 * third;
      see(slope, bend, third, place.state, jerk);
    };
    see(shape->slope_in, shape->bend_in, shape->third_in, from, pair.first);
    see_inside(early, pair.first);
    see_inside(middle, pair.first);
    see_inside(middle, pair.second);
    see_inside(late, pair.second);
    see(shape->slope_out, shape->bend_out, shape->third_out, to, pair.second);
  }
  return worst;
}

// Around every place beyond its limits: less jerk is planned with, then less speed; wider and more the longer it takes.
bool JerkProfile::lower_where_exceeded(int round) {
  const std::size_t n = cells_.size();
  exceeded_.clear();
  const auto reach = static_cast<std::size_t>(round / 5);
  const double most = round < 8 ? 0.8 : round < 16 ? 0.6 : 0.3;
  const double least = round < 4 ? 0.98 : round < 8 ? 0.95 : 0.9;
  for (std::size_t i = 0; i < n; ++i) {
    if (round > 0 && checked_.size() == x_.size() && is_as_checked(i)) continue;
    const Excess worst = excess(i);
    if (worst.force <= accepted && worst.jolt <= accepted) continue;
    exceeded_.push_back(i);
    if (!(pair_of(i).half > 0)) flatten(i);
    const double slower = std::clamp(1 / std::max(worst.force, std::cbrt(worst.jolt * worst.jolt)), most, least);
    const double gentler = std::clamp(1 / worst.jolt, most, least);
    const std::size_t from = i > reach ? i - reach : 0;
    const std::size_t to = std::min(i + 1 + reach, n);
    changed_.from = std::min(changed_.from, from);
    changed_.to = std::max(changed_.to, std::max(to, i + 1));
    for (std::size_t k = from; k <= to; ++k) {
      if (worst.jolt > accepted) share_[k] = std::max(share_[k] * gentler, least_share);
      if (worst.force > accepted || round % 4 == 3) cap_[k] = std::min(cap_[k], x_[k] * slower);
    }
  }
  checked_.assign(x_.begin(), x_.end());
  for (const std::size_t i : exceeded_) checked_[i] = -1;
  return !exceeded_.empty();
}

// Too much change within one cell, at whatever speed.
void JerkProfile::flatten(std::size_t i) {
  const double most = most_growth * std::min(x_[i], x_[i + 1]);
  cap_[i] = std::min(cap_[i], most);
  cap_[i + 1] = std::min(cap_[i + 1], most);
}

// A cell's phases follow from four nodes.
bool JerkProfile::is_as_checked(std::size_t i) const {
  const std::size_t from = i > 0 ? i - 1 : 0;
  const std::size_t to = std::min(i + 2, cells_.size());
  for (std::size_t k = from; k <= to; ++k) {
    if (x_[k] != checked_[k]) return false;
  }
  return true;
}

void JerkProfile::add_phases(std::size_t i, PlannedMove& move) const {
  const Pair pair = pair_of(i);
  const State from = state(i);
  const JerkCell& cell = cells_[i];
  const double change = std::max(std::abs(pair.first), std::abs(pair.second)) * pair.half;
  if (change <= unseen_change * std::min(cell.acceleration, weak) && from.speed > 0 && x_[i + 1] > 0) {
    add_steady(cell, from, state(i + 1).speed, move);
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

// Without jerk; what goes on as the phase before did makes that longer.
void JerkProfile::add_steady(const JerkCell& cell, const State& from, double exit, PlannedMove& move) const {
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
