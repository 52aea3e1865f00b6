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
double Relaxation::allowed_share(std::size_t at, const std::array<double, axes>& step, double square) const {
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
  double share = 1;
  if (beyond) share = shorten(share, square, factors.off, off, along, reach);
  if (middle_beyond) share = shorten(share, square, factors.middle, middle, middle_along, middle_reach);
  return share;
}

// Shortens the share of a step so that |off + share factor step|² is at most the square of the reach, or does not grow
// if it is above that.
double Relaxation::shorten(double share, double square, const Four& factors, FourLanes off, FourLanes along,
                           FourLanes reach) {
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
    if (share * (2 * b + share * a) <= room) continue;
    share = std::max(0.0, (std::sqrt(b * b + a * room) - b) / a);
  }
  return share;
}

// Makes as much of the step as is allowed.
template <std::size_t axes>
void Relaxation::take_step(std::size_t at, std::array<double, axes>& step) {
  double square = 0;
  for (const double value : step) square += value * value;
  if (square < no_step * no_step) return;
  const double share = allowed_share<axes>(at, step, square);
  if (share == 0) return;
  if (share < 1) {
    for (double& value : step) value *= share;
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
  take_step<axes>(at, step);
}

template <std::size_t axes>
[[gnu::flatten]] void Relaxation::relax_change(std::int64_t k) {
  const std::size_t at = slot(k);
  const std::array<double, 5>& pull = factors_[at].change_pull;
  std::array<double, axes> step;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 2];
    step[i] = -(pull[0] * bend[0] + pull[1] * bend[1] + pull[2] * bend[2] + pull[3] * bend[3] + pull[4] * bend[4]);
  }
  take_step<axes>(at, step);
}

template void Relaxation::relax_bending<3>(std::int64_t k);
template void Relaxation::relax_bending<axis_count>(std::int64_t k);
template void Relaxation::relax_change<3>(std::int64_t k);
template void Relaxation::relax_change<axis_count>(std::int64_t k);

}  // namespace passo
