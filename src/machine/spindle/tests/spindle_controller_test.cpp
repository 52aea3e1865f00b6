// A controller with a simulated drive, in virtual time.
#include "passo/spindle/spindle_controller.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "kit/timed_vfd.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr SpindleOrder forward_18000{.direction = SpindleDirection::clockwise, .revolutions_per_minute = 18000};
constexpr SpindleOrder reverse_18000{.direction = SpindleDirection::counterclockwise, .revolutions_per_minute = 18000};

class SpindleControllerTest : public testing::Test {
 protected:
  static SpindleBusDescription bus() {
    return {
        .drive = "huanyang", .device = "/dev/ttyUSB0", .highest_rpm = 24000, .rated_current = 9, .reach = Seconds(5)};
  }
  void run(Seconds time) {
    for (const Seconds end = now + time; now < end;) {
      const Seconds before = now;
      const Seconds pause = controller.step();
      now += std::min(pause, Seconds(0.05));
      vfd.turn();
      ASSERT_GT(now, before);
    }
  }
  // The time until the speed is reached.
  double time_to_speed(Seconds most) {
    const Seconds begin = now;
    while (!controller.status().at_speed && now - begin < most) run(Seconds(0.01));
    return (now - begin).value();
  }

  Seconds now{100};
  test::TimedVfd vfd{[this] { return now; }, [this](Seconds time) { now += time; }};
  SpindleController controller{vfd, bus(), [this] { return now; }};
};

TEST_F(SpindleControllerTest, a_drive_is_stopped_before_anything_else) {
  vfd.direction = 1;
  run(Seconds(0.1));
  EXPECT_THAT(vfd.commands, ElementsAre(VfdTask::stop));
  EXPECT_TRUE(controller.is_stopped());
  EXPECT_TRUE(controller.status().answers);
}

TEST_F(SpindleControllerTest, a_speed_is_reached_when_the_drive_reports_it) {
  run(Seconds(1));
  controller.order(forward_18000);
  EXPECT_FALSE(controller.status().at_speed);
  const double took = time_to_speed(Seconds(10));
  // 18000 rpm at 9000 rpm/s, less the tolerance.
  EXPECT_GE(took, 1.9);
  EXPECT_LE(took, 2.3);
  EXPECT_GE(vfd.speed, 0.95 * 18000);
  EXPECT_THAT(vfd.commands, ElementsAre(VfdTask::stop, VfdTask::set_speed, VfdTask::run_forward));
  run(Seconds(1));
  EXPECT_EQ(controller.status().revolutions_per_minute, 18000);
  EXPECT_EQ(controller.status().current, 4.5);
  EXPECT_EQ(controller.status().load, 0.25);
}

TEST_F(SpindleControllerTest, a_change_of_the_speed_stops_nothing) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  vfd.commands.clear();
  controller.order({.direction = SpindleDirection::clockwise, .revolutions_per_minute = 9000});
  time_to_speed(Seconds(10));
  EXPECT_NEAR(vfd.speed, 9000, 450);
  EXPECT_THAT(vfd.commands, ElementsAre(VfdTask::set_speed));
}

TEST_F(SpindleControllerTest, a_spindle_is_reversed_only_when_it_stands) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  controller.order(reverse_18000);
  EXPECT_FALSE(controller.status().at_speed);
  const double took = time_to_speed(Seconds(10));
  EXPECT_GE(took, 3.8);
  EXPECT_NEAR(vfd.speed, -18000, 900);
  EXPECT_FALSE(vfd.turned_against);
}

TEST_F(SpindleControllerTest, a_speed_is_kept_within_the_limits_of_the_machine) {
  controller.order({.direction = SpindleDirection::clockwise, .revolutions_per_minute = 36000});
  time_to_speed(Seconds(10));
  EXPECT_EQ(vfd.set_rpm, 24000);
  EXPECT_TRUE(controller.status().at_speed);
}

