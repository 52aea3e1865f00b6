// Braking plans from every place: within all limits, and asking for one changes nothing. And a limit of the speed,
// which acts like a lower feed, for rapids too.
#include "jerk_kit.hpp"
#include "kit/in_full.hpp"

namespace passo::test {
namespace {

// The parameter is what is added to the given seed.
class BrakingPlan : public testing::TestWithParam<int> {
 protected:
  BrakingPlan() : BrakingPlan(Random(seed() + static_cast<std::uint64_t>(GetParam()))) {}
  explicit BrakingPlan(const Random& random) : random_(random) {}

  // Asks one planner after every move, and another planner never.
  void brake_everywhere(const std::vector<PathItem>& path, const MotionLimits& limits, Planner::Braking how) {
    ListSource<PathItem> source(path);
    ListSource<PathItem> same(path);
    Planner asked(source, limits);
    Planner other(same, limits);
    for (Planner* planner : {&asked, &other}) planner->limit_moves_to(Seconds(0.005));
    MotionLimits limits_of_brakes = limits;
    if (how == Planner::Braking::hard) limits_of_brakes.jerk = {};
    JerkOracle oracle(limits_of_brakes);
    MotionItem item;
    MotionItem undisturbed;
    std::vector<PlannedMove> plan;
    while (asked.next(item)) {
      ASSERT_TRUE(other.next(undisturbed));
      ASSERT_EQ(passo::to_text(item), passo::to_text(undisturbed));
      oracle.watch(item);
      if (HasFatalFailure()) return;
      if (!std::holds_alternative<PlannedMove>(item)) continue;
      asked.braking_plan(plan, how);
      ++plans_;
      for (const PlannedMove& move : plan) longest_move_ = std::max(longest_move_, move.duration().value());
      if (plans_ % 11 != 0) continue;
      SCOPED_TRACE("braking behind move " + std::to_string(plans_));
      JerkOracle(oracle).check({plan.begin(), plan.end()});
      if (HasFatalFailure()) return;
    }
    ASSERT_FALSE(other.next(undisturbed));
  }

  Random random_;
  int plans_ = 0;
  double longest_move_ = 0;
};

TEST_P(BrakingPlan, keeps_every_axis_within_its_limits_on_smooth_chains) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  const std::vector<PathItem> path = smooth_chain(random_, 40);
  brake_everywhere(path, draw_jerk_limits(random_), Planner::Braking::gentle);
  EXPECT_GT(plans_, 20);
}

TEST_P(BrakingPlan, that_is_hard_keeps_velocities_and_accelerations) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  const std::vector<PathItem> path = smooth_chain(random_, 40);
  brake_everywhere(path, draw_jerk_limits(random_), Planner::Braking::hard);
  EXPECT_GT(plans_, 20);
}

// The parameter is the seed itself.
class BrakingPlanThatOnceFailed : public BrakingPlan {
 protected:
  BrakingPlanThatOnceFailed() : BrakingPlan(Random::of(static_cast<std::uint64_t>(GetParam()))) {}
};

// Paths with blends, and with corners where the motion rests or crawls.
std::vector<PathItem> lines_and_blends(Random& random) {
  std::vector<PathItem> path;
  Point at;
  for (int i = 0; i < 12; ++i) {
    const double speed = std::exp(random.between(2, 4.5));
    const double along = random.between(-5, 5);
    const double across = random.between(-5, 5);
    const Point to = at + xyz(along, across, random.chance(0.3) ? random.between(-1, 1) : 0);
    path.emplace_back(line(at, to, speed));
    at = to;
  }
  return smoothed(path);
}

TEST_P(BrakingPlan, keeps_every_axis_within_its_limits_on_lines_and_blends) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  const std::vector<PathItem> path = lines_and_blends(random_);
  brake_everywhere(path, draw_jerk_limits(random_), Planner::Braking::gentle);
  EXPECT_GT(plans_, 20);
  EXPECT_LE(longest_move_, 0.0055);
}

TEST_P(BrakingPlan, keeps_limits_of_jerk_on_some_axes_only) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  brake_everywhere(smooth_chain(random_, 10), draw_mixed_limits(random_), Planner::Braking::gentle);
  EXPECT_GT(plans_, 20);
}

