#include "passo/chip/pico_pins.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(PicoPins, a_pin_with_two_jobs_is_found) {
  PicoPins twice = pico_bare;
  twice.probe = twice.limits[0];
  EXPECT_FALSE(twice.is_sound());
  twice = pico_bare;
  twice.flood = twice.motor[5].step;
  EXPECT_FALSE(twice.is_sound());
}

TEST(PicoPins, a_motor_too_far_from_the_others_is_found) {
  PicoPins far = pico_bare;
  far.motor[5].step = 24;
  EXPECT_FALSE(far.is_sound());
  far.motor[5].step = no_gpio;
  EXPECT_FALSE(far.is_sound());
}

TEST(PicoPins, an_encoder_on_a_pin_that_cannot_count_is_found) {
  PicoPins lathe = pico_lathe;
  EXPECT_TRUE(lathe.is_sound());
  std::swap(lathe.encoder_pulses, lathe.encoder_index);
  EXPECT_FALSE(lathe.is_sound()) << "only the second pin of a slice counts";
  lathe = pico_lathe;
  lathe.spindle_pwm = no_gpio;
  lathe.spindle_direction = no_gpio;
  lathe.encoder_pulses = 17;
  EXPECT_FALSE(lathe.is_sound()) << "flood is there";
  lathe.flood = no_gpio;
  EXPECT_TRUE(lathe.is_sound());
  lathe.spindle_pwm = 16;
  EXPECT_FALSE(lathe.is_sound()) << "one slice cannot do both";
}

TEST(PicoPins, a_handwheel_that_is_not_whole_is_found) {
  PicoPins mpg = pico_mpg;
  EXPECT_TRUE(mpg.is_sound());
  mpg.wheel.tenfold = no_gpio;
  EXPECT_FALSE(mpg.is_sound());
  mpg = pico_mpg;
  mpg.wheel.axes[3] = mpg.probe;
  EXPECT_FALSE(mpg.is_sound()) << "a pin has two jobs";
  mpg = pico_mpg;
  mpg.wheel.b = 29;
  EXPECT_FALSE(mpg.is_sound()) << "one register does not have both edges";
}

TEST(PicoPins, bits_of_motors_count_from_the_first_pin) {
  EXPECT_EQ(pico_bare.steps_of(0b000001), 1U << (2 - 2));
  EXPECT_EQ(pico_bare.steps_of(0b100000), 1U << (12 - 2));
  EXPECT_EQ(pico_bare.directions_of(0b000011), (1U << (3 - 2) | 1U << (5 - 2)));
  EXPECT_EQ(pico_bare.motor_pins(), 0x3ffcU);
}

}  // namespace
}  // namespace passo
