#include "../stop_in_hold.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(StopInHold, is_reported_once) {
  StopInHold rest;
  rest.hold(false);
  EXPECT_FALSE(rest.begins(false));  // the machine brakes
  EXPECT_TRUE(rest.begins(true));
  EXPECT_FALSE(rest.begins(true));
}

TEST(StopInHold, is_reported_again_after_motion_and_after_another_hold) {
  StopInHold rest;
  EXPECT_TRUE(rest.begins(true));
  EXPECT_FALSE(rest.begins(false));
  EXPECT_TRUE(rest.begins(true));
  rest.hold(false);
  EXPECT_TRUE(rest.begins(true));
}

TEST(StopInHold, switches_outputs_off_once_and_for_a_door_alone) {
  StopInHold rest;
  rest.hold(false);
  EXPECT_FALSE(rest.take_stop_of_outputs());
  rest.hold(true);
  rest.hold(false);  // a hold in the hold for the door
  EXPECT_TRUE(rest.take_stop_of_outputs());
  EXPECT_FALSE(rest.take_stop_of_outputs());
}

TEST(StopInHold, leaves_outputs_on_if_the_program_goes_on_before_it_rests) {
  StopInHold rest;
  rest.hold(true);
  rest.resume();
  EXPECT_FALSE(rest.take_stop_of_outputs());
}

}  // namespace
}  // namespace passo
