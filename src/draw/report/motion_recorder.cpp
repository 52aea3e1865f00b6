#include <algorithm>
#include <cmath>

#include "passo/report/motion_picture.hpp"

namespace passo {
namespace {

constexpr int samples_of_a_phase = 12;
constexpr int pieces_of_a_curve = 64;
constexpr double beyond_any_speed = 1e9;

double size_of(const Point& point) {
  double sum = 0;
  for (const double value : point.values) sum += value * value;
  return std::sqrt(sum);
}

}  // namespace

void MotionRecorder::watch(const PathItem& item) {
  const auto* const segment = std::get_if<Segment>(&item);
  if (segment == nullptr || programmed_.size() >= most_samples) return;
  const Curve& curve = segment->curve;
  const int count = curve.shape() == Curve::Shape::line ? 1 : pieces_of_a_curve;
  for (int i = 0; i < count; ++i) {
    programmed_.push_back({.from = curve.at(curve.length() * i / count),
                           .to = curve.at(curve.length() * (i + 1) / count),
                           .tolerance = segment->tolerance.value()});
  }
}

void MotionRecorder::watch(const MotionItem& item) {
  if (const auto* const action = std::get_if<Action>(&item)) {
    time_ += action->dwell.value();
    return;
  }
  const auto& move = std::get<PlannedMove>(item);
  for (const Phase& phase : move) add(move, phase);
}

void MotionRecorder::add(const PlannedMove& move, const Phase& phase) {
  const Curve& curve = move.segment.curve;
  if (samples_.size() < most_samples) {
    for (int i = 0; i <= samples_of_a_phase; ++i) {
      const Seconds t = phase.duration * i / samples_of_a_phase;
      const Mm s = std::clamp(phase.position_at(t), Mm(0), curve.length());
      const double v = phase.velocity_at(t).value();
      const double a = phase.acceleration.value() + phase.jerk.value() * t.value();
      const Point slope = curve.tangent(s);
      const Point bend = curve.second_derivative(s);
      const Point place = curve.at(s);
      if (!samples_.empty()) way_ += size_of(place - samples_.back().place);
      // In a smoothed corner s is no length.
      const double steepness = size_of(slope);
      MotionSample sample{.time = time_ + t.value(),
                          .way = way_,
                          .speed = v * steepness,
                          .cap = cap_at(move.segment, slope, bend) * steepness,
                          .place = place,
                          .acceleration = slope * a + bend * (v * v),
                          .jerk = {},
                          .begins_phase = i == 0};
      sample.jerk = slope * phase.jerk.value() + bend * (3 * v * a) + curve.third_derivative(s) * (v * v * v);
      samples_.push_back(sample);
    }
  }
  time_ += phase.duration.value();
}

// By the feed, the velocities, and each pair of axes (docs/motion-proof.md, "The least time").
double MotionRecorder::cap_at(const Segment& segment, const Point& slope, const Point& bend) const {
  double cap = std::min(segment.speed.value(), beyond_any_speed);
  for (const Axis i : all_axes) {
    const double velocity = limits_.velocity[i].value();
    if (velocity > 0 && slope[i] != 0) cap = std::min(cap, velocity / std::abs(slope[i]));
    for (const Axis j : all_axes) {
      const double first = limits_.acceleration[i].value();
      const double second = limits_.acceleration[j].value();
      const double turn = std::abs(bend[i] * slope[j] - bend[j] * slope[i]);
      if (!(first > 0 && second > 0 && turn > 0)) continue;
      cap = std::min(cap, std::sqrt((first * std::abs(slope[j]) + second * std::abs(slope[i])) / turn));
    }
  }
  return cap;
}

}  // namespace passo
