// What waits for the spindle, and what cannot follow it.
#include <cmath>

#include "path_test.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::HasSubstr;

class SpindleTest : public PathTest {
 protected:
  SpindleTest() {
    options_.spindle_run_up = Seconds(0.5);
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) options_.velocity[axis] = MmPerSecond(100);
    options_.velocity[Axis::x] = MmPerSecond(50);
  }
  void speed(double rpm) { add(operation::SetSpindleSpeed{rpm}); }
  void turn(SpindleDirection direction) { add(operation::TurnSpindle{direction}); }
  void clockwise(double rpm) {
    speed(rpm);
    turn(SpindleDirection::clockwise);
  }
  void rapid(double x) { add(operation::StraightTraverse{xyz(x, 0)}); }
  // The dwells of the path.
  std::vector<double> waits() {
    std::vector<double> found;
    for (const PathItem& item : build()) {
      const auto* action = std::get_if<Action>(&item);
      if (action != nullptr && action->kind == Action::Kind::dwell) found.push_back(action->dwell.value());
    }
    return found;
  }
  // The only diagnostic.
  std::string told() {
    static_cast<void>(build());
    if (diagnostics_.all().size() != 1) return "not one diagnostic";
    const Diagnostic& one = diagnostics_.all()[0];
    return one.code + ": " + one.message + "; " + one.expected;
  }
};

TEST_F(SpindleTest, motion_waits_until_the_spindle_has_run_up) {
  clockwise(6000);
  rapid(10);
  const std::vector<PathItem> items = build();
  ASSERT_EQ(items.size(), 4U);
  EXPECT_EQ(std::get<Action>(items[0]).kind, Action::Kind::outputs);
  EXPECT_EQ(std::get<Action>(items[0]).outputs.revolutions_per_minute, 6000);
  EXPECT_EQ(std::get<Action>(items[1]).kind, Action::Kind::dwell);
  EXPECT_EQ(std::get<Action>(items[1]).dwell, Seconds(3));
  EXPECT_EQ(std::get<Action>(items[1]).outputs, std::get<Action>(items[0]).outputs);
  EXPECT_TRUE(std::holds_alternative<Segment>(items[2]));
}

TEST_F(SpindleTest, the_wait_is_for_the_change_of_speed) {
  clockwise(2000);
  rapid(10);
  turn(SpindleDirection::clockwise);  // as fast as before
  rapid(20);
  speed(3000);
  rapid(30);
  speed(1000);
  rapid(40);
  turn(SpindleDirection::counterclockwise);
  rapid(50);
  turn(SpindleDirection::off);
  rapid(60);
  turn(SpindleDirection::clockwise);
  rapid(70);
  EXPECT_THAT(waits(), testing::ElementsAre(1, 0.5, 1, 1, 0.5));
}

TEST_F(SpindleTest, a_dwell_of_the_program_counts_as_part_of_the_wait) {
  clockwise(6000);
  add(operation::Dwell{Seconds(1)});
  rapid(10);
  speed(8000);
  add(operation::Dwell{Seconds(4)});
  rapid(20);
  EXPECT_THAT(waits(), testing::ElementsAre(1, 2, 4));
}

TEST_F(SpindleTest, a_probe_move_waits_before_it_begins) {
  feed(10);
  clockwise(2000);
  add(operation::StraightProbe{.end = xyz(5, 0), .toward = true, .must_touch = false});
  const std::vector<PathItem> items = build();
  ASSERT_GE(items.size(), 3U);
  EXPECT_EQ(std::get<Action>(items[1]).dwell, Seconds(1));
  EXPECT_EQ(std::get<Action>(items[2]).kind, Action::Kind::probe_begin);
}

// The spindle has then turned as far back as it went on at first, so the tap is in its thread.
TEST_F(SpindleTest, a_tap_without_an_encoder_waits_while_the_spindle_is_reversed) {
  clockwise(600);
  add(operation::StartSpeedFeedSync{.pitch = Mm(1.5)});
  add(operation::RigidTap{xyz(0, 0, -10)});
  add(operation::StopSpeedFeedSync{});
  rapid(10);
  EXPECT_THAT(waits(), testing::ElementsAre(0.3, 0.6, 0.6));
}

TEST_F(SpindleTest, without_a_time_to_run_up_nothing_waits) {
  options_.spindle_run_up = Seconds(0);
  clockwise(6000);
  rapid(10);
  EXPECT_TRUE(waits().empty());
}

TEST_F(SpindleTest, a_spindle_that_reports_its_speed_is_waited_for_before_the_first_move_only) {
  options_.spindle_run_up = Seconds(0);
  options_.awaits_spindle_speed = true;
  clockwise(6000);
  add(operation::Dwell{Seconds(1)});
  rapid(10);
  rapid(20);
  add(operation::SetFlood{true});
  rapid(25);
  speed(8000);
  rapid(30);
  turn(SpindleDirection::off);
  rapid(40);
  std::string path;
  for (const PathItem& item : build()) {
    const auto* action = std::get_if<Action>(&item);
    if (action == nullptr) {
      path += "move ";
    } else if (action->kind == Action::Kind::await_speed) {
      path += fmt::format("await {:.0f} ", action->outputs.revolutions_per_minute);
    } else if (action->kind == Action::Kind::dwell) {
      path += "dwell ";
    }
  }
  EXPECT_EQ(path, "dwell await 6000 move move move await 8000 move move ");
}

