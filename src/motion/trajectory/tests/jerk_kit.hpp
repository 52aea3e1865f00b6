// Shared by the tests of planning with jerk limits: programs, and an oracle with independent formulas.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "kit/motion_text.hpp"
#include "planner_kit.hpp"
#include "random_program.hpp"

#include "passo/trajectory/planner.hpp"

namespace passo::test {
inline MotionLimits jerk_limits(double velocity, double acceleration, double jerk) {
  MotionLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.velocity[axis] = MmPerSecond(velocity);
    limits.acceleration[axis] = MmPerSecond2(acceleration);
    limits.jerk[axis] = MmPerSecond3(jerk);
  }
  return limits;
}

// Returns a curve that is flat up to a shoulder, and then falls like a motor's torque.
inline AccelerationCurve draw_falling(Random& random, MmPerSecond velocity, MmPerSecond2 at_rest) {
  const double shoulder = velocity.value() * random.between(0.05, 0.7);
  const double power = random.between(0.3, 2);
  std::vector<AccelerationCurve::Sample> samples;
  for (int i = 0; i <= 1000; ++i) {
    const double speed = velocity.value() * i / 1000;
    samples.push_back({.speed = MmPerSecond(speed),
                       .acceleration = at_rest * (speed < shoulder ? 1 : std::pow(shoulder / speed, power))});
  }
  return AccelerationCurve::below(samples, at_rest);
}

// On some machines the acceleration limit falls with the speed.
inline MotionLimits draw_jerk_limits(Random& random) {
  MotionLimits limits = jerk_limits(1, 1, 1);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.velocity[axis] = MmPerSecond(std::exp(random.between(3, 6)));
    limits.acceleration[axis] = MmPerSecond2(std::exp(random.between(5, 8)));
    limits.jerk[axis] = MmPerSecond3(std::exp(random.between(8, 12)));
  }
  if (!random.chance(0.4)) return limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.falling[axis] = draw_falling(random, limits.velocity[axis], limits.acceleration[axis]);
  }
  return limits;
}

// Adds motors that X and Y share: one turns by their sum, the other by their difference. Their limits are lower than
// those of the axes.
inline void limit_shared_motors(Random& random, MotionLimits& limits) {
  for (const double sign : {1.0, -1.0}) {
    const double part = random.between(0.3, 1);
    limits.rows.push_back({.row = {{Axis::x, 1}, {Axis::y, sign}},
                           .velocity = limits.velocity[Axis::x] * part,
                           .acceleration = limits.acceleration[Axis::y] * part,
                           .jerk = limits.jerk[Axis::x] * part});
  }
}

// Half of the axes have no jerk limit, but at least one has.
inline MotionLimits draw_mixed_limits(Random& random) {
  MotionLimits limits = draw_jerk_limits(random);
  const Axis sure = random.chance(0.5) ? Axis::x : random.chance(0.5) ? Axis::y : Axis::z;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    if (axis != sure && random.chance(0.6)) limits.jerk[axis] = MmPerSecond3(0);
  }
  return limits;
}

inline Segment segment_of(const Curve& curve, double speed) {
  return {.curve = curve,
          .speed = MmPerSecond(speed),
          .rapid = false,
          .mode = PathMode::continuous,
          .tolerance = Mm(0.01),
          .source = {}};
}

// Position and derivatives of an axis by s, from the formulas.
struct Derivatives {
  double place = 0;
  double first = 0;
  double second = 0;
  double third = 0;
};
inline Derivatives derivatives(const Curve& curve, Axis axis, double s) {
  const double length = curve.length().value();
  const double from = curve.start()[axis];
  const double to = curve.end()[axis];
  if (curve.shape() == Curve::Shape::cubic) {
    const double a = curve.cubic_data().first[axis];
    const double b = curve.cubic_data().second[axis];
    const double c = curve.cubic_data().third[axis];
    return {from + s * (a + s * (b + s * c)), a + s * (2 * b + s * 3 * c), 2 * b + 6 * c * s, 6 * c};
  }
  if (curve.shape() == Curve::Shape::arc && (axis == curve.arc_data().first || axis == curve.arc_data().second)) {
    const Curve::ArcData& arc = curve.arc_data();
    const double turn = arc.sweep / length;
    const double growth = (arc.end_radius - arc.start_radius) / length;
    const double radius = arc.start_radius + growth * s;
    const double angle = arc.start_angle + turn * s - (axis == arc.first ? 0 : std::numbers::pi / 2);
    const double center = axis == arc.first ? arc.first_center : arc.second_center;
    const double out = std::cos(angle);
    const double on = -std::sin(angle) * turn;
    return {center + radius * out, growth * out + radius * on, 2 * growth * on - radius * turn * turn * out,
            -3 * growth * turn * turn * out - radius * turn * turn * on};
  }
  return {from + (to - from) * s / length, (to - from) / length, 0, 0};
}

struct AxisMotion {
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};
inline AxisMotion motion_at(const Curve& curve, Axis axis, const Phase& phase, double t) {
  const double j = phase.jerk.value();
  const double a = phase.acceleration.value() + j * t;
  const double v = phase.velocity.value() + t * (phase.acceleration.value() + j * t / 2);
  const double s =
      phase.start.value() + t * (phase.velocity.value() + t * (phase.acceleration.value() / 2 + j * t / 6));
  const Derivatives q = derivatives(curve, axis, s);
  return {q.first * v, q.first * a + q.second * v * v, q.first * j + 3 * q.second * v * a + q.third * v * v * v};
}

