// Limits that fall with the speed: the curve itself, and the planner's use of it.
#include "passo/trajectory/acceleration_curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "planner_kit.hpp"
#include "random_program.hpp"

namespace passo {
namespace {

using test::line;
using test::plan;
using test::total_time;
using test::xyz;
using Limit = std::function<double(double)>;

AccelerationCurve curve_of(const Limit& limit, double fastest, double most) {
  std::vector<AccelerationCurve::Sample> samples;
  for (int i = 0; i <= 4096; ++i) {
    const double speed = fastest * i / 4096;
    samples.push_back({.speed = MmPerSecond(speed), .acceleration = MmPerSecond2(limit(speed))});
  }
  return AccelerationCurve::below(samples, MmPerSecond2(most));
}

// All axes have the same limits.
struct Machine {
  Limit limit;
  double fastest;
  MotionLimits limits;

  // `rise` is the time in which the acceleration rises from 0 to its value at rest; 0: at once.
  Machine(const Limit& own, double velocity, double rise = 0) : limit(own), fastest(velocity) {
    for (const Axis axis : all_axes) {
      if (rise > 0) limits.jerk[axis] = MmPerSecond3(own(0) / rise);
      limits.velocity[axis] = MmPerSecond(velocity);
      limits.acceleration[axis] = MmPerSecond2(own(0));
      limits.falling[axis] = curve_of(own, velocity, own(0));
    }
  }
};

double even_fall(double v) {
  return 2000 * (1 - v / 120);
}
// Flat at first, then like a motor on a chopper.
double shouldered(double v) {
  return v < 40 ? 3000 : 3000 * std::pow(40 / v, 1.3);
}

double time_of_line(double length, double speed, const MotionLimits& limits) {
  return total_time(plan({line(xyz(0, 0), xyz(length, 0), speed)}, limits));
}

// The time from rest to rest in small steps of the speed: dv/dt = A(v) up to `top`, then constant.
double integrated_time(double length, double top, const Limit& limit) {
  constexpr int steps = 2'000'000;
  const double change = top / steps;
  double time = 0;
  double way = 0;
  for (int i = 0; i < steps && way < length / 2; ++i) {
    const double v = change * (i + 0.5);
    time += change / limit(v);
    way += v * change / limit(v);
  }
  return 2 * (time + std::max(length / 2 - way, 0.0) / top);
}

void expect_below(const Limit& limit, const MotionItem& item, const Machine& machine) {
  const auto* move = std::get_if<PlannedMove>(&item);
  if (move == nullptr) return;
  const Curve& curve = move->segment.curve;
  for (const Phase& phase : *move) {
    for (int k = 0; k <= 12; ++k) {
      const double t = phase.duration.value() * k / 12;
      const double j = phase.jerk.value();
      const double a = phase.acceleration.value() + j * t;
      const double v = phase.velocity.value() + t * (phase.acceleration.value() + t * j / 2);
      const Mm s(phase.start.value() + t * (phase.velocity.value() + t * (phase.acceleration.value() / 2 + t * j / 6)));
      const Point slope = curve.tangent(s);
      const Point bend = curve.second_derivative(s);
      for (const Axis axis : all_axes) {
        const double speed = std::abs(slope[axis] * v);
        ASSERT_LE(speed, machine.fastest * (1 + 1e-9));
        ASSERT_LE(std::abs(slope[axis] * a + bend[axis] * v * v), limit(std::min(speed, machine.fastest)) * (1 + 1e-7))
            << letter_of(axis) << " at " << speed << " mm/s\n"
            << to_text(*move);
      }
    }
  }
}

TEST(AccelerationCurve, is_never_above_what_it_is_made_of_and_hardly_below) {
  for (const Limit& limit : {Limit(even_fall), Limit(shouldered)}) {
    const AccelerationCurve curve = curve_of(limit, 110, limit(0));
    for (double v = 0; v <= 110; v += 0.01) {
      const double here = std::min(curve.at(MmPerSecond(v)).value(), limit(0));
      ASSERT_LE(here, limit(v) * (1 + 1e-12)) << v;
      ASSERT_GE(here, limit(v) * 0.99) << v;
    }
    EXPECT_LT(curve.lines().size(), 200U);
  }
}

TEST(AccelerationCurve, is_below_any_falling_stairs) {
  test::Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  for (int n = 0; n < 200; ++n) {
    std::vector<AccelerationCurve::Sample> samples;
    double speed = 0;
    double acceleration = 1000;
    for (int i = 0; i < 30; ++i) {
      samples.push_back({.speed = MmPerSecond(speed), .acceleration = MmPerSecond2(acceleration)});
      speed += random.between(0.1, 5);
      if (random.chance(0.7)) acceleration *= random.between(0.7, 1);
    }
    const double most = random.chance(0.5) ? 1000 : 800;
    const AccelerationCurve curve = AccelerationCurve::below(samples, MmPerSecond2(most));
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      for (const double v : {samples[i].speed.value(), samples[i + 1].speed.value() - 1e-9}) {
        const double here = curve.empty() ? most : std::min(most, curve.at(MmPerSecond(v)).value());
        ASSERT_LE(here, std::min(most, samples[i + 1].acceleration.value()) * (1 + 1e-9)) << v;
      }
    }
  }
}

TEST(AccelerationCurve, of_a_constant_is_none) {
  EXPECT_TRUE(curve_of([](double) { return 500.0; }, 100, 500).empty());
  EXPECT_TRUE(curve_of([](double) { return 700.0; }, 100, 500).empty());
}

// A0 (1 - v/w): v = w (1 - exp(-A0 t / w)), s = w t - w v / A0.
TEST(FallingLimits, a_line_from_rest_to_rest_takes_as_long_as_the_closed_form_says) {
  const Machine machine(even_fall, 114);
  for (const double length : {0.3, 2.0, 5.0, 10.0}) {
    const auto way = [](double t) {
      const double v = 120 * (1 - std::exp(-2000 * t / 120));
      return 120 * t - 120 * v / 2000;
    };
    double low = 0;
    double high = 1;
    for (int i = 0; i < 100; ++i) (way((low + high) / 2) < length / 2 ? low : high) = (low + high) / 2;
    ASSERT_LT(120 * (1 - std::exp(-2000 * low / 120)), 114);
    const double time = time_of_line(length, 1000, machine.limits);
    EXPECT_GT(time, 2 * low * (1 - 1e-9)) << length;
    EXPECT_LT(time, 2 * low * 1.005) << length;
    EXPECT_NEAR(integrated_time(length, 114, even_fall), 2 * low, 1e-5 * low);
  }
}

TEST(FallingLimits, a_line_takes_as_long_as_numerical_integration_says) {
  const Machine machine(shouldered, 150);
  for (const double speed : {25.0, 70.0, 150.0, 1000.0}) {
    for (const double length : {0.02, 1.0, 8.0, 60.0}) {
      const double expected = integrated_time(length, std::min(speed, 150.0), shouldered);
      const double time = time_of_line(length, speed, machine.limits);
      EXPECT_GT(time, expected * (1 - 1e-5)) << length << " at " << speed;
      EXPECT_LT(time, expected * 1.005) << length << " at " << speed;
    }
  }
}

// The acceleration rises and falls once or twice on either side, and each of these takes one rise.
TEST(FallingLimits, with_a_limit_of_jerk_a_line_takes_some_rises_of_the_acceleration_longer) {
  constexpr double rise = 0.005;
  const Machine machine(shouldered, 150, rise);
  for (const double length : {8.0, 60.0}) {
    const double expected = integrated_time(length, 150, shouldered);
    const double time = time_of_line(length, 1000, machine.limits);
    EXPECT_GT(time, expected + 0.5 * rise) << length;
    EXPECT_LT(time, 1.02 * expected + 3 * rise) << length;
    std::printf("%g mm: %.6f s, without a limit of jerk %.6f s\n", length, time, expected);
  }
}

TEST(FallingLimits, a_curve_that_is_constant_is_planned_as_a_constant_limit) {
  Machine machine([](double) { return 500.0; }, 100);
  const MotionLimits constant = machine.limits;
  for (const Axis axis : all_axes) {
    machine.limits.acceleration[axis] = MmPerSecond2(900);
    machine.limits.falling[axis] = curve_of(machine.limit, 100, 900);
  }
  test::Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const auto path = test::RandomProgram(random).draw(1000);
  EXPECT_NEAR(total_time(plan(path, machine.limits)) / total_time(plan(path, constant)), 1, 2e-3);
  EXPECT_NEAR(time_of_line(60, 1000, machine.limits), 60.0 / 100 + 100.0 / 500, 1e-3);
}

TEST(FallingLimits, a_slow_feed_below_the_shoulder_is_planned_in_three_phases) {
  const Machine machine(shouldered, 150);
  const auto motion = plan({line(xyz(0, 0), xyz(60, 0), 15)}, machine.limits);
  EXPECT_EQ(std::get<PlannedMove>(motion.at(0)).phase_count, 3U);
}

struct Falling {
  int number;
  double rise;
};

class FallingPrograms : public testing::TestWithParam<Falling> {};

TEST_P(FallingPrograms, never_exceed_the_curve_and_come_to_rest) {
  test::Random random(static_cast<std::uint64_t>(GetParam().number));
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const double shoulder = random.between(5, 100);
  const double power = random.between(0.3, 2);
  const double strong = random.between(300, 5000);
  const Limit limit = [=](double v) { return v < shoulder ? strong : strong * std::pow(shoulder / v, power); };
  const Machine machine(limit, random.between(50, 300), GetParam().rise);
  const auto path = test::RandomProgram(random).draw(1500);
  for (const std::size_t queued : {Planner::most_queued_cells, std::size_t{500}}) {
    double speed = 0;
    for (const MotionItem& item : plan(path, machine.limits, queued)) {
      expect_below(limit, item, machine);
      if (HasFatalFailure()) return;
      const auto* move = std::get_if<PlannedMove>(&item);
      if (move == nullptr) {
        ASSERT_NEAR(speed, 0, 1e-12);
        continue;
      }
      for (const Phase& phase : *move) {
        ASSERT_TRUE(std::isfinite(phase.duration.value()) && phase.duration.value() > 0);
        ASSERT_NEAR(phase.velocity.value(), speed, 1e-9 * speed + 1e-12);
        speed = phase.velocity_at(phase.duration).value();
      }
    }
    ASSERT_NEAR(speed, 0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Seven, FallingPrograms,
                         testing::Values(Falling{0, 0}, Falling{1, 0}, Falling{2, 0}, Falling{3, 0}, Falling{4, 0},
                                         Falling{5, 0.02}, Falling{6, 0.005}));

// A dense program, of cubics of 0.2 mm: planning costs time for each cell, and finer cells gain nothing.
TEST(FallingLimits, cut_a_short_cubic_into_few_cells) {
  const Machine machine(shouldered, 150);
  CellCutter cutter(machine.limits);
  Segment bent;
  bent.curve = Curve::cubic(xyz(0, 0), xyz(1, 0), xyz(0.2, 0.01), xyz(std::sqrt(0.99), 0.1), Mm(0.2));
  bent.speed = MmPerSecond(50);
  cutter.begin(bent, 50 * 50);
  int cells = 0;
  for (test::LoneCell piece; !cutter.at_end(); ++cells) cutter.next(piece.place());
  EXPECT_LE(cells, 32);
}

}  // namespace
}  // namespace passo
