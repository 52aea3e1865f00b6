#include "axis_ramp.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr int steps_to_top_speed = 4000;
constexpr int entries = 4096;  // of the table from ways to steps

}  // namespace

AxisRamp::AxisRamp(const ProvenAxis& axis, const SpeedLimit& limit) : strongest_(limit.at(0)) {
  if (!limit.falls()) return;
  width_ = axis.velocity.value() / steps_to_top_speed;
  for (int i = 0; i < steps_to_top_speed; ++i) {
    Step step{.speed = i * width_, .strength = limit.at(i * width_)};
    if (i > 0) {
      const Step& before = steps_.back();
      step.way = before.way + (step.speed + before.speed) / 2 * width_ / before.strength;
      step.time = before.time + width_ / before.strength;
    }
    steps_.push_back(step);
  }
  // From rest the speed grows about as the root of the way.
  std::size_t i = 0;
  for (int k = 0; k <= entries; ++k) {
    const double way = squared(static_cast<double>(k) / entries) * steps_.back().way;
    while (i + 1 < steps_.size() && steps_[i + 1].way <= way) ++i;
    first_steps_.push_back(static_cast<std::uint32_t>(i > 0 ? i - 1 : 0));
  }
}

const AxisRamp::Step& AxisRamp::step_at(double speed) const {
  const double number = std::min(speed / width_, static_cast<double>(steps_.size() - 1));
  return steps_[static_cast<std::size_t>(number)];
}
double AxisRamp::way_to(double speed) const {
  const Step& step = step_at(speed);
  return step.way + (speed - step.speed) * (speed + step.speed) / (2 * step.strength);
}
double AxisRamp::time_to(double speed) const {
  const Step& step = step_at(speed);
  return step.time + (speed - step.speed) / step.strength;
}
double AxisRamp::speed_after(double way) const {
  const double share = std::sqrt(std::max(way, 0.0) / steps_.back().way);
  std::size_t i = first_steps_[static_cast<std::size_t>(std::min(share, 1.0) * entries)];
  while (i + 1 < steps_.size() && steps_[i + 1].way <= way) ++i;
  const Step& step = steps_[i];
  return std::sqrt(step.speed * step.speed + 2 * step.strength * std::max(way - step.way, 0.0));
}

double AxisRamp::square_after(double square, double way) const {
  if (steps_.empty()) return square + 2 * strongest_ * way;
  const double speed = speed_after(way_to(std::sqrt(square)) + way);
  return speed * speed;
}

// Speeds up from the start, goes on at the top speed, brakes to the end. An end that cannot be reached from the other
// end is not reached.
double AxisRamp::least_time(Squares squares, double way) const {
  if (!(way > 0)) return 0;
  squares.start = std::min({squares.start, squares.top, square_after(squares.end, way)});
  squares.end = std::min({squares.end, squares.top, square_after(squares.start, way)});
  const double start = std::sqrt(squares.start);
  const double end = std::sqrt(squares.end);
  const double top = std::sqrt(squares.top);
  if (steps_.empty()) {
    const double peak = std::min(top, std::sqrt((squares.start + squares.end) / 2 + strongest_ * way));
    const double rise = (peak - start) * (peak + start) / (2 * strongest_);
    const double fall = (peak - end) * (peak + end) / (2 * strongest_);
    // Ways divided by mean speeds: a small change of a high speed loses no digits.
    return 2 * rise / (peak + start) + 2 * fall / (peak + end) + (way - rise - fall) / peak;
  }
  const double of_ends = way_to(start) + way_to(end);
  const double peak = std::min(top, speed_after((of_ends + way) / 2));
  const double ramps = 2 * way_to(peak) - of_ends;
  return 2 * time_to(peak) - time_to(start) - time_to(end) + (way - ramps) / peak;
}

}  // namespace passo::proof
