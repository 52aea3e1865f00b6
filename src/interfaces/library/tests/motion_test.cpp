// Planned motion beside the limits, the path and the steps that were asked for, by arithmetic of its own.
#include "passo/library/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo::v1 {
namespace {

constexpr double tolerance = 0.02;

Limits three_axes(double jerk) {
  Limits limits;
  limits[Axis::x] = {200, 1500, jerk};
  limits[Axis::y] = {150, 1200, jerk};
  limits[Axis::z] = {50, 300, jerk};
  return limits;
}

// A rectangle's two sides, a half circle and a descent.
Path example() {
  Path path({.x = 5});
  path.set_tolerance(tolerance);
  path.line_to({.x = 60}, 100);
  path.line_to({.x = 60, .y = 40}, 100);
  path.arc_to({.x = 20, .y = 40}, ArcPlane::xy, 40, 40, 1, 80);
  path.stop(0.5);
  path.line_to({.x = 20, .y = 40, .z = -2});
  return path;
}

// The distance of a place from the example's path.
double distance_from_example(const Position& p) {
  const auto to_line = [&](const Position& a, const Position& b) {
    const std::array<double, 3> along{b.x - a.x, b.y - a.y, b.z - a.z};
    const std::array<double, 3> from{p.x - a.x, p.y - a.y, p.z - a.z};
    double length = 0;
    double share = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      length += along[i] * along[i];
      share += along[i] * from[i];
    }
    share = std::clamp(share / length, 0.0, 1.0);
    return std::hypot(from[0] - share * along[0], from[1] - share * along[1], from[2] - share * along[2]);
  };
  const double to_circle = p.y < 40 ? 1e9 : std::hypot(std::hypot(p.x - 40, p.y - 40) - 20, p.z);
  return std::min({to_line({.x = 5}, {.x = 60}), to_line({.x = 60}, {.x = 60, .y = 40}), to_circle,
                   to_line({.x = 20, .y = 40}, {.x = 20, .y = 40, .z = -2})});
}

class PlannedPath : public testing::TestWithParam<double> {};