// Checks 40 points of each phase, and the transitions between phases. A copy may check another continuation.
class JerkOracle {
 public:
  explicit JerkOracle(const MotionLimits& limits) : limits_(limits) {}

  void check(const std::vector<MotionItem>& motion) {
    for (const MotionItem& item : motion) {
      watch(item);
      if (testing::Test::HasFatalFailure()) return;
    }
    rest();
  }

  void watch(const MotionItem& item) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) return rest();
    SCOPED_TRACE(passo::to_text(*move));
    ASSERT_GE(move->phase_count, 1U);
    double at = move->from().value();
    for (const Phase& phase : *move) {
      ASSERT_GT(phase.duration.value(), 0);
      ASSERT_NEAR(phase.start.value(), at, 1e-10);
      at = phase.position_at(phase.duration).value();
      check_phase(move->segment, phase);
      if (testing::Test::HasFatalFailure()) return;
    }
    ASSERT_NEAR(move->to.value(), at, 1e-10);
  }

 private:
  void rest() {
    for (const Axis axis : all_axes) {
      ASSERT_NEAR(before_[axis].velocity, 0, 1e-9);
      if (limits_.jerk[axis] > MmPerSecond3(0)) {
        ASSERT_NEAR(before_[axis].acceleration, 0, 1e-9);
      }
    }
  }

  void check_phase(const Segment& segment, const Phase& phase) {
    for (const Axis axis : all_axes) {
      const double v = limits_.velocity[axis].value();
      const double a = limits_.acceleration[axis].value();
      const double j = limits_.jerk[axis].value();
      const AxisMotion begin = motion_at(segment.curve, axis, phase, 0);
      if (v > 0) {
        ASSERT_NEAR(begin.velocity, before_[axis].velocity, 1e-6 * v);
      }
      if (j > 0) {
        ASSERT_NEAR(begin.acceleration, before_[axis].acceleration, 1e-3 * a);
      }
      for (int k = 0; k <= 40; ++k) {
        const AxisMotion here = motion_at(segment.curve, axis, phase, phase.duration.value() * k / 40.0);
        if (v > 0) {
          ASSERT_LE(std::abs(here.velocity), v * tolerated);
        }
        if (a > 0) {
          const AccelerationCurve& falling = limits_.falling[axis];
          const double most =
              falling.empty() ? a : std::min(a, falling.at(MmPerSecond(std::min(std::abs(here.velocity), v))).value());
          ASSERT_LE(std::abs(here.acceleration), most * tolerated) << letter_of(axis) << " at " << here.velocity;
        }
        if (j > 0) {
          ASSERT_LE(std::abs(here.jerk), j * tolerated);
        }
      }
      before_[axis] = motion_at(segment.curve, axis, phase, phase.duration.value());
    }
    for (const RowLimits& own : limits_.rows) {
      for (int k = 0; k <= 40; ++k) {
        AxisMotion here;
        for (const auto& [axis, factor] : own.row.shares()) {
          const AxisMotion part = motion_at(segment.curve, axis, phase, phase.duration.value() * k / 40.0);
          here.velocity += factor * part.velocity;
          here.acceleration += factor * part.acceleration;
          here.jerk += factor * part.jerk;
        }
        ASSERT_LE(std::abs(here.velocity), own.velocity.value() * tolerated) << "of a row";
        ASSERT_LE(std::abs(here.acceleration), own.acceleration.value() * tolerated) << "of a row";
        ASSERT_LE(std::abs(here.jerk), own.jerk.value() * tolerated) << "of a row";
      }
    }
    for (int k = 0; k <= 40; ++k) {
      const double speed = phase.velocity_at(phase.duration * (k / 40.0)).value();
      ASSERT_GE(speed, -1e-9);
      ASSERT_LE(speed, segment.speed.value() * tolerated);
    }
  }

  static constexpr double tolerated = 1.0005;
  MotionLimits limits_;
  PerAxis<AxisMotion> before_;
};

inline void expect_within_limits(const std::vector<MotionItem>& motion, const MotionLimits& limits) {
  JerkOracle(limits).check(motion);
}

// Returns pieces of a uniform cubic B-spline: tangents and second derivatives are continuous.
inline std::vector<PathItem> smooth_chain(Random& random, int pieces) {
  std::vector<Point> control{xyz(0, 0)};
  double direction = 0;
  double size = std::exp(random.between(-4, 2));
  const double wildness = random.between(0.01, 1.2);
  while (control.size() < static_cast<std::size_t>(pieces) + 3) {
    direction += random.between(-wildness, wildness);
    const Point step = xyz(std::cos(direction), std::sin(direction), random.between(-0.3, 0.3)) * size;
    control.push_back(control.back() + step * random.between(0.3, 1 / 1.05));
  }
  std::vector<PathItem> path;
  const double speed = std::exp(random.between(1, 6));
  const auto place = [&](std::size_t i) { return (control[i] + control[i + 1] * 4 + control[i + 2]) * (1.0 / 6); };
  const auto tangent = [&](std::size_t i) { return (control[i + 2] - control[i]) * (0.5 / size); };
  for (std::size_t i = 0; i + 3 < control.size(); ++i) {
    path.emplace_back(segment_of(Curve::cubic(place(i), tangent(i), place(i + 1), tangent(i + 1), Mm(size)), speed));
  }
  return path;
}

}  // namespace passo::test
