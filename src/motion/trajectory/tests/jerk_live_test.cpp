// Hold, resume and override with limited jerk: at any time, within all limits, without a jump.
#include <limits>
#include <numbers>

#include "jerk_kit.hpp"
#include "kit/in_full.hpp"

namespace passo::test {
namespace {

// Plans live and checks all motion that is given.
class LivePlan {
 public:
  LivePlan(const std::vector<PathItem>& path, const MotionLimits& limits, Seconds longest = Seconds(0.005))
      : source_(path), planner_(source_, limits), limits_(limits), longest_(longest) {
    planner_.limit_moves_to(longest);
  }
  Planner& planner() { return planner_; }

  // Takes one move or action. Returns false at the end.
  bool go_on() {
    if (!planner_.next(item_)) return false;
    held_ = false;
    if (auto* move = std::get_if<PlannedMove>(&item_)) {
      EXPECT_LE(move->duration().value(), longest_.value() * 1.1);
      time_ += move->duration();
      speed_ = exit_speed(*move);
      place_ = move->segment.curve.at(move->to);
      // Motion planned under an override may be faster than the present feed.
      move->segment.speed = move->segment.speed * fastest_;
      motion_.push_back(item_);
    } else if (std::get<Action>(item_).kind == Action::Kind::feed_hold) {
      held_ = true;
    } else {
      motion_.push_back(item_);
    }
    return true;
  }
  bool go_on_until(Seconds time) {
    while (time_ < time) {
      if (!go_on()) return false;
    }
    return true;
  }
  void set_feed_override(double factor) {
    planner_.set_feed_override(factor);
    fastest_ = std::max(fastest_, factor);
  }
  bool held() const { return held_; }
  double time() const { return time_.value(); }
  double speed() const { return speed_; }
  void expect_good() { expect_within_limits(motion_, limits_); }
  Point place() const { return place_; }

