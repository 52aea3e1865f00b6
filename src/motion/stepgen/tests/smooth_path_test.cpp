// Tests the step generator with motion as a smoother and a planner with jerk make it: cubics, parts of segments, phases
// of constant jerk.
#include <cstdlib>

#include "kit/smooth_motion.hpp"
#include "kit/stage_test.hpp"
#include "kit/step_oracle.hpp"

#include "passo/stepgen/step_generator.hpp"

namespace passo {
namespace {

using oracle::expect_exact;
using test::xyz;

int runs() {
  const char* text = std::getenv("PASSO_RUNS");
  return text != nullptr ? std::atoi(text) : 25;
}

StepOptions machine(std::initializer_list<double> steps_per_mm, BoardClock clock = {}) {
  StepOptions options;
  for (const double steps : steps_per_mm) {
    options.kinematics.add({.steps = {all_axes[options.kinematics.motor_count()], steps}});
  }
  options.clock = clock;
  return options;
}

double length_of(const std::vector<Curve>& curves) {
  double length = 0;
  for (const Curve& curve : curves) length += curve.length().value();
  return length;
}

// The highest speed at which the board can give the steps, and a machine can follow the bends.
double fastest_along(const std::vector<Curve>& curves, const StepOptions& options) {
  constexpr double sideways = 4000;  // mm/s²
  double speed = 1e9;
  for (const Curve& curve : curves) {
    for (const MotorRow& motor : options.kinematics.rows()) {
      const double steps = motor.steps.most_of(curve.steepest());
      speed = std::min(speed, 0.8 * options.clock.highest_event_rate.value() / steps);
    }
    speed = std::min(speed, std::sqrt(sideways / curve.curvature()));
  }
  return speed;
}

// Phases with jerk, from rest to rest.
std::vector<Phase> one_rise_and_fall(double length, double speed) {
  test::PhaseChain chain;
  chain.change_speed(1, 1, 0.3);
  chain.cruise(2);
  chain.change_speed(0, 1, 0.3);
  return chain.over(length, speed);
}

void expect_counts(const std::vector<MotionItem>& items, const StepOptions& options) {
  const oracle::Playback played = oracle::play(oracle::generate(items, options), options);
  const Curve& last = std::get<PlannedMove>(items.back()).segment.curve;
  const MotorPosition end = options.kinematics.motors(last.end());
  for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
    EXPECT_EQ(played.counts[m], std::llround(end[m])) << "motor " << m;
  }
}

TEST(SmoothPaths, one_cubic_there_and_back_steps_at_the_exact_times) {
  const StepOptions options = machine({640, 640, 640});
  const std::vector<Curve> curves = {
      Curve::cubic(xyz(0, 0), xyz(0.8, 0.6), xyz(1.0013, 0.2, -1), xyz(-0.8, 0.6, 0), Mm(4))};
  const auto items = test::moves_along(curves, one_rise_and_fall(4, 40), 100);
  expect_exact(items, options);
  expect_counts(items, options);
}

TEST(SmoothPaths, a_cubic_that_begins_and_ends_where_a_motor_turns_back) {
  const StepOptions options = machine({100, 100});
  const std::vector<Curve> curves = {Curve::cubic(xyz(0, 0), xyz(0, 1), xyz(1, 1), xyz(1, 0), Mm(1.6)),
                                     Curve::cubic(xyz(1, 1), xyz(1, 0), xyz(2, 0), xyz(0, -1), Mm(1.6)),
                                     Curve::cubic(xyz(2, 0), xyz(0, -1), xyz(1, -1), xyz(-1, 0), Mm(1.6))};
  const auto items = test::moves_along(curves, one_rise_and_fall(length_of(curves), 20), 100);
  expect_exact(items, options);
  expect_counts(items, options);
}

TEST(SmoothPaths, a_single_motor_that_stops_along_the_curve_finds_its_way_back) {
  const StepOptions options = machine({200});
  const std::vector<Curve> curves = {Curve::cubic(xyz(0, 0), xyz(1, 0), xyz(0.3, 0), xyz(1, 0), Mm(3)),
                                     Curve::cubic(xyz(0.3, 0), xyz(1, 0), xyz(1, 0), xyz(0, 0), Mm(1))};
  const auto items = test::moves_along(curves, one_rise_and_fall(length_of(curves), 20), 0.37);
  expect_exact(items, options);
  expect_counts(items, options);
}

TEST(SmoothPaths, a_cubic_that_leaves_with_neither_slope_nor_bend_is_followed) {
  const StepOptions options = machine({100, 100});
  const std::vector<Curve> curves = {Curve::cubic(xyz(0, 0), xyz(0, 0), xyz(2, -1), xyz(3, -1.5), Mm(2))};
  const auto items = test::moves_along(curves, one_rise_and_fall(2, 10), 100);
  expect_exact(items, options);
  expect_counts(items, options);
}

TEST(SmoothPaths, parts_of_a_segment_give_the_very_segments_that_it_gives_in_one) {
  const StepOptions options = machine({640, 640});
  const double length = Curve::line(xyz(0, 0), xyz(30, 20)).length().value();
  const std::vector<Curve> line = {Curve::line(xyz(0, 0), xyz(30, 20))};
  std::vector<Phase> phases(1);
  phases[0].duration = Seconds(length / 50);
  phases[0].velocity = MmPerSecond(50);
  const auto whole = oracle::play(oracle::generate(test::moves_along(line, phases, 1000), options), options);
  const auto parts = oracle::play(oracle::generate(test::moves_along(line, phases, 0.15), options), options);
  EXPECT_EQ(parts.counts, whole.counts);
  EXPECT_EQ(parts.events, whole.events);
  EXPECT_LE(parts.segments, whole.segments + 1);
  EXPECT_GT(whole.events, 250 * (whole.segments - 2));
}

TEST(SmoothPaths, parts_of_arcs_and_helices_are_exact) {
  const StepOptions options = machine({640, 100, 48});
  const double around = 2 * std::numbers::pi;
  const std::vector<Curve> curves = {Curve::arc(xyz(0, 0), xyz(0, 0, -1), Axis::x, Axis::y, 5, 0, -around),
                                     Curve::arc(xyz(0, 0, -1), xyz(10, 0, -1), Axis::x, Axis::y, 5, 0, around / 2)};
  const auto items = test::moves_along(curves, one_rise_and_fall(length_of(curves), 40), 0.7);
  EXPECT_GT(items.size(), 60U);
  expect_exact(items, options);
  expect_counts(items, options);
}

TEST(SmoothPaths, a_dense_relief_keeps_its_segments_long) {
  const StepOptions options = machine({400, 400, 400}, {.highest_event_rate = Hertz(1e6)});
  std::vector<Point> points;
  for (int i = 0; i < 400; ++i) points.push_back(xyz(i * 0.15, 0, 0.5 * std::sin(i * 0.1)));
  const std::vector<Curve> curves = test::spline_through(points);
  std::vector<Phase> phases(1);
  phases[0].duration = Seconds(length_of(curves) / 50);
  phases[0].velocity = MmPerSecond(50);
  const auto items = test::moves_along(curves, phases, 100);
  ASSERT_EQ(items.size(), curves.size());
  const oracle::Playback played = oracle::play(oracle::generate(items, options), options);
  EXPECT_GT(played.events, 25 * played.segments);
}

// Splines through random points, cut into parts. The speeds change with jerk or without.
class RandomSmoothPaths : public testing::Test {
 protected:
  test::Random random_;

