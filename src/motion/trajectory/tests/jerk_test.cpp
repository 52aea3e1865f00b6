#include <cmath>

#include "jerk_kit.hpp"
#include "kit/in_full.hpp"

namespace passo::test {
namespace {

class JerkLimited : public testing::TestWithParam<int> {
 protected:
  std::string seed() const { return "PASSO_SEED=" + std::to_string(random_.seed()); }

  Random random_;
};

TEST_P(JerkLimited, smooth_chains_keep_every_axis_within_its_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  for (int n = 0; n < 10; ++n) {
    SCOPED_TRACE(n);
    const MotionLimits limits = draw_jerk_limits(random_);
    std::vector<PathItem> path = smooth_chain(random_, 150);
    expect_within_limits(plan(path, limits), limits);
    if (HasFatalFailure()) return;
    expect_within_limits(plan(path, limits, 70), limits);
    if (HasFatalFailure()) return;
  }
}

TEST_P(JerkLimited, lines_arcs_and_rests_keep_every_axis_within_its_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  const MotionLimits limits = draw_jerk_limits(random_);
  std::vector<PathItem> path = RandomProgram(random_).draw(1000);
  expect_within_limits(plan(path, limits), limits);
}

TEST_P(JerkLimited, smoothed_programs_keep_every_axis_within_its_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  const MotionLimits limits = draw_jerk_limits(random_);
  const std::vector<PathItem> program = RandomProgram(random_).draw(600);
  expect_within_limits(plan(smoothed(program, Smoothness::slow_bending), limits), limits);
}

TEST_P(JerkLimited, motors_that_axes_share_keep_within_their_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  MotionLimits limits = draw_jerk_limits(random_);
  limit_shared_motors(random_, limits);
  const std::vector<PathItem> chain = smooth_chain(random_, 150);
  expect_within_limits(plan(chain, limits), limits);
  if (HasFatalFailure()) return;
  const std::vector<PathItem> program = RandomProgram(random_).draw(200);
  expect_within_limits(plan(smoothed(program, Smoothness::slow_bending), limits), limits);
}

INSTANTIATE_TEST_SUITE_P(Seeds, JerkLimited, testing::Range(0, fewer(5)));

TEST(JerkLimitedPlanner, a_line_is_driven_from_rest_to_rest_in_s_curves) {
  expect_golden("src/motion/trajectory/tests/golden/s_curve.txt",
                to_text(plan({line(xyz(0, 0), xyz(10, 0), 40)}, jerk_limits(100, 500, 25'000))));
}

// From rest to a speed v takes v/a + a/j, and braking as much. That is the least time.
TEST(JerkLimitedPlanner, a_line_takes_hardly_longer_than_the_best_s_curve) {
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const double best = 100.0 / 50 + 50.0 / 500 + 500.0 / 25'000;
  const double time = total_time(plan({line(xyz(0, 0), xyz(100, 0), 50)}, limits));
  EXPECT_NEAR(time, best, 1e-9);
}

// These lines are so short that they reach no constant speed, and the shortest no constant acceleration either. With a
// peak speed v the ramps take v/a + a/j, or twice the root of v/j.
TEST(JerkLimitedPlanner, short_lines_take_hardly_longer_than_the_best_s_curve) {
  const double a = 500;
  const double j = 25'000;
  for (const double v : {2.0, 9.0, 12.0, 25.0, 60.0}) {
    SCOPED_TRACE(v);
    const double ramp = v > a * a / j ? v / a + a / j : 2 * std::sqrt(v / j);
    const double time = total_time(plan({line(xyz(0, 0), xyz(v * ramp, 0), 90)}, jerk_limits(100, a, j)));
    EXPECT_GE(time, 2 * ramp * (1 - 1e-9));
    EXPECT_LE(time, 2 * ramp * (1 + 1e-9));
  }
}

// Rest to rest takes a/j + √((a/j)² + 4 d/a). A line of less than 2 a³/j² = 0.4 mm takes 4 ∛(d/2j).
TEST(JerkLimitedPlanner, single_lines_take_the_time_of_seven_phases) {
  const double a = 500;
  const double j = 25'000;
  const auto expect_best = [&](double length, double best) {
    SCOPED_TRACE(length);
    const double third = length / std::sqrt(3);  // along each axis, in any direction
    EXPECT_NEAR(total_time(plan({line(xyz(0, 0), xyz(length, 0), 90)}, jerk_limits(100, a, j))), best, 1e-6 * best);
    const MotionLimits along = jerk_limits(100 / std::sqrt(3), a / std::sqrt(3), j / std::sqrt(3));
    EXPECT_NEAR(total_time(plan({line(xyz(0, 0), xyz(third, third, third), 90)}, along)), best, 1e-6 * best);
  };
  expect_best(1, a / j + std::sqrt(a / j * a / j + 4 * 1 / a));
  expect_best(0.1, 4 * std::cbrt(0.1 / (2 * j)));
  expect_best(0.01, 4 * std::cbrt(0.01 / (2 * j)));
}

// A sluggish machine, and a feed that it reaches after a few milliseconds.
TEST(JerkLimitedPlanner, a_slow_feed_is_reached_at_once) {
  const double a = 500;
  const double j = a / 0.13;
  for (const double v : {0.01, 0.26, 2.0, 20.0}) {
    SCOPED_TRACE(v);
    const double ramp = 2 * std::sqrt(v / j);
    const double time = total_time(plan({line(xyz(0, 0), xyz(10 * v, 0), v)}, jerk_limits(100, a, j)));
    EXPECT_NEAR(time, 10 + ramp, 1e-9);
  }
}

// A leg from rest to rest takes 303.5 ms. With corners of 0.01 mm it takes at least 268.7, by a numerical optimum over
// all paths within the tolerance. With corners that bend least it takes 299, rounded inside with slow bending 283.
TEST(JerkLimitedPlanner, right_angles_are_passed_much_faster_than_stops) {
  std::vector<PathItem> legs;
  constexpr int count = 40;
  Point at;
  for (int i = 0; i < count; ++i) {
    const Point to = at + (i % 2 == 0 ? xyz(10, 0) : xyz(0, 10));
    legs.emplace_back(line(at, to, 100));
    at = to;
  }
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const auto motion = plan(smoothed(legs, Smoothness::slow_bending), limits);
  expect_within_limits(motion, limits);
  const double leg = total_time(motion) / count;
  EXPECT_GT(leg, 0.2687);
  EXPECT_LT(leg, 0.2755);
}

// Eight legs to and fro across the X axis.
std::vector<PathItem> zigzag(double x, double y) {
  std::vector<PathItem> legs;
  for (int i = 0; i < 8; ++i) {
    legs.emplace_back(line(xyz(x * i, i % 2 == 0 ? 0 : y), xyz(x * (i + 1), i % 2 == 0 ? y : 0), 1000));
  }
  return legs;
}

// Where Y goes back with all its speed, the corner swings to the outer side too. Where the corner is gentle, the spline
// slides along the tube. The optima are those of bench/tube_optimum.hpp.
TEST(JerkLimitedPlanner, corners_to_and_fro_are_nearly_the_fastest) {
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const auto time_of = [&](const std::vector<PathItem>& legs) {
    const auto motion = plan(smoothed(legs, Smoothness::slow_bending), limits);
    expect_within_limits(motion, limits);
    return total_time(motion);
  };
  const double half = std::sqrt(0.5);
  EXPECT_LT(time_of(zigzag(half, half)), 0.64123 * 1.04);
  EXPECT_LT(time_of(zigzag(5, 0.5)), 0.91426 * 1.062);
}

// Eight legs of ten and five tolerances, with and without jerk limits. The optima are those of bench/tube_optimum.hpp.
TEST(JerkLimitedPlanner, rows_of_short_legs_are_nearly_the_fastest) {
  const auto row = [](double leg, double turn, bool goes_back) {
    std::vector<PathItem> legs;
    Point at;
    for (int i = 0; i < 8; ++i) {
      const double heading = turn * (goes_back ? i % 2 : i);
      const Point to = at + xyz(leg * std::cos(heading), leg * std::sin(heading));
      legs.emplace_back(line(at, to, 1000));
      at = to;
    }
    return legs;
  };
  const double right_angle = std::acos(0.0);
  struct Row {
    std::vector<PathItem> legs;
    double optimum;
    double ratio;
    double slow_optimum;  // with jerk limits
    double slow_ratio;
  };
  for (const Row& one : {Row{row(0.1, right_angle, true), 0.14441, 1.028, 0.22702, 1.031},
                         Row{row(0.05, right_angle, true), 0.08295, 1.038, 0.15609, 1.057},
                         Row{row(0.1, right_angle / 2, false), 0.10501, 1.022, 0.14072, 1.038}}) {
    SCOPED_TRACE(one.optimum);
    const auto expect_time = [&](Smoothness smoothness, const MotionLimits& limits, double most) {
      const auto motion = plan(smoothed(one.legs, smoothness), limits);
      expect_within_limits(motion, limits);
      EXPECT_LT(total_time(motion), most);
    };
    expect_time(Smoothness::least_bending, jerk_limits(100, 500, 0), one.ratio * one.optimum);
    expect_time(Smoothness::slow_bending, jerk_limits(100, 500, 25'000), one.slow_ratio * one.slow_optimum);
  }
}

TEST(JerkLimitedPlanner, the_acceleration_goes_on_across_joints) {
  std::vector<PathItem> whole{line(xyz(0, 0), xyz(20, 0), 80)};
  std::vector<PathItem> pieces;
  for (int i = 0; i < 200; ++i) pieces.emplace_back(line(xyz(i * 0.1, 0), xyz(i * 0.1 + 0.1, 0), 80));
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const auto motion = plan(pieces, limits);
  expect_within_limits(motion, limits);
  EXPECT_NEAR(total_time(motion) / total_time(plan(whole, limits)), 1, 0.03);
  EXPECT_GT(std::get<PlannedMove>(motion.at(60)).begin()->acceleration.value(), 300);
}

// The share of each axis in the velocity changes along the arc, and the velocity of one axis or the other is the limit.
TEST(JerkLimitedPlanner, an_arc_takes_no_longer_than_its_pieces) {
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  constexpr double radius = 25;
  const auto circle = [](int pieces) {
    const auto at = [](double angle) { return xyz(radius * std::cos(angle), radius * std::sin(angle)); };
    std::vector<PathItem> path;
    const double turn = 2 * std::numbers::pi / pieces;
    for (int i = 0; i < pieces; ++i) {
      const Curve arc = Curve::arc(at(i * turn), at((i + 1) * turn), Axis::x, Axis::y, 0, 0, turn);
      path.emplace_back(segment_of(arc, 1000));
    }
    return path;
  };
  const std::vector<MotionItem> whole = plan(circle(1), limits);
  expect_within_limits(whole, limits);
  EXPECT_LT(total_time(whole), 1.002 * total_time(plan(circle(252), limits)));
}

TEST(JerkLimitedPlanner, a_very_high_jerk_costs_next_to_nothing) {
  MotionLimits limits = jerk_limits(100, 500, 1e9);
  const std::vector<PathItem> path{line(xyz(0, 0), xyz(30, 10), 60), line(xyz(30, 10), xyz(0, 10), 60)};
  const double time = total_time(plan(path, limits));
  limits.jerk = {};
  EXPECT_NEAR(time / total_time(plan(path, limits)), 1, 0.03);
}

TEST(JerkLimitedPlanner, gives_the_same_whether_items_are_new_or_used_again) {
  Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const std::vector<PathItem> path = smooth_chain(random, 300);
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  ListSource<PathItem> source(path);
  Planner planner(source, limits);
  std::string text;
  for (MotionItem fresh; planner.next(fresh); fresh = Action{}) text += passo::to_text(fresh);
  EXPECT_EQ(text, to_text(plan(path, limits)));
}

}  // namespace
}  // namespace passo::test
