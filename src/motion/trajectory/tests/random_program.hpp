// Random paths for the planner's tests: corners and smooth runs, tiny and long moves, arcs of all kinds, actions.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "kit/stage_test.hpp"

#include "passo/trajectory/planner.hpp"

namespace passo::test {

inline MotionLimits random_limits(Random& random) {
  MotionLimits limits;
  for (const Axis axis : all_axes) {
    limits.velocity[axis] = MmPerSecond(std::exp(random.between(2, 7)));
    limits.acceleration[axis] = MmPerSecond2(std::exp(random.between(4, 8)));
  }
  return limits;
}

class RandomProgram {
 public:
  explicit RandomProgram(Random& random) : random_(random) {}

  std::vector<PathItem> draw(std::size_t count) {
    while (items_.size() < count) {
      const double kind = random_.between(0, 1);
      if (kind < 0.03) {
        items_.emplace_back(Action{.kind = Action::Kind::dwell, .source = {.line = next_line()}});
      } else if (kind < 0.1) {
        straight_run();
      } else if (kind < 0.2) {
        smooth_run();
      } else if (kind < 0.45) {
        arc();
      } else {
        corner();
      }
    }
    return items_;
  }

 private:
  std::uint32_t next_line() { return static_cast<std::uint32_t>(items_.size() + 1); }
  double sign() { return random_.chance(0.5) ? 1 : -1; }
  double any_size() { return std::exp(random_.between(-9, 5)); }

  void add(const Curve& curve) {
    if (!curve.has_length()) return;
    const double kind = random_.between(0, 1);
    const bool rapid = random_.chance(0.1);
    Segment segment{.curve = curve,
                    .speed = MmPerSecond(rapid ? std::numeric_limits<double>::infinity() : feed_),
                    .rapid = rapid,
                    .mode = kind < 0.03  ? PathMode::exact_stop
                            : kind < 0.1 ? PathMode::exact_path
                                         : PathMode::continuous,
                    .tolerance = Mm(kind < 0.1 ? 0 : std::exp(random_.between(-7, -2))),
                    .source = {.line = next_line()}};
    items_.emplace_back(segment);
    position_ = curve.end();
    if (random_.chance(0.1)) feed_ = std::exp(random_.between(-1, 6));
  }

  void line_to(const Point& end) { add(Curve::line(position_, end)); }

  void corner() {
    Point end = position_;
    const double size = any_size();
    const double group = random_.between(0, 1);
    for (const Axis axis : all_axes) {
      const bool linear = axis <= Axis::z;
      const bool moves = group < 0.7 ? linear : group < 0.8 ? is_rotary(axis) : random_.chance(0.5);
      if (moves && random_.chance(0.7)) end[axis] += size * random_.between(-1, 1);
    }
    line_to(end);
  }

  void straight_run() {
    const Point step = xyz(random_.between(-1, 1), random_.between(-1, 1), random_.between(-0.1, 0.1)) * any_size();
    const int pieces = static_cast<int>(random_.between(2, 200));
    for (int i = 0; i < pieces; ++i) line_to(position_ + step);
  }

  void smooth_run() {
    double direction = random_.between(0, 6.28);
    const double size = std::exp(random_.between(-7, 0));
    const double bend = random_.between(-0.1, 0.1);
    const int pieces = static_cast<int>(random_.between(2, 300));
    for (int i = 0; i < pieces; ++i) {
      direction += bend + random_.between(-0.01, 0.01);
      line_to(position_ + xyz(size * std::cos(direction), size * std::sin(direction)));
    }
  }

  void arc() {
    static constexpr std::array<std::array<Axis, 3>, 3> planes = {
        {{Axis::x, Axis::y, Axis::z}, {Axis::z, Axis::x, Axis::y}, {Axis::y, Axis::z, Axis::x}}};
    const auto& [first, second, through] = planes[static_cast<std::size_t>(random_.between(0, 2.999))];
    const double radius = std::exp(random_.between(-5, 4));
    const double start = random_.between(-3.14, 3.14);
    const double sweep = sign() * (random_.chance(0.8) ? random_.between(0.01, 6.28) : random_.between(6.28, 30));
    const double growth = random_.chance(0.3) ? random_.between(-0.05, 0.05) * std::min(1.0, std::abs(sweep)) : 0;
    const double first_center = position_[first] - radius * std::cos(start);
    const double second_center = position_[second] - radius * std::sin(start);
    Point end = position_;
    end[first] = first_center + radius * (1 + growth) * std::cos(start + sweep);
    end[second] = second_center + radius * (1 + growth) * std::sin(start + sweep);
    if (random_.chance(0.4)) end[through] += any_size() * sign();
    if (random_.chance(0.2)) end[Axis::a] += any_size() * sign();
    add(Curve::arc(position_, end, first, second, first_center, second_center, sweep));
  }

  Random& random_;
  std::vector<PathItem> items_;
  Point position_;
  double feed_ = 30;
};

}  // namespace passo::test
