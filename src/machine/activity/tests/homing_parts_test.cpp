// The parts of homing: HomedMotors, HomingGroup and SwitchWatch.
#include <gtest/gtest.h>

#include "passo/activity/homed_motors.hpp"
#include "passo/activity/homing_group.hpp"
#include "passo/activity/switch_watch.hpp"

namespace passo {
namespace {

TEST(HomedMotors, know_where_each_switch_closed) {
  HomedMotors motors;
  motors.begin_at(10);
  motors.go(HomedMotors::first, 5, 3.0);
  motors.go(HomedMotors::second, 6, 5.5);
  EXPECT_EQ(motors.found(HomedMotors::first), 13);
  EXPECT_EQ(motors.found(HomedMotors::second), 15.5);
  EXPECT_EQ(motors.apart(), -1);
  EXPECT_EQ(motors.apart_from_switches(), 1.5);
  EXPECT_EQ(motors.farthest_beyond(1), 2);
}

TEST(HomedMotors, keep_the_place_of_a_switch_on_ways_without_a_contact) {
  HomedMotors motors;
  motors.begin_at(0);
  motors.go(HomedMotors::first, -4, -3.0);
  motors.go(HomedMotors::first, 2, {});
  EXPECT_EQ(motors.found(HomedMotors::first), -3);
  EXPECT_EQ(motors.is_at(HomedMotors::first), -2);
  motors.begin_at(7);
  EXPECT_EQ(motors.found(HomedMotors::first), 7);
}

TEST(HomedMotors, are_never_less_than_not_beyond) {
  HomedMotors motors;
  motors.begin_at(0);
  motors.go(HomedMotors::first, 5, 5.0);
  motors.go(HomedMotors::first, -1, {});
  EXPECT_EQ(motors.farthest_beyond(1), 0);
  EXPECT_EQ(motors.farthest_beyond(-1), 1);
}

TEST(HomingGroup, goes_through_its_axes_in_order) {
  const AxisDescription x;
  const AxisDescription y;
  HomingGroup turn;
  turn.add(x);
  turn.add(y);
  EXPECT_EQ(turn.after(x), &y);
  EXPECT_EQ(turn.after(y), nullptr);
  turn.remove(x);
  EXPECT_EQ(turn.after(x), nullptr);
  EXPECT_EQ(turn.axes().front(), &y);
}

TEST(HomingGroup, knows_where_a_switch_was_met_until_its_last_axis_is_homed) {
  const AxisDescription x;
  const AxisDescription y;
  HomingGroup turn;
  turn.add(x);
  turn.add(y);
  turn.seek_together();
  EXPECT_TRUE(turn.seeks_together());
  Point met;
  met[Axis::x] = 3;
  turn.rest(met);
  EXPECT_FALSE(turn.seeks_together());
  turn.rest({});  // a switch that was closed already tells no place
  EXPECT_EQ(turn.met(), met);
  turn.remove(y);
  EXPECT_EQ(turn.met(), met);
  turn.remove(x);
  EXPECT_FALSE(turn.met());
}

TEST(SwitchWatch, turns_as_often_as_a_contact_may_bounce) {
  SwitchWatch watch;
  watch.begin_axis();
  bool until_closed = true;
  for (int i = 0; i < SwitchWatch::most_changes; ++i) {
    EXPECT_TRUE(watch.turn());
    until_closed = !until_closed;
    EXPECT_EQ(watch.until_closed(), until_closed);
  }
  EXPECT_FALSE(watch.allows_another_try());
  EXPECT_FALSE(watch.turn());
  watch.begin_axis();
  EXPECT_TRUE(watch.until_closed());
  EXPECT_TRUE(watch.turn());
}

}  // namespace
}  // namespace passo
