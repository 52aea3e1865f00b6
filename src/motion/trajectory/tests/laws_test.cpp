// What the planner does alike under every law of speed: moves of limited time, restarts, dropped paths, feeds.
#include <limits>
#include <optional>
#include <string>

#include "../shorten.hpp"
#include "jerk_kit.hpp"

namespace passo::test {
namespace {

class BothLaws : public testing::TestWithParam<double> {
 protected:
  MotionLimits limits() const { return jerk_limits(100, 500, GetParam()); }
};

Action spindle_on() {
  return {.kind = Action::Kind::outputs,
          .outputs = {.spindle = SpindleDirection::clockwise, .revolutions_per_minute = 8000}};
}

bool is_hold(const MotionItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr && action->kind == Action::Kind::feed_hold;
}

TEST_P(BothLaws, give_no_move_that_takes_longer_than_allowed) {
  Random random(7);
  ListSource<PathItem> source(smooth_chain(random, 40));
  Planner planner(source, limits());
  const Seconds longest(0.005);
  planner.limit_moves_to(longest);
  std::size_t cut = 0;
  for (MotionItem item; planner.next(item);) {
    const auto& move = std::get<PlannedMove>(item);
    EXPECT_LE(move.duration().value(), longest.value() * (1 + 1e-12));
    if (move.to < move.segment.curve.length()) ++cut;
  }
  EXPECT_GT(cut, 10U);
}

TEST_P(BothLaws, know_the_outputs_after_a_restart) {
  ListSource<PathItem> source({line(xyz(0, 0), xyz(10, 0), 50), spindle_on(), line(xyz(10, 0), xyz(20, 0), 50)});
  Planner planner(source, limits());
  MotionItem item;
  while (planner.next(item) && !std::holds_alternative<Action>(item)) {
  }
  planner.restart();
  planner.hold();
  ASSERT_TRUE(planner.next(item));
  ASSERT_TRUE(is_hold(item));
  EXPECT_EQ(std::get<Action>(item).outputs, spindle_on().outputs);
}

TEST_P(BothLaws, drop_the_path_up_to_the_action) {
  ListSource<PathItem> source({line(xyz(0, 0), xyz(100, 0), 50), line(xyz(100, 0), xyz(200, 0), 50), spindle_on(),
                               line(xyz(200, 0), xyz(210, 0), 50)});
  Planner planner(source, limits());
  planner.limit_moves_to(Seconds(0.01));
  MotionItem item;
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(planner.next(item));
  planner.hold();
  while (planner.next(item) && !is_hold(item)) {
  }
  planner.drop_to_action();
  planner.resume();
  ASSERT_TRUE(planner.next(item));
  ASSERT_TRUE(std::holds_alternative<Action>(item));
  EXPECT_EQ(std::get<Action>(item).kind, Action::Kind::outputs);
  ASSERT_TRUE(planner.next(item));
  EXPECT_EQ(std::get<PlannedMove>(item).segment.curve.start(), xyz(200, 0));
}

// Override, adaptive feed and spindle multiply; the limit of all speeds limits the product.
TEST_P(BothLaws, apply_all_that_changes_a_feed) {
  struct Case {
    double override, adaptive, spindle, top, speed;
  };
  for (const Case& one : {Case{1, 1, 1, 1e9, 20}, Case{1.5, 1, 1, 1e9, 30}, Case{0.5, 0.5, 1, 1e9, 5},
                          Case{1.5, 0.5, 1.2, 1e9, 18}, Case{2, 1, 1, 25, 25}}) {
    Segment segment = line(xyz(0, 0), xyz(100, 0), 20);
    segment.heeds.adaptive_feed = true;
    segment.lock = SpindleLock::speed;
    ListSource<PathItem> source({segment});
    Planner planner(source, limits());
    planner.set_feed_override(one.override);
    planner.set_adaptive_feed(one.adaptive);
    planner.set_spindle_ratio(one.spindle);
    planner.limit_speed_to(MmPerSecond(one.top));
    double fastest = 0;
    for (MotionItem item; planner.next(item);) {
      for (const Phase& phase : std::get<PlannedMove>(item)) fastest = std::max(fastest, phase.velocity.value());
    }
    EXPECT_NEAR(fastest, one.speed, 1e-9);
  }
}

// The factor of rapids is one of the speed that the axes allow; feeds do not heed it.
TEST_P(BothLaws, slow_rapids_down) {
  const auto fastest_with = [&](double factor, bool rapid) {
    Segment segment = line(xyz(0, 0), xyz(400, 0), 20);
    segment.rapid = rapid;
    if (rapid) segment.speed = MmPerSecond(std::numeric_limits<double>::infinity());
    ListSource<PathItem> source({segment});
    Planner planner(source, limits());
    planner.set_rapid_override(factor);
    double fastest = 0;
    for (MotionItem item; planner.next(item);) {
      for (const Phase& phase : std::get<PlannedMove>(item)) fastest = std::max(fastest, phase.velocity.value());
    }
    return fastest;
  };
  const double whole = fastest_with(1, true);
  EXPECT_NEAR(fastest_with(0.5, true), whole / 2, 1e-6);
  EXPECT_NEAR(fastest_with(0.25, true), whole / 4, 1e-6);
  EXPECT_NEAR(fastest_with(0.25, false), 20, 1e-9);
}

// A path that ended with a wait for more goes on, while the motion brakes for that end.
TEST_P(BothLaws, lead_on_where_the_path_ended_until_now) {
  const auto slowest_at_the_joint = [&](bool goes_on) {
    ListSource<PathItem> source(
        {line(xyz(0, 0), xyz(60, 0), 20), Action{.kind = Action::Kind::await_line}, line(xyz(60, 0), xyz(120, 0), 20)});
    Planner planner(source, limits());
    planner.limit_moves_to(Seconds(0.005));
    double slowest = 1e9;
    bool asked = false;
    for (MotionItem item; planner.next(item);) {
      const auto* move = std::get_if<PlannedMove>(&item);
      if (move == nullptr) {
        EXPECT_FALSE(goes_on);
        slowest = 0;
        continue;
      }
      const double at = move->segment.tool_at(move->to)[Axis::x];
      if (at > 55 && at < 65) slowest = std::min(slowest, move->exit_velocity().value());
      if (goes_on && !asked && at > 58.5) {
        asked = true;
        EXPECT_TRUE(planner.go_on(PathMode::continuous));
      }
    }
    EXPECT_FALSE(planner.go_on(PathMode::continuous)) << "nothing is there";
    return slowest;
  };
  EXPECT_EQ(slowest_at_the_joint(false), 0);
  ListSource<PathItem> other({line(xyz(0, 0), xyz(60, 0), 20), Action{.kind = Action::Kind::outputs}});
  Planner planner(other, limits());
  MotionItem item;
  ASSERT_TRUE(planner.next(item));
  EXPECT_FALSE(planner.go_on(PathMode::continuous)) << "another action is not forgotten";
  EXPECT_GT(slowest_at_the_joint(true), 5);
}

INSTANTIATE_TEST_SUITE_P(Jerk, BothLaws, testing::Values(0.0, 25'000.0),
                         [](const auto& jerk) { return std::string(jerk.param > 0 ? "limited" : "unlimited"); });

// A move of phases without acceleration, at 10 mm/s.
PlannedMove steady_move(const std::vector<double>& durations) {
  PlannedMove move;
  double at = 0;
  for (const double duration : durations) {
    move.add({.duration = Seconds(duration), .start = Mm(at), .velocity = MmPerSecond(10)});
    at += 10 * duration;
  }
  move.to = Mm(at);
  return move;
}

TEST(Shorten, leaves_a_move_that_is_short_enough) {
  PlannedMove move = steady_move({0.5, 0.5});
  EXPECT_FALSE(shorten(move, Seconds(1)));
  EXPECT_EQ(move.phase_count, 2U);
  EXPECT_EQ(move.to, Mm(10));
}

TEST(Shorten, cuts_inside_a_phase_and_goes_on_from_there) {
  PlannedMove move = steady_move({0.5, 2});
  move.phases[1].jerk = MmPerSecond3(6);
  move.to = move.phases[1].position_at(Seconds(2));
  const Phase whole = move.phases[1];
  const std::optional<PlannedMove> rest = shorten(move, Seconds(1));
  ASSERT_TRUE(rest);
  EXPECT_NEAR(move.duration().value(), 0.98, 1e-12);
  EXPECT_EQ(rest->from(), move.to);
  const Phase& after = rest->phases[0];
  EXPECT_NEAR(after.duration.value(), 1.52, 1e-12);
  EXPECT_NEAR(after.acceleration.value(), 6 * 0.48, 1e-9);
  EXPECT_NEAR(after.position_at(after.duration).value(), whole.position_at(whole.duration).value(), 1e-9);
}

// Seed 39 of RandomMotion: a turn of 4,114 degrees, cut every 4.9 ms, left a gap of 1.6e-8 degrees.
TEST(Shorten, meets_the_next_phase_after_a_hundred_thousand_cuts) {
  PlannedMove move = steady_move({490, 1});
  const double end = move.phases[1].start.value();
  double last = 0;
  for (std::optional<PlannedMove> rest = shorten(move, Seconds(0.005)); rest; rest = shorten(move, Seconds(0.005))) {
    const Phase& played = move.phases[0];
    EXPECT_NEAR(played.position_at(played.duration).value(), rest->from().value(), 1e-11);
    if (rest->phase_count == 2) last = rest->phases[0].position_at(rest->phases[0].duration).value();
    move = *rest;
  }
  EXPECT_NEAR(last, end, 1e-11);
}

TEST(Shorten, makes_no_dust_of_a_phase) {
  PlannedMove move = steady_move({0.97, 0.5, 0.3});
  const std::optional<PlannedMove> rest = shorten(move, Seconds(1));
  ASSERT_TRUE(rest);
  EXPECT_EQ(move.phase_count, 1U);
  EXPECT_EQ(rest->phase_count, 2U);
  EXPECT_EQ(rest->from(), move.to);
}

TEST(Shorten, cuts_among_many_tiny_phases) {
  PlannedMove move = steady_move({0.99, 0.015, 0.015, 0.015, 0.015, 0.015, 0.015});
  const std::optional<PlannedMove> rest = shorten(move, Seconds(1));
  ASSERT_TRUE(rest);
  EXPECT_LE(move.duration(), Seconds(1));
  EXPECT_NEAR((move.duration() + rest->duration()).value(), 1.08, 1e-12);
}

}  // namespace
}  // namespace passo::test