  double uniform(double low, double high) { return random_.between(low, high); }
  int below(int n) { return static_cast<int>(random_.between(0, n)); }

  StepOptions random_machine() {
    constexpr std::array<double, 7> finenesses = {10, 48, 100, -100, 400, 1000, -3200};
    constexpr std::array<double, 3> event_rates = {100e3, 140e3, 1e6};
    const auto fineness = [&] { return finenesses[static_cast<std::size_t>(below(7))]; };
    StepOptions options = machine({fineness(), fineness(), fineness()});
    options.clock.highest_event_rate = Hertz(event_rates[static_cast<std::size_t>(below(3))]);
    if (options.clock.highest_event_rate == Hertz(1e6) && below(2) == 0) options.clock.tick_rate = Hertz(72e6);
    return options;
  }

  std::vector<Curve> random_curves() {
    const double size = std::pow(10.0, uniform(-1.5, 0.5));
    std::vector<Point> points = {xyz(0, 0)};
    const int pieces = 1 + below(8);
    const bool flat = below(3) == 0;
    Point way = xyz(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    for (int i = 0; i < pieces; ++i) {
      way = way * 0.6 + xyz(uniform(-1, 1), uniform(-1, 1), flat ? 0 : uniform(-1, 1));
      points.push_back(points.back() + way * size);
    }
    return test::spline_through(points);
  }

  std::vector<Phase> random_phases(double length, double speed) {
    test::PhaseChain chain;
    const int changes = 1 + below(12);
    for (int i = 0; i <= changes; ++i) {
      const double share = below(3) == 0 ? 0 : below(3) == 0 ? 0.5 : uniform(0.05, 0.45);
      chain.change_speed(i == changes ? 0 : uniform(0.05, 1), uniform(0.1, 1), share);
      if (below(2) == 0 && i < changes) chain.cruise(uniform(0, 0.5));
    }
    return chain.over(length, speed);
  }

  template <class Machine>
  void expect_exact_paths(int trials, const Machine& machine_of_trial) {
    for (int i = 0; i < trials; ++i) {
      SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << random_.seed() << " path " << i);
      const StepOptions options = machine_of_trial();
      const std::vector<Curve> curves = random_curves();
      const double length = length_of(curves);
      const double speed = uniform(0.05, 1) * fastest_along(curves, options);
      const double part = below(2) == 0 ? 1000 : uniform(0.02, 0.5) * length / static_cast<double>(curves.size());
      const auto items = test::moves_along(curves, random_phases(length, speed), part);
      expect_exact(items, options);
      expect_counts(items, options);
      if (HasFailure()) return;
    }
  }
};

TEST_F(RandomSmoothPaths, step_where_and_when_mathematics_puts_it) {
  expect_exact_paths(runs(), [&] { return random_machine(); });
}

TEST_F(RandomSmoothPaths, step_where_and_when_mathematics_puts_it_if_axes_share_motors) {
  expect_exact_paths((runs() + 4) / 5, [&] {
    StepOptions options = random_machine();
    const double scale = options.kinematics.rows()[0].steps.factor();
    const double alone = options.kinematics.rows()[2].steps.factor();
    options.kinematics = {{.steps = {{Axis::x, scale}, {Axis::y, scale}}},
                          {.steps = {{Axis::x, scale}, {Axis::y, -scale}}},
                          {.steps = {Axis::z, alone}}};
    return options;
  });
}

}  // namespace
}  // namespace passo