TEST_P(PlannedPath, stays_within_the_limits_and_on_the_path) {
  const Limits limits = three_axes(GetParam());
  const Outcome<Motion> motion = plan(example(), limits);
  ASSERT_TRUE(motion);
  constexpr std::size_t count = 40'000;
  std::vector<MotionState> states(count);
  const double interval = motion->duration_s() / (count - 1);
  motion->sample(0, interval, count, states.data());
  MotionState before = states.front();
  EXPECT_EQ(before.position, (Position{.x = 5}));
  EXPECT_EQ(before.speed_mm_per_s, 0);
  double farthest = 0;
  for (const MotionState& state : states) {
    farthest = std::max(farthest, distance_from_example(state.position));
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      const AxisLimits& most = limits[axis];
      ASSERT_LE(std::abs(state.velocity[axis]), most.velocity_mm_per_s * (1 + 1e-6));
      ASSERT_LE(std::abs(state.acceleration[axis]), most.acceleration_mm_per_s2 * (1 + 1e-6));
      // The states fit each other.
      ASSERT_NEAR(state.position[axis] - before.position[axis],
                  interval * (state.velocity[axis] + before.velocity[axis]) / 2,
                  interval * interval * most.acceleration_mm_per_s2);
      if (most.jerk_mm_per_s3 > 0) {
        ASSERT_LE(std::abs(state.acceleration[axis] - before.acceleration[axis]),
                  most.jerk_mm_per_s3 * interval * 1.001 + 1e-6);
      }
    }
    before = state;
  }
  EXPECT_LE(farthest, tolerance * (1 + 1e-6));
  EXPECT_GT(farthest, tolerance / 10);  // the corner is rounded
  EXPECT_NEAR(before.position.x, 20, 1e-9);
  EXPECT_NEAR(before.position.y, 40, 1e-9);
  EXPECT_NEAR(before.position.z, -2, 1e-9);
  EXPECT_NEAR(before.speed_mm_per_s, 0, 1e-6);
  EXPECT_EQ(before.piece, 5U);
  EXPECT_NEAR(motion->length_mm(), 55 + 40 + 20 * 3.14159265 + 2, 1);
}
INSTANTIATE_TEST_SUITE_P(Jerk, PlannedPath, testing::Values(0.0, 30'000.0));

TEST(PlannedLine, takes_the_time_of_its_trapezoid) {
  Path path;
  path.line_to({.x = 100}, 50);
  const Outcome<Motion> motion = plan(path, three_axes(0));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->duration_s(), 100.0 / 50 + 50.0 / 1500, 1e-9);
  EXPECT_NEAR(motion->at(1).speed_mm_per_s, 50, 1e-9);
  EXPECT_NEAR(motion->at(1).velocity.x, 50, 1e-9);
  EXPECT_EQ(motion->at(-1).position, Position{});
  EXPECT_EQ(motion->at(std::nan("")).position, Position{});
  EXPECT_NEAR(motion->at(1e9).position.x, 100, 1e-9);
}

TEST(PlannedPath, rests_as_long_as_the_stop_says) {
  const Outcome<Motion> motion = plan(example(), three_axes(0));
  ASSERT_TRUE(motion);
  double rest = 0;
  constexpr double interval = 1e-3;
  for (double time = 0; time < motion->duration_s(); time += interval) {
    const MotionState state = motion->at(time);
    if (state.piece != 4) continue;
    rest += interval;
    EXPECT_EQ(state.speed_mm_per_s, 0);
    EXPECT_NEAR(state.position.x, 20, 1e-9);
  }
  EXPECT_NEAR(rest, 0.5, 2 * interval);
}

TEST(PlannedPath, without_pieces_takes_no_time) {
  const Outcome<Motion> motion = plan(Path({.x = 3}), three_axes(0));
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->duration_s(), 0);
  EXPECT_EQ(motion->at(1).position.x, 3);
  StepOptions motors;
  motors[Axis::x] = 80;
  Outcome<StepTrain> steps = motion->steps(motors);
  ASSERT_TRUE(steps);
  Step step;
  EXPECT_EQ(steps->read(&step, 1), 0U);
}

TEST(PlannedPath, is_the_same_for_several_threads) {
  const Outcome<Motion> motion = plan(example(), three_axes(0));
  ASSERT_TRUE(motion);
  std::array<double, 2> sums{};
  const auto sum_up = [&](double& sum) {
    for (int i = 0; i < 1000; ++i) sum += motion->at(motion->duration_s() * i / 1000).position.x;
  };
  std::thread other([&] { sum_up(sums[1]); });
  sum_up(sums[0]);
  other.join();
  EXPECT_EQ(sums[0], sums[1]);
}

TEST(PlannedSteps, are_where_and_when_the_motion_is) {
  const Outcome<Motion> motion = plan(example(), three_axes(0));
  ASSERT_TRUE(motion);
  StepOptions motors;
  motors[Axis::x] = 80;
  motors[Axis::y] = 100;
  motors[Axis::z] = -400;
  Outcome<StepTrain> train = motion->steps(motors);
  ASSERT_TRUE(train);
  std::array<std::int64_t, 3> counts{5 * 80, 0, 0};
  std::int64_t last = 0;
  std::vector<Step> steps(777);
  std::size_t all = 0;
  for (std::size_t count = train->read(steps.data(), steps.size()); count > 0;
       count = train->read(steps.data(), steps.size())) {
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_GE(steps[i].tick, last);
      last = steps[i].tick;
      const auto axis = static_cast<std::size_t>(steps[i].axis);
      const int way = steps[i].forward ? 1 : -1;
      const double scale = motors.steps_per_mm[axis];
      // The step is made halfway between two counts, or at the next event: one of them takes at most 80 µs.
      const MotionState state = motion->at(static_cast<double>(last) / train->ticks_per_s());
      const double exact = state.position[steps[i].axis] * scale;
      const double reach = std::abs(state.velocity[steps[i].axis] * scale) * 81e-6 + 0.02;
      ASSERT_NEAR(exact, static_cast<double>(counts[axis]) + way * 0.5, reach) << all + i;
      counts[axis] += way;
    }
    all += count;
  }
  EXPECT_EQ(counts, (std::array<std::int64_t, 3>{20 * 80, 40 * 100, 2 * 400}));
  EXPECT_NEAR(static_cast<double>(last) / train->ticks_per_s(), motion->duration_s(), 0.02);
}

