#include "relaxation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passo {
namespace {

// Steps shorter than this (mm) are none.
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
  for (std::size_t i = 0; i < axes; ++i) {
    const double d = step[i];
    double* const off = &axes_[i].off[at - 1];
    double* const bend = &axes_[i].bend[at - 1];
    double* const middle = &axes_[i].middle[at - 2];
    axes_[i].control[at] += d;
    for (std::size_t lane = 0; lane < 4; ++lane) off[lane] += factors.off[lane] * d;
    for (std::size_t lane = 0; lane < 4; ++lane) bend[lane] += factors.bend[lane] * d;
    for (std::size_t lane = 0; lane < 4; ++lane) middle[lane] += factors.middle[lane] * d;
  }
}

void Relaxation::move(std::int64_t k, const Point& step) {
  move<axis_count>(slot(k), step.values);
}

// The longest share of the step that leaves no place farther off than it may be, or than it is.
template <std::size_t axes>
double Relaxation::allowed_share(std::size_t at, const std::array<double, axes>& step, double square) const {
  const Factors& factors = factors_[at];
  Four now{};  // squares of the deviations
  Four along{};
  Four middle_now{};
  Four middle_along{};
  for (std::size_t i = 0; i < axes; ++i) {
    const double d = step[i];
    const double* const off = &axes_[i].off[at - 1];
    const double* const middle = &axes_[i].middle[at - 2];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      now[lane] += off[lane] * off[lane];
      along[lane] += off[lane] * d;
      middle_now[lane] += middle[lane] * middle[lane];
      middle_along[lane] += middle[lane] * d;
    }
  }
  double share = 1;
  const auto shorten = [&](double factor, double off, double off_along, double reach) {
    const double a = factor * factor * square;
    const double b = factor * off_along;
    const double most = std::max(reach, off);
    if (off + share * (2 * b + share * a) <= most) return;
    share = std::max(0.0, (std::sqrt(std::max(b * b + a * (most - off), 0.0)) - b) / a);
  };
  // Mostly all of the step is allowed, which is found for four places at once.
  int beyond = 0;
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const double factor = factors.off[lane];
    const double then = now[lane] + factor * (2 * along[lane] + factor * square);
    beyond |= then > std::max(reach_[at - 1 + lane], now[lane]) ? 1 : 0;
    const double middle_factor = factors.middle[lane];
    const double middle_then = middle_now[lane] + middle_factor * (2 * middle_along[lane] + middle_factor * square);
    beyond |= middle_then > std::max(middle_reach_[at - 2 + lane], middle_now[lane]) ? 1 : 0;
  }
  if (beyond == 0) return share;
  for (std::size_t lane = 0; lane < 3; ++lane) {
    shorten(factors.off[lane], now[lane], along[lane], reach_[at - 1 + lane]);
  }
  for (std::size_t lane = 0; lane < 4; ++lane) {
    shorten(factors.middle[lane], middle_now[lane], middle_along[lane], middle_reach_[at - 2 + lane]);
  }
  return share;
}

template <std::size_t axes>
void Relaxation::relax(std::int64_t k) {
  const std::size_t at = slot(k);
  const Four& pull = factors_[at].pull;
  std::array<double, axes> step;
  double square = 0;
  for (std::size_t i = 0; i < axes; ++i) {
    const double* const bend = &axes_[i].bend[at - 1];
    step[i] = -(pull[0] * bend[0] + pull[1] * bend[1] + pull[2] * bend[2]);
    square += step[i] * step[i];
  }
  if (square < no_step * no_step) return;
  const double share = allowed_share<axes>(at, step, square);
  if (share == 0) return;
  for (double& value : step) value *= share;
  move<axes>(at, step);
}

template void Relaxation::relax<3>(std::int64_t k);
template void Relaxation::relax<axis_count>(std::int64_t k);

}  // namespace passo
