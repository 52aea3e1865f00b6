// Axes that start and stop at a velocity of their own: closed forms, and random programs with holds.
#include <numbers>

#include "planner_kit.hpp"
#include "random_program.hpp"

namespace passo::test {
namespace {

MotionLimits limits_with(double start_stop, double velocity = 100, double acceleration = 500) {
  MotionLimits limits = equal_limits(velocity, acceleration);
  for (const Axis axis : all_axes) limits.start_stop[axis] = MmPerSecond(start_stop);
  return limits;
}

// From one speed to another, from there on, and back.
double seconds_of(double way, double rest, double top, double acceleration) {
  const double ramp = (top * top - rest * rest) / (2 * acceleration);
  return 2 * (top - rest) / acceleration + (way - 2 * ramp) / top;
}

TEST(StartStop, a_feed_below_it_is_one_phase_of_that_speed) {
  const auto motion = plan(polyline({xyz(0, 0), xyz(0.5, 0)}, 4), limits_with(5));
  ASSERT_EQ(motion.size(), 1U);
  const auto& move = std::get<PlannedMove>(motion[0]);
  ASSERT_EQ(move.phase_count, 1U);
  EXPECT_EQ(entry_speed(move), 4);
  EXPECT_EQ(exit_speed(move), 4);
  EXPECT_EQ(move.duration().value(), 0.5 / 4);
}

TEST(StartStop, a_longer_move_saves_the_ramps_below_it) {
  const std::vector<PathItem> path = polyline({xyz(0, 0), xyz(30, 0)}, 50);
  const auto motion = plan(path, limits_with(8));
  EXPECT_EQ(entry_speed(std::get<PlannedMove>(motion.front())), 8);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion.back())), 8, 1e-12);
  EXPECT_NEAR(total_time(motion), seconds_of(30, 8, 50, 500), 1e-12);
  EXPECT_NEAR(total_time(plan(path, limits_with(0))), seconds_of(30, 0, 50, 500), 1e-12);
}

TEST(StartStop, the_slowest_axis_of_a_diagonal_counts) {
  MotionLimits limits = limits_with(8);
  limits.start_stop[Axis::y] = MmPerSecond(3);
  const auto motion = plan(polyline({xyz(0, 0), xyz(40, 30)}, 50), limits);
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion.front())), 3 / 0.6, 1e-12);
  EXPECT_NEAR(total_time(motion), seconds_of(50, 3 / 0.6, 50, 500 / 0.8), 1e-12);
  limits.start_stop[Axis::y] = MmPerSecond(0);
  EXPECT_EQ(entry_speed(std::get<PlannedMove>(plan(polyline({xyz(0, 0), xyz(40, 30)}, 50), limits).front())), 0);
}

TEST(StartStop, an_arc_begins_and_ends_along_its_tangents) {
  MotionLimits limits = limits_with(6);
  limits.start_stop[Axis::y] = MmPerSecond(2);
  Segment quarter = line(xyz(10, 0), xyz(0, 10), 40);
  quarter.curve = Curve::arc(xyz(10, 0), xyz(0, 10), Axis::x, Axis::y, 0, 0, std::numbers::pi / 2);
  const auto motion = plan({quarter}, limits);
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion.front())), 2, 1e-9);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion.back())), 6, 1e-9);
  EXPECT_LT(total_time(motion), total_time(plan({quarter}, limits_with(0))));
}

// No axis's velocity may jump by more. Turning back, an axis would jump by twice the speed.
TEST(StartStop, a_corner_is_passed_where_no_axis_jumps_by_more) {
  const auto speed_at_corner = [](const Point& end) {
    return exit_speed(std::get<PlannedMove>(plan(polyline({xyz(0, 0), xyz(20, 0), end}, 50), limits_with(8))[0]));
  };
  EXPECT_NEAR(speed_at_corner(xyz(20, 20)), 8, 1e-12);
  EXPECT_NEAR(speed_at_corner(xyz(0, 0)), 4, 1e-12);
  EXPECT_NEAR(speed_at_corner(xyz(20 - 8, 6)), 4, 1e-12);
}