TEST_F(SpindleControllerTest, a_spindle_that_does_not_reach_its_speed_fails) {
  vfd.top_rpm = 7200;
  controller.order(forward_18000);
  run(Seconds(5.3));
  const HostSpindleStatus status = controller.status();
  EXPECT_FALSE(status.at_speed);
  EXPECT_EQ(status.fault.code, "spindle.not-reached");
  EXPECT_THAT(status.fault.text, HasSubstr("did not reach 18000 rpm in 5 s: its drive reports 7200 rpm"));
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(SpindleControllerTest, a_silent_drive_is_lost_within_a_second_and_stopped_when_it_returns) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  vfd.is_silent = true;
  run(Seconds(1));
  EXPECT_EQ(controller.status().fault.code, "spindle.no-answer");
  EXPECT_THAT(controller.status().fault.text, HasSubstr("/dev/ttyUSB0, address 1"));
  EXPECT_FALSE(controller.clear_fault());
  run(Seconds(5));
  EXPECT_EQ(vfd.direction, 1);  // nobody can tell it
  vfd.is_silent = false;
  run(Seconds(1));
  EXPECT_EQ(vfd.direction, 0);
  EXPECT_TRUE(controller.status().has_failed());
  EXPECT_TRUE(controller.clear_fault());
  EXPECT_FALSE(controller.status().at_speed);
  time_to_speed(Seconds(10));
  EXPECT_NEAR(vfd.speed, 18000, 900);
}

TEST_F(SpindleControllerTest, single_errors_of_the_bus_change_nothing) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  for (int i = 0; i < 20; ++i) {
    vfd.is_damaged = true;
    controller.step();
    controller.step();
    vfd.is_damaged = false;
    run(Seconds(0.2));
  }
  EXPECT_FALSE(controller.status().has_failed());
  EXPECT_TRUE(controller.status().at_speed);
  vfd.is_damaged = true;
  run(Seconds(1));
  EXPECT_EQ(controller.status().fault.code, "spindle.bad-answer");
}

TEST_F(SpindleControllerTest, a_fault_of_the_drive_is_named_and_reset_on_request) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  vfd.fault = 3;
  run(Seconds(0.5));
  EXPECT_EQ(controller.status().fault.code, "spindle.drive-fault");
  EXPECT_THAT(controller.status().fault.text, HasSubstr("fault 3: overcurrent"));
  EXPECT_EQ(vfd.direction, 0);
  EXPECT_FALSE(controller.clear_fault());  // it is reset now
  run(Seconds(1.5));
  EXPECT_EQ(vfd.fault, 0);
  EXPECT_TRUE(controller.clear_fault());
  time_to_speed(Seconds(10));
  EXPECT_NEAR(vfd.speed, 18000, 900);
}

TEST_F(SpindleControllerTest, a_drive_that_was_switched_off_and_on_is_noticed) {
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  vfd.direction = 0;
  vfd.set_rpm = 0;
  run(Seconds(3));
  EXPECT_EQ(controller.status().fault.code, "spindle.slowed");
}

TEST_F(SpindleControllerTest, a_reading_that_the_drive_refuses_is_not_asked_for_again) {
  vfd.refuses = VfdTask::read_load;
  controller.order(forward_18000);
  time_to_speed(Seconds(10));
  run(Seconds(2));
  EXPECT_FALSE(controller.status().has_failed());
  EXPECT_EQ(controller.status().load, 0.5);  // 4.5 A of 9 A
}

TEST_F(SpindleControllerTest, a_drive_that_refuses_commands_fails) {
  vfd.refuses = VfdTask::set_speed;
  controller.order(forward_18000);
  run(Seconds(1));
  EXPECT_EQ(controller.status().fault.code, "spindle.refused");
  EXPECT_THAT(controller.status().fault.text, HasSubstr("exception 2"));
}

TEST_F(SpindleControllerTest, a_drive_without_reverse_says_so) {
  vfd.has_reverse = false;
  controller.order(reverse_18000);
  run(Seconds(1));
  EXPECT_EQ(controller.status().fault.code, "spindle.no-reverse");
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(SpindleControllerTest, a_drive_that_is_silent_while_the_spindle_is_off_has_no_fault) {
  run(Seconds(1));
  vfd.is_silent = true;
  run(Seconds(3));
  EXPECT_FALSE(controller.status().has_failed());
  EXPECT_FALSE(controller.status().answers);
  EXPECT_FALSE(controller.clear_fault());
}

}  // namespace
}  // namespace passo
