#include "passo/verdict/margin_words.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

MarginSpot doubtful_spot() {
  MarginSpot spot{.axis = Axis::y, .line = 12, .verdict = Verdict::doubtful};
  spot.needed = {0.31};
  spot.there = {{0.28}, {0.4}};
  spot.rate = Hertz(1420);
  spot.speed = MmPerSecond(20);
  spot.path_speed = MmPerSecond(25);
  spot.safe_acceleration = MmPerSecond2(380.9);
  spot.safe_path_speed = MmPerSecond(15);
  return spot;
}

TEST(MarginWords, tell_cause_and_cure) {
  const MarginSpot spot = doubtful_spot();
  EXPECT_EQ(cause_of(spot), "Y needs 0.31 N\u00B7m at 1,420 steps/s, and has 0.28 to 0.4");
  EXPECT_EQ(cure_of(spot), "a <= 380 mm/s\u00B2, or F <= 900");
}

TEST(MarginWords, cure_a_rapid_by_the_velocity_of_its_axis) {
  MarginSpot spot = doubtful_spot();
  spot.rapid = true;
  spot.safe_acceleration.reset();
  EXPECT_EQ(cure_of(spot), "velocity <= 12 mm/s");
  spot.safe_path_speed.reset();
  EXPECT_EQ(cure_of(spot), "a stronger motor, or less load");
  spot.verdict = Verdict::safe;
  EXPECT_EQ(cure_of(spot), "");
}

TEST(MarginWords, tell_swings_from_a_lack_of_torque) {
  MarginSpot spot = doubtful_spot();
  MarginVerdict margin{.verdict = Verdict::doubtful, .axes = {}, .worst = {spot}};
  EXPECT_FALSE(is_torque_enough(margin));
  margin.worst.front().want = LossCause::jump;
  EXPECT_TRUE(is_torque_enough(margin));
  spot.verdict = Verdict::safe;
  margin.worst.push_back(spot);
  EXPECT_TRUE(is_torque_enough(margin));
}

TEST(MarginWords, name_the_swing) {
  MarginSpot spot = doubtful_spot();
  spot.rate = Hertz(1234567);
  spot.want = LossCause::jump;
  EXPECT_EQ(cause_of(spot),
            "Y needs 0.31 N\u00B7m at 1,234,567 steps/s to damp the oscillation after a jump of its torque, and has "
            "0.28 to 0.4");
  spot.want = LossCause::calm;
  // Without a contradiction: the torque is not what is too small.
  EXPECT_EQ(cause_of(spot),
            "Y has enough torque at 1,234,567 steps/s (needs 0.31 N\u00B7m, has 0.28 to 0.4), but the motor may lose "
            "steps there through resonance (mid-band instability)");
}

}  // namespace
}  // namespace passo