// X stops at its own velocity and Y starts at its own.
TEST(StartStop, each_side_of_a_corner_has_its_own_speed) {
  MotionLimits limits = limits_with(8);
  for (const double own : {0.0, 3.0}) {
    limits.start_stop[Axis::y] = MmPerSecond(own);
    const auto motion = plan(polyline({xyz(0, 0), xyz(20, 0), xyz(20, 20), xyz(40, 20)}, 50), limits);
    ASSERT_EQ(motion.size(), 3U);
    EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion[0])), 8, 1e-12);
    EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[1])), own, 1e-12);
    EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion[1])), own, 1e-12);
    EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[2])), 8, 1e-12);
    EXPECT_NEAR(total_time(motion), 2 * seconds_of(20, 8, 50, 500) + seconds_of(20, own, 50, 500), 1e-12);
  }
}

TEST(StartStop, exact_stops_slow_down_to_it_only) {
  std::vector<PathItem> path = polyline({xyz(0, 0), xyz(20, 0), xyz(40, 0)}, 50);
  std::get<Segment>(path[0]).mode = PathMode::exact_stop;
  const auto motion = plan(path, limits_with(8));
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion[0])), 8, 1e-12);
  EXPECT_NEAR(total_time(motion), 2 * seconds_of(20, 8, 50, 500), 1e-12);
}

// An action may take no time, so the motors would turn back at twice the velocity.
TEST(StartStop, after_an_action_an_axis_that_turns_back_starts_from_rest) {
  for (const auto& [end, speed] : {std::pair(xyz(10, 0), 0.0), std::pair(xyz(30, 0), 8.0)}) {
    std::vector<PathItem> path = polyline({xyz(0, 0), xyz(20, 0)}, 50);
    path.emplace_back(Action{.kind = Action::Kind::dwell});
    path.emplace_back(line(xyz(20, 0), end, 50));
    const auto motion = plan(path, limits_with(8));
    EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[2])), speed, 1e-12);
  }
}

TEST(StartStop, a_lowered_feed_counts_at_rests_too) {
  ListSource<PathItem> source(polyline({xyz(0, 0), xyz(20, 0)}, 50));
  Planner planner(source, limits_with(8));
  planner.set_feed_override(0.1);
  const auto motion = drain(planner);
  EXPECT_NEAR(total_time(motion), 20 / 5.0, 1e-12);
}

TEST(StartStop, a_motion_goes_on_with_it_after_a_hold) {
  ListSource<PathItem> source(polyline({xyz(0, 0), xyz(60, 0)}, 50));
  Planner planner(source, limits_with(8));
  planner.limit_moves_to(Seconds(0.05));
  MotionItem item;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(planner.next(item));
  planner.hold();
  std::vector<PlannedMove> plan;
  planner.braking_plan(plan);
  double rest = 0;
  while (planner.next(item) && std::holds_alternative<PlannedMove>(item)) rest = std::get<PlannedMove>(item).to.value();
  // The hold stops at once from 8 mm/s, the stop ramp brakes to 0.
  EXPECT_NEAR(plan.back().to.value(), rest + 8.0 * 8 / (2 * 500), 1e-9);
  ASSERT_EQ(std::get<Action>(item).kind, Action::Kind::feed_hold);
  planner.resume();
  ASSERT_TRUE(planner.next(item));
  EXPECT_EQ(std::get<PlannedMove>(item).from().value(), rest);
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(item)), 8, 1e-12);
}