TEST_P(BrakingPlan, that_is_hard_keeps_velocities_and_accelerations_on_lines_and_blends) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  const std::vector<PathItem> path = lines_and_blends(random_);
  brake_everywhere(path, draw_jerk_limits(random_), Planner::Braking::hard);
  EXPECT_GT(plans_, 20);
}

// A hard way went faster than the feed, rose above the velocity of an axis, or asked for more than its acceleration.
TEST_P(BrakingPlanThatOnceFailed, keeps_velocities_and_accelerations) {
  const std::vector<PathItem> path = lines_and_blends(random_);
  brake_everywhere(path, draw_jerk_limits(random_), Planner::Braking::hard);
  EXPECT_GT(plans_, 20);
}

// What is left of the motion after a hold.
double time_to_rest(Planner& planner) {
  double time = 0;
  MotionItem item;
  while (planner.next(item) && std::holds_alternative<PlannedMove>(item))
    time += std::get<PlannedMove>(item).duration().value();
  return time;
}

// Both brake cell by cell. If a hold is given in short moves, the rest of a cell is cut anew after each of them. A
// shorter cell leaves more room, so such a hold is rarely the longer one.
TEST_P(BrakingPlan, without_limits_of_jerk_takes_as_long_as_a_hold) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  const std::vector<PathItem> path = smooth_chain(random_, 40);
  MotionLimits limits = draw_jerk_limits(random_);
  for (const Axis axis : all_axes) limits.jerk[axis] = MmPerSecond3(0);
  for (const bool in_short_moves : {false, true}) {
    ListSource<PathItem> source(path);
    Planner planner(source, limits);
    planner.limit_moves_to(Seconds(0.005));
    MotionItem item;
    for (int i = 0; i < 30 && planner.next(item); ++i) {
    }
    std::vector<PlannedMove> plan;
    planner.braking_plan(plan);
    if (!in_short_moves) planner.limit_moves_to(Seconds(std::numeric_limits<double>::infinity()));
    planner.hold();
    double planned = 0;
    for (const PlannedMove& move : plan) planned += move.duration().value();
    const double held = time_to_rest(planner);
    if (in_short_moves) {
      EXPECT_LE(held, planned * 1.001);
      EXPECT_GE(held, planned * 0.9);
    } else {
      EXPECT_NEAR(held, planned, planned * 1e-9);
    }
  }
}