TEST_F(SpindleTest, a_spindle_that_reports_its_speed_is_waited_for_after_its_run_up) {
  options_.awaits_spindle_speed = true;
  clockwise(2000);
  rapid(10);
  const std::vector<PathItem> items = build();
  ASSERT_GE(items.size(), 4U);
  EXPECT_EQ(std::get<Action>(items[1]).dwell, Seconds(1));
  EXPECT_EQ(std::get<Action>(items[2]).kind, Action::Kind::await_speed);
  EXPECT_TRUE(std::holds_alternative<Segment>(items[3]));
}

TEST_F(SpindleTest, a_spindle_on_a_bus_does_not_tap) {
  options_.awaits_spindle_speed = true;
  clockwise(600);
  add(operation::StartSpeedFeedSync{.pitch = Mm(1.5)});
  add(operation::RigidTap{xyz(0, 0, -10)});
  add(operation::StopSpeedFeedSync{});
  EXPECT_THAT(told(), HasSubstr("path.tap-on-bus"));
}

TEST_F(SpindleTest, a_spindle_on_a_bus_does_not_tap_with_a_floating_holder_either) {
  options_.awaits_spindle_speed = true;
  feed(10);
  clockwise(600);
  add(operation::SetFeedOverride{false});
  go(0, 0, -10);
  turn(SpindleDirection::counterclockwise);
  go(0, 0, 0);
  EXPECT_THAT(told(), HasSubstr("path.tap-on-bus"));
}

TEST_F(SpindleTest, a_thread_that_an_axis_cannot_follow_is_refused_with_what_can_be_had) {
  clockwise(6000);
  add(operation::StartSpeedFeedSync{.pitch = Mm(4)});
  go(0, 0, -15);
  EXPECT_EQ(
      told(),
      "path.thread-too-fast: at 6000 rpm and 4.000 mm/rev, Z would have to move at 400.0 mm/s, above its limit of "
      "100; S up to 1500, or up to 1.000 mm/rev");
  EXPECT_TRUE(diagnostics_.any_error());
  EXPECT_EQ(diagnostics_.all()[0].place.line, 4U);
}

TEST_F(SpindleTest, what_can_be_had_is_accepted) {
  clockwise(1500);
  add(operation::StartSpeedFeedSync{.pitch = Mm(4)});
  go(0, 0, -15);
  speed(6000);
  add(operation::StartSpeedFeedSync{.pitch = Mm(1)});
  go(0, 0, 0);
  static_cast<void>(build());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
}

TEST_F(SpindleTest, of_a_feed_on_two_axes_the_slower_one_counts) {
  clockwise(1800);
  add(operation::StartSpeedFeedSync{.pitch = Mm(3)});  // 90 mm/s along the path
  go(3, 0, -4);                                        // 54 mm/s of X, 72 of Z
  EXPECT_THAT(told(),
              HasSubstr("X would have to move at 54.0 mm/s, above its limit of 50; S up to 1666, or up to 2.777"));
}

TEST_F(SpindleTest, a_rigid_tap_is_refused_too) {
  clockwise(3000);
  add(operation::StartSpeedFeedSync{.pitch = Mm(2.5)});
  add(operation::RigidTap{xyz(0, 0, -10)});
  EXPECT_THAT(told(),
              HasSubstr("Z would have to move at 125.0 mm/s, above its limit of 100; S up to 2400, or up to 2.0"));
}

TEST_F(SpindleTest, a_feed_a_turn_is_refused_once_for_each_speed) {
  add(operation::SetFeedMode{FeedMode::units_per_revolution});
  clockwise(3000);
  feed_per_revolution(1.5);
  go(10, 0);
  go(20, 0);
  speed(4000);
  go(30, 0);
  static_cast<void>(build());
  EXPECT_THAT(codes(), testing::ElementsAre("path.thread-too-fast", "path.thread-too-fast"));
  EXPECT_THAT(diagnostics_.all()[0].expected, "S up to 2000, or up to 1.000 mm/rev");
}

TEST_F(SpindleTest, the_speed_that_counts_is_the_one_that_the_spindle_can_have) {
  options_.spindle_limit = 1500;
  clockwise(6000);
  add(operation::StartSpeedFeedSync{.pitch = Mm(4)});
  go(0, 0, -15);
  static_cast<void>(build());
  EXPECT_THAT(codes(), testing::ElementsAre("path.spindle-too-fast"));
  EXPECT_FALSE(diagnostics_.any_error());
}

TEST_F(SpindleTest, lengths_are_told_in_the_programs_units) {
  add(operation::SetLengthUnits{LengthUnits::inch});
  clockwise(6000);
  add(operation::StartSpeedFeedSync{.pitch = Mm(2.54)});
  go(0, 0, -15);
  EXPECT_THAT(told(), HasSubstr("6000 rpm and 0.1000 inches/rev, Z would have to move at 254.0 mm/s"));
  EXPECT_THAT(diagnostics_.all()[0].expected, "S up to 2362, or up to 0.0393 inches/rev");
}

}  // namespace
}  // namespace passo