// The hold comes so late that the path ends first.
TEST(StartStop, a_hold_may_end_at_the_end_of_the_path) {
  ListSource<PathItem> source(polyline({xyz(0, 0), xyz(1, 0)}, 4));
  Planner planner(source, limits_with(1));
  planner.limit_moves_to(Seconds(0.05));
  MotionItem item;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(planner.next(item));
  ASSERT_GT(std::get<PlannedMove>(item).to.value(), 0.9);
  planner.hold();
  std::vector<PlannedMove> plan;
  planner.braking_plan(plan);
  EXPECT_LE(plan.back().to.value(), 1);
  double end = 0;
  while (planner.next(item) && std::holds_alternative<PlannedMove>(item)) end = std::get<PlannedMove>(item).to.value();
  EXPECT_GT(end, 0.98);
  EXPECT_LE(end, plan.back().to.value() + 1e-12);
}

MotionLimits jerky(double start_stop, double jerk) {
  MotionLimits limits = limits_with(start_stop);
  for (const Axis axis : all_axes) limits.jerk[axis] = MmPerSecond3(jerk);
  return limits;
}

// With jerk limits: from one speed to another with trapezoids of the acceleration, from there on, and back.
double seconds_with_jerk(double way, double rest, double top, double acceleration, double jerk) {
  const double ramp = (top - rest) / acceleration + acceleration / jerk;
  return 2 * ramp + (way - ramp * (top + rest)) / top;
}

TEST(StartStop, with_jerk_limits_a_motion_begins_and_ends_with_it_too) {
  const auto motion = plan(polyline({xyz(0, 0), xyz(30, 0)}, 50), jerky(8, 25'000));
  EXPECT_EQ(entry_speed(std::get<PlannedMove>(motion.front())), 8);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion.back())), 8, 1e-9);
  EXPECT_NEAR(total_time(motion), seconds_with_jerk(30, 8, 50, 500, 25'000), 1e-9);
  const auto slow = plan(polyline({xyz(0, 0), xyz(0.5, 0)}, 4), jerky(5, 25'000));
  EXPECT_NEAR(total_time(slow), 0.5 / 4, 1e-12);
}

// X stops at its own velocity and Y starts at its own. An axis that reverses shares its velocity between both ways.
TEST(StartStop, with_jerk_limits_each_side_of_a_corner_has_its_own_speed) {
  MotionLimits limits = jerky(8, 25'000);
  limits.start_stop[Axis::y] = MmPerSecond(3);
  const auto motion = plan(polyline({xyz(0, 0), xyz(20, 0), xyz(20, 20), xyz(40, 20)}, 50), limits);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion[0])), 8, 1e-9);
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[1])), 3, 1e-9);
  EXPECT_NEAR(total_time(motion),
              2 * seconds_with_jerk(20, 8, 50, 500, 25'000) + seconds_with_jerk(20, 3, 50, 500, 25'000), 1e-9);
  const auto back = plan(polyline({xyz(0, 0), xyz(20, 0), xyz(0, 0)}, 50), limits);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(back[0])), 4, 1e-9);
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(back[1])), 4, 1e-9);
}