TEST(HardBraking, comes_to_rest_as_soon_as_without_limits_of_jerk) {
  const std::vector<PathItem> path{line(xyz(0, 0), xyz(200, 0), 50)};
  ListSource<PathItem> source(path);
  Planner planner(source, jerk_limits(100, 500, 2'000));  // a hold would take 0.35 s
  planner.limit_moves_to(Seconds(0.005));
  MotionItem item;
  double time = 0;
  std::vector<PlannedMove> plan;
  while (time < 2 && planner.next(item)) time += std::get<PlannedMove>(item).duration().value();
  planner.braking_plan(plan, Planner::Braking::hard);
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_NEAR(plan.front().duration().value(), 0.1, 1e-9);
  EXPECT_TRUE(plan.front().ends_at_rest());
}

// On a circle that is passed as fast as the limits allow, some axis has nothing left for braking in most places. But a
// moment later another place, or a little less speed, leaves room. In the last case only the latter helps. Changes of
// one strength went round to the end, and changes in steps took up to twice as long.
TEST(GentleBraking, comes_to_rest_soon_on_a_circle_at_the_limits) {
  struct Case {
    double radius, velocity, acceleration, jerk;
    double most;  // times a straight line and a quarter of a turn
  };
  for (const Case& one :
       {Case{8, 500, 800, 10'000, 1.15}, Case{20, 500, 800, 10'000, 1.05}, Case{8, 500, 800, 500'000, 0.9}}) {
    const double sweep = 16 * std::numbers::pi;
    const std::vector<PathItem> path{
        segment_of(Curve::arc(xyz(one.radius, 0), xyz(one.radius, 0), Axis::x, Axis::y, 0, 0, sweep), one.velocity)};
    const MotionLimits limits = jerk_limits(one.velocity, one.acceleration, one.jerk);
    ListSource<PathItem> source(path);
    Planner planner(source, limits);
    planner.limit_moves_to(Seconds(0.005));
    std::vector<MotionItem> motion;
    std::vector<PlannedMove> plan;
    double worst = 0;
    double longest = 0;
    MotionItem item;
    while (planner.next(item)) {
      motion.push_back(item);
      if (motion.size() % 10 != 0) continue;
      const double speed = exit_speed(std::get<PlannedMove>(item));
      planner.braking_plan(plan);
      double time = 0;
      for (const PlannedMove& move : plan) time += move.duration().value();
      longest = std::max(longest, time);
      // On a straight line along an axis; and a quarter of a turn.
      const double straight = speed / one.acceleration + one.acceleration / one.jerk;
      const double quarter = std::numbers::pi / 2 * one.radius / std::max(speed, 1.0);
      if (speed > one.velocity / 20) worst = std::max(worst, time / (straight + quarter));
      if (motion.size() % 50 != 0) continue;
      std::vector<MotionItem> braked = motion;
      braked.insert(braked.end(), plan.begin(), plan.end());
      expect_within_limits(braked, limits);
      if (testing::Test::HasFatalFailure()) return;
    }
    std::printf("R %g: %.3f s, %.3f times a straight line and a quarter of a turn\n", one.radius, longest, worst);
    EXPECT_LT(worst, one.most) << "radius " << one.radius << ", jerk " << one.jerk;
  }
}

// Here jerk alone bounds the whole arc. Neither a change of one strength nor one in steps leads to rest, and a plan
// that got ever slower took 1.7 s. The soonest stop takes 0.6 to 0.9 s.
TEST(Hold, comes_to_rest_on_an_arc_that_uses_up_the_jerk) {
  const double sweep = 24 * std::numbers::pi;
  const std::vector<PathItem> path{segment_of(Curve::arc(xyz(30, 0), xyz(30, 0), Axis::x, Axis::y, 0, 0, sweep), 500)};
  const MotionLimits limits = jerk_limits(500, 3'000, 20'000);
  for (const double begin : {0.4, 0.9, 1.4, 1.43, 1.47}) {
    ListSource<PathItem> source(path);
    Planner planner(source, limits);
    planner.limit_moves_to(Seconds(0.005));
    std::vector<MotionItem> motion;
    double time = 0;
    MotionItem item;
    while (planner.next(item) && std::holds_alternative<PlannedMove>(item)) {
      motion.push_back(item);
      time += std::get<PlannedMove>(item).duration().value();
      if (time > begin) planner.hold();
    }
    EXPECT_TRUE(std::holds_alternative<Action>(item) && std::get<Action>(item).kind == Action::Kind::feed_hold);
    std::printf("held at %g s: rests %.3f s later\n", begin, time - begin);
    EXPECT_LT(time - begin, 0.9);
    expect_within_limits(motion, limits);
  }
}

TEST_P(BrakingPlan, knows_a_limit_of_the_speed_for_feeds_and_rapids) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  std::vector<PathItem> path{line(xyz(0, 0), xyz(40, 0), 50), line(xyz(40, 0), xyz(40, 40), 50)};
  std::get<Segment>(path[1]).rapid = true;
  std::get<Segment>(path[1]).speed = MmPerSecond(std::numeric_limits<double>::infinity());
  for (const double jerk : {0.0, 25'000.0}) {
    ListSource<PathItem> source(path);
    Planner planner(source, jerk_limits(100, 500, jerk));
    planner.limit_moves_to(Seconds(0.005));
    const double limit = random_.between(5, 30);
    const double change = random_.between(0.3, 0.6);
    double fastest = 0;
    double time = 0;
    MotionItem item;
    while (planner.next(item)) {
      const auto& move = std::get<PlannedMove>(item);
      time += move.duration().value();
      fastest = std::max(fastest, exit_speed(move));
      if (time < change) continue;
      planner.limit_speed_to(MmPerSecond(limit));
      // The time to brake from 50, and some more.
      if (time < change + 0.2) continue;
      EXPECT_LE(exit_speed(move), limit * (1 + 1e-6)) << "jerk " << jerk;
    }
    EXPECT_NEAR(fastest, 50, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BrakingPlan, testing::Range(0, fewer(3)));
// PASSO_SEED is added twice, so PASSO_SEED=27 has the seeds 54 to 56. Left out is 26, which takes seven seconds.
INSTANTIATE_TEST_SUITE_P(Seeds, BrakingPlanThatOnceFailed,
                         testing::Values(24, 25, 27, 28, 32, 33, 34, 36, 52, 53, 54, 55, 56, 144, 145, 146));

}  // namespace
}  // namespace passo::test
