#include "relaxation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passo {
namespace {

// Steps shorter than this (mm) are not made.
constexpr double no_step = 1e-12;

}  // namespace

void Relaxation::begin() {
  base_ = -1;
}

void Relaxation::make_room(std::int64_t k, std::int64_t oldest) {
  if (slot(k) < capacity) return;
  const std::size_t shift = slot(oldest);
  assert(oldest > base_);
  const auto move_down = [&](auto& lanes) { std::shift_left(lanes.begin(), lanes.end(), static_cast<long>(shift)); };
  for (AxisLanes& axis : axes_) {
    for (Lanes* const lanes : {&axis.control, &axis.off, &axis.bend, &axis.middle}) move_down(*lanes);
  }
  move_down(reach_);
  move_down(middle_reach_);
  move_down(factors_);
  base_ = oldest;
}

Point Relaxation::gather(Lanes AxisLanes::*lanes, std::int64_t k) const {
  Point point;
  for (std::size_t i = 0; i < axis_count; ++i) point.values[i] = (axes_[i].*lanes)[slot(k)];
  return point;
}

void Relaxation::scatter(Lanes AxisLanes::*lanes, std::int64_t k, const Point& value) {
  for (std::size_t i = 0; i < axis_count; ++i) (axes_[i].*lanes)[slot(k)] = value.values[i];
}

template <std::size_t axes>
void Relaxation::move(std::size_t at, const std::array<double, axes>& step) {
  const Factors& factors = factors_[at];
  const auto off_factors = FourLanes::load(factors.off.data());
  const auto bend_factors = FourLanes::load(factors.bend.data());
  const auto middle_factors = FourLanes::load(factors.middle.data());
  const auto add = [](double* to, FourLanes change) { (FourLanes::load(to) + change).store(to); };
  for (std::size_t i = 0; i < axes; ++i) {
    AxisLanes& axis = axes_[i];
    axis.control[at] += step[i];
    add(&axis.off[at - 1], off_factors * step[i]);
    add(&axis.bend[at - 1], bend_factors * step[i]);
    add(&axis.middle[at - 2], middle_factors * step[i]);
  }
}

void Relaxation::move(std::int64_t k, const Point& step) {
  move<axis_count>(slot(k), step.values);
}

// The largest allowed share of the step. After the step no place is farther off than its reach, or than it was before.
// Usually the whole step is allowed. That is found for four places at once.
template <std::size_t axes>
Relaxation::Stop Relaxation::stop_of(std::size_t at, const std::array<double, axes>& step, double square) const {
  FourLanes off;  // squares of the deviations
  FourLanes along;
  FourLanes middle;
  FourLanes middle_along;
  for (std::size_t i = 0; i < axes; ++i) {
    const auto here = FourLanes::load(&axes_[i].off[at - 1]);
    const auto between = FourLanes::load(&axes_[i].middle[at - 2]);
    off = off + here * here;
    along = along + here * step[i];
    middle = middle + between * between;
    middle_along = middle_along + between * step[i];
  }
  const Factors& factors = factors_[at];
  const auto moved = [&](FourLanes now, FourLanes toward, const Four& by) {
    const auto factor = FourLanes::load(by.data());
    return now + factor * (toward * 2 + factor * square);
  };
  const auto reach = FourLanes::load(&reach_[at - 1]);
  const auto middle_reach = FourLanes::load(&middle_reach_[at - 2]);
  const bool beyond = any_above(moved(off, along, factors.off), off, reach);
  const bool middle_beyond = any_above(moved(middle, middle_along, factors.middle), middle, middle_reach);
  Stop stop;
  if (beyond) shorten(stop, &AxisLanes::off, at - 1, square, factors.off, off, along, reach);
  if (middle_beyond) {
    shorten(stop, &AxisLanes::middle, at - 2, square, factors.middle, middle, middle_along, middle_reach);
  }
  return stop;
}

// Shortens the share of a step so that |off + share factor step|² is at most the square of the reach, or does not grow
// if it is above that.
void Relaxation::shorten(Stop& stop, Lanes AxisLanes::*lanes, std::size_t first, double square, const Four& factors,
                         FourLanes off, FourLanes along, FourLanes reach) {
  Four now{};
  Four toward{};
  Four most{};
  off.store(now.data());
  along.store(toward.data());
  reach.store(most.data());
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const double a = factors[lane] * factors[lane] * square;
    const double b = factors[lane] * toward[lane];
    const double room = std::max(most[lane] - now[lane], 0.0);
    if (stop.share * (2 * b + stop.share * a) <= room) continue;
    stop = {.share = std::max(0.0, (std::sqrt(b * b + a * room) - b) / a),
            .factor = factors[lane],
            .off = lanes,
            .place = first + lane,
            .reach = std::max(most[lane], now[lane])};
  }
}

// A step that the tube stops goes to the place on the tube that is nearest to its end. So the control slides along the
// tube and does not stick to it. False: as much of the straight step as is allowed comes nearer to the end.
template <std::size_t axes>
bool Relaxation::slide(std::size_t at, const std::array<double, axes>& step, double square, const Stop& stop) {
  constexpr double just_inside = 1 - 1e-12;
  const auto off = [&](std::size_t i) { return (axes_[i].*stop.off)[stop.place]; };
  double beyond = 0;
  for (std::size_t i = 0; i < axes; ++i) beyond += (off(i) + stop.factor * step[i]) * (off(i) + stop.factor * step[i]);
  const double onto_tube = just_inside * std::sqrt(stop.reach / beyond);
  std::array<double, axes> aside;
  double aside_square = 0;
  double common = 0;
  for (std::size_t i = 0; i < axes; ++i) {
    aside[i] = ((off(i) + stop.factor * step[i]) * onto_tube - off(i)) / stop.factor;
    aside_square += aside[i] * aside[i];
    common += aside[i] * step[i];
  }
  if (aside_square < no_step * no_step) return false;
  const double share = stop_of<axes>(at, aside, aside_square).share;
  const double gain = share * (2 * common - share * aside_square);
  if (gain <= stop.share * (2 - stop.share) * square) return false;
  for (double& value : aside) value *= share;
  move<axes>(at, aside);
  return true;
}