std::string first_code(const std::vector<Finding>& findings) {
  return findings.empty() ? "" : findings.front().code;
}

TEST(PlannedPath, refuses_values_out_of_range_with_their_piece) {
  const double no_number = std::nan("");
  const auto code_of = [](const Path& path, const Limits& limits = three_axes(0)) {
    const Outcome<Motion> motion = plan(path, limits);
    EXPECT_FALSE(motion);
    EXPECT_FALSE(motion.findings().empty() || motion.findings().front().message.empty() ||
                 motion.findings().front().expected.empty());
    return first_code(motion.findings());
  };
  const auto line = [](const Position& end, double speed) {
    Path path;
    path.line_to(end, speed);
    return path;
  };
  const auto arc = [](double first, double second, int turns) {
    Path path;
    path.arc_to({.x = 1}, ArcPlane::xy, first, second, turns);
    return path;
  };
  EXPECT_EQ(code_of(line({.x = no_number}, 10)), "plan.place");
  EXPECT_EQ(code_of(line({.x = 2e5}, 10)), "plan.place");
  EXPECT_EQ(code_of(line({.x = 1}, 0)), "plan.speed");
  EXPECT_EQ(code_of(line({.x = 1}, no_number)), "plan.speed");
  EXPECT_EQ(code_of(line({.a = 1}, 10)), "plan.no-axis");
  EXPECT_EQ(code_of(arc(0.5, 0, 0)), "plan.turns");
  EXPECT_EQ(code_of(arc(0.5, 0, std::numeric_limits<int>::min())), "plan.turns");
  EXPECT_EQ(code_of(arc(0, 0, 1)), "plan.radius");
  EXPECT_EQ(code_of(arc(no_number, 0, 1)), "plan.place");
  Path path;
  path.stop(-1);
  EXPECT_EQ(code_of(path), "plan.dwell");
  Path loose;
  loose.set_tolerance(-1);
  loose.line_to({.x = 1}, 1);
  EXPECT_EQ(code_of(loose), "plan.tolerance");
  Limits limits = three_axes(0);
  limits[Axis::x].acceleration_mm_per_s2 = 0;
  EXPECT_EQ(code_of(line({.x = 1}, 1), limits), "plan.limit");
  limits = three_axes(-1);
  EXPECT_EQ(code_of(line({.x = 1}, 1), limits), "plan.limit");

  Path second = line({.x = 1}, 1);
  second.line_to({.x = 2}, -1);
  EXPECT_EQ(plan(second, three_axes(0)).findings().front().line, 2U);
}

TEST(PlannedSteps, refuse_values_out_of_range) {
  const Outcome<Motion> motion = plan(example(), three_axes(0));
  ASSERT_TRUE(motion);
  const auto code_of = [&](const StepOptions& motors) { return first_code(motion->steps(motors).findings()); };
  StepOptions motors;
  EXPECT_EQ(code_of(motors), "steps.motors");
  motors.steps_per_mm.fill(80);
  EXPECT_EQ(code_of(motors), "steps.motors");
  motors = {};
  motors[Axis::x] = 1e4;
  EXPECT_EQ(code_of(motors), "steps.too-fast");
  motors[Axis::x] = std::nan("");
  EXPECT_EQ(code_of(motors), "steps.scale");
  motors[Axis::x] = 80;
  motors.ticks_per_s = 0;
  EXPECT_EQ(code_of(motors), "steps.clock");
  motors.ticks_per_s = 1e6;
  motors.events_per_s = 1e5;
  EXPECT_EQ(code_of(motors), "steps.events");
  EXPECT_EQ(first_code(motion->steps().findings()), "steps.no-machine");
}

}  // namespace
}  // namespace passo::v1
