#include "../rest_in_hold.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(RestInHold, is_reported_once) {
  RestInHold rest;
  rest.hold(false);
  EXPECT_FALSE(rest.begins(false));  // the machine brakes
  EXPECT_TRUE(rest.begins(true));
  EXPECT_FALSE(rest.begins(true));
}

TEST(RestInHold, is_reported_again_after_motion_and_after_another_hold) {
  RestInHold rest;
  EXPECT_TRUE(rest.begins(true));
  EXPECT_FALSE(rest.begins(false));
  EXPECT_TRUE(rest.begins(true));
  rest.hold(false);
  EXPECT_TRUE(rest.begins(true));
}

TEST(RestInHold, switches_outputs_off_once_and_for_a_door_alone) {
  RestInHold rest;
  rest.hold(false);
  EXPECT_FALSE(rest.take_stop_of_outputs());
  rest.hold(true);
  rest.hold(false);  // a hold in the hold for the door
  EXPECT_TRUE(rest.take_stop_of_outputs());
  EXPECT_FALSE(rest.take_stop_of_outputs());
}

TEST(RestInHold, leaves_outputs_on_if_the_program_goes_on_before_it_rests) {
  RestInHold rest;
  rest.hold(true);
  rest.resume();
  EXPECT_FALSE(rest.take_stop_of_outputs());
}

}  // namespace
}  // namespace passo