// Two lines that a curve joins, so that cells are planned: the lift finds the speed but for a thousandth. A hold brakes
// to a stop, and the motion goes on with it.
TEST(StartStop, with_jerk_limits_a_path_of_several_segments_begins_with_it) {
  const std::vector<PathItem> path = polyline({xyz(0, 0), xyz(20, 0), xyz(40, 0)}, 50);
  const auto motion = plan(path, jerky(8, 25'000));
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion.front())), 8, 0.01);
  EXPECT_NEAR(exit_speed(std::get<PlannedMove>(motion.back())), 8, 0.01);
  EXPECT_NEAR(total_time(motion), seconds_with_jerk(40, 8, 50, 500, 25'000), 2e-3);
  ListSource<PathItem> source(path);
  Planner planner(source, jerky(8, 25'000));
  planner.limit_moves_to(Seconds(0.05));
  MotionItem item;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(planner.next(item));
  planner.hold();
  while (planner.next(item) && std::holds_alternative<PlannedMove>(item)) {
  }
  ASSERT_EQ(std::get<Action>(item).kind, Action::Kind::feed_hold);
  planner.resume();
  ASSERT_TRUE(planner.next(item));
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(item)), 8, 0.01);
}

// Whether the velocity of every axis jumps only where the path rests, and there by no more than it may.
void expect_fair_jumps(const std::vector<MotionItem>& motion, const MotionLimits& limits) {
  PerAxis<Real> velocity;
  bool rests = true;
  const auto meet = [&](const PerAxis<Real>& next) {
    for (const Axis axis : all_axes) {
      const Real jump = std::abs(next[axis] - velocity[axis]);
      const Real rounding = 3e-6L * limits.velocity[axis].value();
      if (jump <= rounding) continue;
      ASSERT_TRUE(rests) << letter_of(axis) << " jumps by " << double(jump);
      const Real most = std::max({jump, std::abs(next[axis]), std::abs(velocity[axis])});
      ASSERT_LE(most, limits.start_stop[axis].value() * (1 + 1e-6L) + rounding) << letter_of(axis);
    }
  };
  for (const MotionItem& item : motion) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) {
      rests = true;
      meet({});
      velocity = {};
      continue;
    }
    SCOPED_TRACE(passo::to_text(*move));
    rests = rests || move->from() == Mm(0);
    for (const Phase& phase : *move) {
      meet(motion_at(move->segment.curve, phase.start.value(), phase.velocity.value(), 0).velocity);
      if (testing::Test::HasFatalFailure()) return;
      const Phase end = phase.after(phase.duration);
      velocity = motion_at(move->segment.curve, end.start.value(), end.velocity.value(), 0).velocity;
      rests = false;
    }
  }
}

class RandomStarts : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    limits_ = random_limits(random_);
    still_ = limits_;
    for (const Axis axis : all_axes) {
      if (random_.chance(0.8)) limits_.start_stop[axis] = limits_.velocity[axis] * random_.between(0.01, 0.3);
    }
    path_ = smoothed(RandomProgram(random_).draw(300));
  }
  std::string seed() const { return "PASSO_SEED=" + std::to_string(random_.seed()); }

  Random random_{static_cast<std::uint64_t>(GetParam() + 4000)};
  MotionLimits limits_;
  MotionLimits still_;
  std::vector<PathItem> path_;
};

TEST_P(RandomStarts, keep_all_limits_and_save_time) {
  SCOPED_TRACE(seed());
  const std::vector<MotionItem> motion = plan(path_, limits_);
  for (const MotionItem& item : motion) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) expect_within_limits(*move, limits_);
    if (HasFatalFailure()) return;
  }
  expect_fair_jumps(motion, limits_);
  EXPECT_LT(total_time(motion), total_time(plan(path_, still_)) * 1.0001);
}

TEST_P(RandomStarts, keep_all_limits_in_holds_and_with_overrides) {
  SCOPED_TRACE(seed());
  ListSource<PathItem> source(path_);
  Planner planner(source, limits_, 300);
  planner.limit_moves_to(Seconds(0.05));
  std::vector<MotionItem> motion;
  MotionItem item;
  bool holds = false;
  std::size_t segments = 0;
  for (;;) {
    if (!holds && random_.chance(0.02)) {
      holds = true;
      planner.hold();
    } else if (random_.chance(0.02)) {
      planner.set_feed_override(std::exp(random_.between(-2, 0)));
    }
    if (!planner.next(item)) break;
    motion.push_back(item);
    if (const auto* move = std::get_if<PlannedMove>(&item)) {
      expect_within_limits(*move, limits_);
      if (HasFatalFailure()) return;
      if (move->to == move->segment.curve.length()) ++segments;
    } else if (std::get<Action>(item).kind == Action::Kind::feed_hold) {
      holds = false;
      planner.resume();
    }
  }
  expect_fair_jumps(motion, limits_);
  const auto is_segment = [](const PathItem& part) { return std::holds_alternative<Segment>(part); };
  EXPECT_EQ(segments, static_cast<std::size_t>(std::ranges::count_if(path_, is_segment)));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomStarts, testing::Range(1, 13));

}  // namespace
}  // namespace passo::test