 private:
  ListSource<PathItem> source_;
  Planner planner_;
  MotionLimits limits_;
  Seconds longest_;
  MotionItem item_;
  std::vector<MotionItem> motion_;
  Seconds time_{0};
  double speed_ = 0;
  Point place_;
  double fastest_ = 1;
  bool held_ = false;
};

// From a speed to rest takes v/a + a/j.
TEST(JerkLimitedHold, on_a_line_comes_to_rest_as_early_as_the_limits_allow) {
  LivePlan plan({line(xyz(0, 0), xyz(100, 0), 50)}, jerk_limits(100, 500, 25'000));
  ASSERT_TRUE(plan.go_on_until(Seconds(1)));
  EXPECT_NEAR(plan.speed(), 50, 0.01);
  const double at = plan.time();
  plan.planner().hold();
  while (!plan.held()) ASSERT_TRUE(plan.go_on());
  EXPECT_NEAR(plan.time() - at, 50.0 / 500 + 500.0 / 25'000, 1e-4);
  plan.planner().resume();
  while (plan.go_on()) {
  }
  EXPECT_NEAR(plan.place()[Axis::x], 100, 1e-9);
  plan.expect_good();
}

// Down to the start-stop velocity, from where the motors stop at once. A slower motion needs no ramp at all.
void expect_stop_from_start_stop_velocity(const MotionLimits& limits, double rise) {
  for (const double feed : {50.0, 5.0}) {
    LivePlan plan({line(xyz(0, 0), xyz(100, 0), feed)}, limits);
    ASSERT_TRUE(plan.go_on_until(Seconds(1)));
    EXPECT_NEAR(plan.speed(), feed, 0.01);
    const double at = plan.time();
    plan.planner().hold();
    while (!plan.held()) ASSERT_TRUE(plan.go_on());
    EXPECT_NEAR(plan.time() - at, feed > 8 ? (feed - 8) / 500 + rise : 0, 1e-4);
    EXPECT_NEAR(plan.speed(), std::min(feed, 8.0), 1e-9);
    plan.planner().resume();
    while (plan.go_on()) {
    }
    EXPECT_NEAR(plan.place()[Axis::x], 100, 1e-9);
  }
}
TEST(JerkLimitedHold, uses_the_start_stop_velocity_on_a_line) {
  MotionLimits limits = jerk_limits(100, 500, 25'000);
  limits.start_stop[Axis::x] = MmPerSecond(8);
  expect_stop_from_start_stop_velocity(limits, 500.0 / 25'000);
  limits.jerk[Axis::x] = MmPerSecond3(0);
  limits.jerk[Axis::y] = MmPerSecond3(0);
  limits.jerk[Axis::z] = MmPerSecond3(0);
  expect_stop_from_start_stop_velocity(limits, 0);
}

// X has no limit of jerk, and turns into Y, which has one. Where X was braking already, its stop left 0.1 mm/s; from
// there the motion jumped back to where the hold had begun.
TEST(JerkLimitedHold, at_any_instant_keeps_the_limits_of_axes_with_and_without_jerk) {
  MotionLimits limits = jerk_limits(50, 200, 4'000);
  limits.jerk[Axis::x] = MmPerSecond3(0);
  const std::vector<PathItem> path =
      smoothed(polyline({xyz(0, 0), xyz(-12, 0), xyz(-12, -13), xyz(2.4, -13), xyz(2.4, 2.4)}, 100));
  const double whole = total_time(test::plan(path, limits));
  const int instants = fewer(60);
  for (int i = 1; i < instants; ++i) {
    SCOPED_TRACE("instant " + std::to_string(i) + " of " + std::to_string(instants));
    LivePlan plan(path, limits);
    ASSERT_TRUE(plan.go_on_until(Seconds(whole * i / instants)));
    const double at = plan.time();
    plan.planner().hold();
    while (!plan.held()) ASSERT_TRUE(plan.go_on());
    EXPECT_LE(plan.time() - at, 50.0 / 200 + 2.5 * 200 / 4'000 + 0.01);
    plan.planner().resume();
    while (plan.go_on()) {
    }
    plan.expect_good();
    if (HasFailure()) return;
  }
}

// The arc ends along X, which has no jerk limit: only X brakes there, and may do so up to the last moment. The last
// cell of a stop takes twice as long as that. If each move were replaced by a sooner one of half the length, the last
// piece would be too short to be divided into cells, and planning would not end.
TEST(JerkLimitedHold, near_the_end_of_an_arc_takes_few_moves) {
  MotionLimits limits = jerk_limits(50, 200, 4'000);
  limits.jerk[Axis::x] = MmPerSecond3(0);
  const Segment arc =
      segment_of(Curve::arc(xyz(0, 0), xyz(10, 10), Axis::x, Axis::y, 10, 0, -std::numbers::pi / 2), 50);
  const double whole = total_time(test::plan({arc}, limits));
  for (double before = 0.5; before > 1e-5; before *= 0.7) {
    SCOPED_TRACE("hold " + std::to_string(before) + " s before the end");
    LivePlan plan({arc}, limits);
    ASSERT_TRUE(plan.go_on_until(Seconds(whole - before)));
    const double at = plan.time();
    plan.planner().hold();
    int moves = 0;
    while (plan.go_on() && !plan.held()) ++moves;
    EXPECT_LE(moves, (plan.time() - at) / 0.004 + 8);
    plan.planner().resume();
    while (plan.go_on()) {
    }
    plan.expect_good();
  }
}

// What is too short to stop in was measured in mm of the path: in the last 0.004 mm, which take 72 s, no hold was
// obeyed.
TEST(JerkLimitedHold, in_a_line_that_mostly_turns_comes_soon) {
  MotionLimits limits = jerk_limits(100, 500, 25'000);
  limits.velocity[Axis::a] = MmPerSecond(10);
  limits.acceleration[Axis::a] = MmPerSecond2(500);
  limits.jerk[Axis::a] = MmPerSecond3(25'000);
  Point end = xyz(0.02, 0);
  end[Axis::a] = 3600;
  for (const double at : {200.0, 300.0, 340.0, 359.9}) {
    LivePlan plan({line(Point(), end, 100)}, limits, Seconds(0.05));
    ASSERT_TRUE(plan.go_on_until(Seconds(at)));
    const double from = plan.time();
    plan.planner().hold();
    while (!plan.held()) ASSERT_TRUE(plan.go_on());
    EXPECT_LE(plan.time() - from, 10.0 / 500 + 500.0 / 25'000 + 0.01) << "hold at " << at;
    plan.planner().resume();
    while (plan.go_on()) {
    }
    plan.expect_good();
  }
}

// Without limits of jerk a stop left a micrometre of a cell, in which A turns by 36 degrees here.
TEST(Hold, in_a_line_that_mostly_turns_comes_soon_without_limits_of_jerk) {
  MotionLimits limits = jerk_limits(100, 500, 0);
  limits.velocity[Axis::a] = MmPerSecond(10);
  limits.acceleration[Axis::a] = MmPerSecond2(500);
  Point end = xyz(0.0001, 0);
  end[Axis::a] = 3600;
  for (const double at : {200.0, 359.0, 359.9}) {
    LivePlan plan({line(Point(), end, 100)}, limits, Seconds(0.05));
    ASSERT_TRUE(plan.go_on_until(Seconds(at)));
    const double from = plan.time();
    plan.planner().hold();
    while (!plan.held()) ASSERT_TRUE(plan.go_on());
    EXPECT_LE(plan.time() - from, 10.0 / 500 + 0.001) << "hold at " << at;
    plan.planner().resume();
    while (plan.go_on()) {
    }
    plan.expect_good();
  }
}

// The acceleration is still at its greatest. It must go to 0 first, which takes 20 ms.
TEST(JerkLimitedHold, while_speeding_up_turns_the_acceleration_round_without_a_jump) {
  LivePlan plan({line(xyz(0, 0), xyz(100, 0), 80)}, jerk_limits(100, 500, 25'000));
  ASSERT_TRUE(plan.go_on_until(Seconds(0.1)));
  const double speed = plan.speed();
  const double at = plan.time();
  plan.planner().hold();
  while (!plan.held()) ASSERT_TRUE(plan.go_on());
  // The acceleration reaches 0 after a/j, at the speed v + a²/2j. From there the hold is as usual.
  EXPECT_NEAR(plan.time() - at, 0.02 + (speed + 5) / 500 + 0.02, 2e-3);
  plan.planner().resume();
  while (plan.go_on()) {
  }
  plan.expect_good();
}

TEST(JerkLimitedHold, on_a_circle_takes_little_longer_than_on_a_line) {
  const Curve circle = Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, 20, 0, 6.283185307179586);
  LivePlan plan({segment_of(circle, 60)}, jerk_limits(100, 500, 25'000));
  ASSERT_TRUE(plan.go_on_until(Seconds(0.6)));
  const double at = plan.time();
  plan.planner().hold();
  while (!plan.held()) ASSERT_TRUE(plan.go_on());
  EXPECT_LE(plan.time() - at, 1.5 * (60.0 / 500 + 0.02));
  plan.planner().resume();
  while (plan.go_on()) {
  }
  plan.expect_good();
}

TEST(JerkLimitedHold, that_is_resumed_while_braking_speeds_up_again_without_a_rest) {
  LivePlan plan({line(xyz(0, 0), xyz(100, 0), 80)}, jerk_limits(100, 500, 25'000));
  ASSERT_TRUE(plan.go_on_until(Seconds(0.5)));
  plan.planner().hold();
  ASSERT_TRUE(plan.go_on_until(Seconds(0.57)));
  EXPECT_LT(plan.speed(), 65);
  plan.planner().resume();
  const double from = plan.time();
  while (plan.time() < from + 0.2) {
    ASSERT_TRUE(plan.go_on());
    EXPECT_GT(plan.speed(), 30);
    EXPECT_FALSE(plan.held());
  }
  EXPECT_NEAR(plan.speed(), 80, 0.1);
  while (plan.go_on()) {
  }
  plan.expect_good();
}

TEST(JerkLimitedOverride, counts_at_once_both_ways) {
  LivePlan plan({line(xyz(0, 0), xyz(300, 0), 40)}, jerk_limits(100, 500, 25'000));
  for (const double factor : {0.5, 2.0, 0.01, 1.0, 0.3}) {
    plan.set_feed_override(factor);
    const double from = plan.time();
    ASSERT_TRUE(plan.go_on_until(Seconds(from + 80.0 / 500 + 0.1)));
    EXPECT_NEAR(plan.speed(), 40 * factor, 0.01 + 0.001 * 40 * factor);
  }
  while (plan.go_on()) {
  }
  plan.expect_good();
}

TEST(JerkLimitedOverride, during_a_hold_counts_from_the_resume_on) {
  LivePlan plan({line(xyz(0, 0), xyz(100, 0), 60)}, jerk_limits(100, 500, 25'000));
  ASSERT_TRUE(plan.go_on_until(Seconds(0.4)));
  plan.planner().hold();
  ASSERT_TRUE(plan.go_on_until(Seconds(0.45)));
  plan.set_feed_override(0.5);
  while (!plan.held()) ASSERT_TRUE(plan.go_on());
  plan.planner().resume();
  ASSERT_TRUE(plan.go_on_until(Seconds(plan.time() + 0.3)));
  EXPECT_NEAR(plan.speed(), 30, 0.05);
  while (plan.go_on()) {
  }
  plan.expect_good();
}

// As in a job: lines and arcs.
std::vector<PathItem> corners(Random& random, int pieces) {
  std::vector<PathItem> path;
  Point at;
  for (int i = 0; i < pieces; ++i) {
    const double speed = std::exp(random.between(1, 4.5));
    const Point way = xyz(random.between(-5, 5), random.between(-5, 5), random.chance(0.3) ? random.between(-1, 1) : 0);
    if (random.chance(0.3)) {
      const double sweep = random.between(-6, 6);
      const Point center = at + way;
      const double radius = std::hypot(way[Axis::x], way[Axis::y]);
      const double angle = std::atan2(-way[Axis::y], -way[Axis::x]) + sweep;
      const Point end =
          xyz(center[Axis::x] + radius * std::cos(angle), center[Axis::y] + radius * std::sin(angle), at[Axis::z]);
      path.emplace_back(
          segment_of(Curve::arc(at, end, Axis::x, Axis::y, center[Axis::x], center[Axis::y], sweep), speed));
      at = end;
    } else {
      path.emplace_back(line(at, at + way, speed));
      at = at + way;
    }
    if (random.chance(0.05)) path.emplace_back(Action{.kind = Action::Kind::dwell});
  }
  return path;
}

class JerkLimitedMeddling : public testing::TestWithParam<int> {
 protected:
  // All of the path is played, in order, whatever was asked for in between.
  void meddle(const std::vector<PathItem>& path, const MotionLimits& limits) {
    const std::vector<MotionItem> undisturbed = test::plan(path, limits);
    expect_within_limits(undisturbed, limits);
    if (HasFatalFailure()) return;
    const double whole = total_time(undisturbed);
    LivePlan plan(path, limits, Seconds(whole / (random_.chance(0.5) ? 300 : 2000)));
    bool holding = false;
    while (plan.go_on()) {
      if (plan.held()) {
        ASSERT_TRUE(holding);
        ASSERT_EQ(plan.speed() < 1e-6, true);
        ++rests_;
        if (random_.chance(0.3)) plan.set_feed_override(random_.between(0.05, 2));
        plan.planner().resume();
        holding = false;
        continue;
      }
      if (!holding && random_.chance(0.02)) {
        plan.planner().hold();
        ++holds_;
        holding = true;
      } else if (holding && random_.chance(0.03)) {
        plan.planner().resume();
        holding = false;
      }
      if (random_.chance(0.02)) plan.set_feed_override(random_.chance(0.3) ? 1 : random_.between(0.05, 2));
    }
    plan.expect_good();
    for (auto item = path.rbegin(); item != path.rend(); ++item) {
      const auto* segment = std::get_if<Segment>(&*item);
      if (segment == nullptr) continue;
      for (const Axis axis : all_axes) ASSERT_NEAR(plan.place()[axis], segment->curve.end()[axis], 1e-9);
      break;
    }
  }
  void SetUp() override {
    for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  }
  Random random_;
  int holds_ = 0;
  int rests_ = 0;
};

TEST_P(JerkLimitedMeddling, keeps_limits_of_jerk_on_some_axes_only) {
  for (int n = 0; n < 2; ++n) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()) + ", path " + std::to_string(n));
    const std::vector<PathItem> path = n % 2 == 0 ? smooth_chain(random_, 50) : smoothed(corners(random_, 40));
    meddle(path, draw_mixed_limits(random_));
    if (HasFatalFailure()) return;
  }
  std::printf("%d holds, %d rests\n", holds_, rests_);
}

TEST_P(JerkLimitedMeddling, keeps_every_axis_within_its_limits_on_smooth_chains) {
  for (int n = 0; n < 3; ++n) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()) + ", path " + std::to_string(n));
    const std::vector<PathItem> path = smooth_chain(random_, 50);
    meddle(path, draw_jerk_limits(random_));
    if (HasFatalFailure()) return;
  }
  std::printf("%d holds, %d rests\n", holds_, rests_);
}

// Rounded within a hundredth of a millimetre.
TEST_P(JerkLimitedMeddling, keeps_every_axis_within_its_limits_on_lines_arcs_and_blends) {
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random_.seed()));
  meddle(smoothed(corners(random_, 40)), draw_jerk_limits(random_));
  std::printf("%d holds, %d rests\n", holds_, rests_);
}

INSTANTIATE_TEST_SUITE_P(Seeds, JerkLimitedMeddling, testing::Range(0, fewer(5)));

}  // namespace
}  // namespace passo::test
