#include "axis_ramp.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr std::size_t steps_to_top_speed = 4096;

}  // namespace

AxisRamp::AxisRamp(const ProvenAxis& axis, const SpeedLimit& limit) : strongest_(limit.at(0)) {
  if (!limit.falls()) return;
  width_ = squared(axis.velocity.value()) / steps_to_top_speed;
  per_width_ = 1 / width_;
  for (std::size_t i = 0; i < steps_to_top_speed; ++i) {
    Step step{.speed = std::sqrt(square_of(i))};
    step.strength = limit.at(step.speed);
    if (i > 0) {
      const Step& before = steps_.back();
      step.way = before.way + width_ / (2 * before.strength);
      step.time = before.time + (step.speed - before.speed) / before.strength;
    }
    steps_.push_back(step);
  }
  fill_reaches();
}

std::size_t AxisRamp::step_at(double square) const {
  return static_cast<std::size_t>(std::min(square * per_width_, static_cast<double>(steps_.size() - 1)));
}
// `from`: a step that is not beyond it. With the strength of that step, which only falls, the way would end no earlier.
std::size_t AxisRamp::step_at_way(double way, std::size_t from) const {
  const double rise = std::max(way - steps_[from].way, 0.0) * 2 * steps_[from].strength * per_width_;
  const double last = std::min(static_cast<double>(from) + rise + 1, static_cast<double>(steps_.size() - 1));
  std::size_t low = from;
  std::size_t high = static_cast<std::size_t>(last) + 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (steps_[middle].way <= way ? low : high) = middle;
  }
  return low;
}
double AxisRamp::way_to(std::size_t step, double square) const {
  return steps_[step].way + (square - square_of(step)) / (2 * steps_[step].strength);
}
double AxisRamp::square_at_way(std::size_t step, double way) const {
  return square_of(step) + 2 * steps_[step].strength * (way - steps_[step].way);
}
double AxisRamp::time_to(std::size_t step, double speed) const {
  return steps_[step].time + (speed - steps_[step].speed) / steps_[step].strength;
}

double AxisRamp::square_over_steps(double square, double way) const {
  const std::size_t step = step_at(square);
  const double whole = way_to(step, square) + way;
  return square_at_way(step_at_way(whole, step), whole);
}

bool AxisRamp::comes_from_rest(double way, double time) const {
  if (!(way > 0)) return true;
  if (steps_.empty()) return squared(time) * strongest_ >= 2 * way;
  // Mostly the nearest times of the table say it.
  const double place = time * reaches_per_time_;
  if (place < static_cast<double>(reaches_.size() - 1)) {
    const auto below = static_cast<std::size_t>(place);
    if (way <= reaches_[below]) return true;
    if (way > reaches_[below + 1]) return false;
  }
  const std::size_t step = step_at_way(way, 0);
  return time >= time_to(step, std::sqrt(square_at_way(step, way)));
}

void AxisRamp::fill_reaches() {
  constexpr std::size_t entries = 1024;
  reaches_per_time_ = static_cast<double>(entries) / steps_.back().time;
  std::size_t step = 0;
  for (std::size_t i = 0; i <= entries; ++i) {
    const double time = static_cast<double>(i) / reaches_per_time_;
    while (step + 1 < steps_.size() && steps_[step + 1].time <= time) ++step;
    const double speed = steps_[step].speed + steps_[step].strength * (time - steps_[step].time);
    reaches_.push_back(way_to(step, squared(speed)));
  }
}

// Speeds up from the start, goes on at the top speed, brakes to the end. An end that cannot be reached from the other
// end is not reached.
double AxisRamp::least_time_by(double acceleration, Squares squares, double way) {
  if (!(way > 0)) return 0;
  const double change = 2 * acceleration * way;
  squares.start = std::min({squares.start, squares.top, squares.end + change});
  squares.end = std::min({squares.end, squares.top, squares.start + change});
  const double peak_square = std::min(squares.top, (squares.start + squares.end + change) / 2);
  const double peak = std::sqrt(peak_square);
  if (squares.start == peak_square && squares.end == peak_square) return way / peak;
  const double start = std::sqrt(squares.start);
  const double end = std::sqrt(squares.end);
  const double up = peak - start;
  const double down = peak - end;
  const double ramps = (up * (peak + start) + down * (peak + end)) / (2 * acceleration);
  return (up + down) / acceleration + (way - ramps) / peak;
}

double AxisRamp::least_time(Squares squares, double way) const {
  return steps_.empty() ? least_time_by(strongest_, squares, way) : least_time_over_steps(squares, way);
}

double AxisRamp::least_time_over_steps(Squares squares, double way) const {
  if (!(way > 0)) return 0;
  squares.start = std::min(squares.start, squares.top);
  squares.end = std::min(squares.end, squares.top);
  // The slower end is reached, and may be too slow for the other one.
  double& slow = squares.start < squares.end ? squares.start : squares.end;
  double& fast = squares.start < squares.end ? squares.end : squares.start;
  if (slow == fast && slow == squares.top) return way / std::sqrt(slow);
  const std::size_t slow_step = step_at(slow);
  const double slow_way = way_to(slow_step, slow);
  std::size_t fast_step = step_at(fast);
  double fast_way = way_to(fast_step, fast);
  if (fast_way > slow_way + way) {
    fast_way = slow_way + way;
    fast_step = step_at_way(fast_way, slow_step);
    fast = square_at_way(fast_step, fast_way);
  }
  double peak_way = (slow_way + fast_way + way) / 2;
  std::size_t peak_step = step_at_way(peak_way, fast_step);
  double peak_square = square_at_way(peak_step, peak_way);
  if (peak_square > squares.top) {
    peak_square = squares.top;
    peak_step = step_at(peak_square);
    peak_way = way_to(peak_step, peak_square);
  }
  const double peak = std::sqrt(peak_square);
  const double ramps = 2 * peak_way - slow_way - fast_way;
  const double time_of_ramps =
      2 * time_to(peak_step, peak) - time_to(slow_step, std::sqrt(slow)) - time_to(fast_step, std::sqrt(fast));
  return time_of_ramps + (way - ramps) / peak;
}

}  // namespace passo::proof