// Makes as much of the step as is allowed.
template <std::size_t axes>
void Relaxation::take_step(std::size_t at, std::array<double, axes>& step, bool slides) {
  double square = 0;
  for (const double value : step) square += value * value;
  if (square < no_step * no_step) return;
  const Stop stop = stop_of<axes>(at, step, square);
  if (stop.share < 1) {
    if (slides && slide<axes>(at, step, square, stop)) return;
    if (stop.share == 0) return;
    for (double& value : step) value *= stop.share;
  }
  move<axes>(at, step);
}

// Flattened, so that a step and its factors stay in registers from one part of the work to the next.
template <std::size_t axes>
[[gnu::flatten]] void Relaxation::relax_bending(std::int64_t k) {
  const std::size_t at = slot(k);
  const Four& pull = factors_[at].pull;
  std::array<double, axes> step;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 1];
    step[i] = -(pull[0] * bend[0] + pull[1] * bend[1] + pull[2] * bend[2]);
  }
  take_step<axes>(at, step, false);
}

// A step of Newton's method, for each axis.
template <std::size_t axes, Relaxation::Power power>
[[gnu::flatten]] void Relaxation::relax_highest_bending(std::int64_t k) {
  constexpr double steepness = power == Power::fourth ? 3 : 7;  // of the derivative of the power
  const std::size_t at = slot(k);
  const Factors& factors = factors_[at];
  std::array<double, axes> step;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 1];
    double slope = 0;
    double change = 0;
    for (std::size_t knot = 0; knot < 3; ++knot) {
      const double square = bend[knot] * bend[knot];
      const double weight = factors.pull[knot] * (power == Power::fourth ? square : square * square * square);
      slope += weight * bend[knot];
      change += weight * factors.bend[knot];
    }
    step[i] = change > 0 ? -slope / (steepness * change) : 0;
  }
  take_step<axes>(at, step, false);
}

double Relaxation::square_of_change(std::int64_t k) const {
  const std::size_t at = slot(k);
  double sum = 0;
  for (const AxisLanes& axis : axes_) sum += (axis.bend[at + 1] - axis.bend[at]) * (axis.bend[at + 1] - axis.bend[at]);
  return sum;
}

// A step of Newton's method, for each axis.
template <std::size_t axes, Relaxation::Power power>
[[gnu::flatten]] void Relaxation::relax_highest_change(std::int64_t k, const Four& weights, bool slides) {
  constexpr double steepness = power == Power::fourth ? 3 : 7;  // of the derivative of the power
  const std::size_t at = slot(k);
  const Four& effect = factors_[at].bend;
  const Four effects = {effect[0], effect[1] - effect[0], effect[2] - effect[1], -effect[2]};
  std::array<double, axes> step;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 2];
    double slope = 0;
    double change = 0;
    for (std::size_t span = 0; span < 4; ++span) {
      const double here = bend[span + 1] - bend[span];
      const double square = here * here;
      const double weight =
          weights[span] * effects[span] * (power == Power::fourth ? square : square * square * square);
      slope += weight * here;
      change += weight * effects[span];
    }
    step[i] = change > 0 ? -slope / (steepness * change) : 0;
  }
  take_step<axes>(at, step, slides);
}

template <std::size_t axes>
[[gnu::flatten]] void Relaxation::relax_change(std::int64_t k, bool slides) {
  const std::size_t at = slot(k);
  const std::array<double, 5>& pull = factors_[at].change_pull;
  std::array<double, axes> step;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 2];
    step[i] = -(pull[0] * bend[0] + pull[1] * bend[1] + pull[2] * bend[2] + pull[3] * bend[3] + pull[4] * bend[4]);
  }
  take_step<axes>(at, step, slides);
}

template void Relaxation::relax_bending<3>(std::int64_t k);
template void Relaxation::relax_bending<axis_count>(std::int64_t k);
template void Relaxation::relax_highest_bending<3, Relaxation::Power::fourth>(std::int64_t k);
template void Relaxation::relax_highest_bending<3, Relaxation::Power::eighth>(std::int64_t k);
template void Relaxation::relax_highest_bending<axis_count, Relaxation::Power::fourth>(std::int64_t k);
template void Relaxation::relax_highest_bending<axis_count, Relaxation::Power::eighth>(std::int64_t k);
template void Relaxation::relax_highest_change<3, Relaxation::Power::fourth>(std::int64_t k, const Four& weights,
                                                                             bool slides);
template void Relaxation::relax_highest_change<3, Relaxation::Power::eighth>(std::int64_t k, const Four& weights,
                                                                             bool slides);
template void Relaxation::relax_highest_change<axis_count, Relaxation::Power::fourth>(std::int64_t k,
                                                                                      const Four& weights, bool slides);
template void Relaxation::relax_highest_change<axis_count, Relaxation::Power::eighth>(std::int64_t k,
                                                                                      const Four& weights, bool slides);
template void Relaxation::relax_change<3>(std::int64_t k, bool slides);
template void Relaxation::relax_change<axis_count>(std::int64_t k, bool slides);

}  // namespace passo
