#include "passo/feedback/shaft_encoder.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(ShaftEncoder, counts_whole_counts_both_ways) {
  const ShaftEncoder encoder(400);
  const double count = 2 * std::numbers::pi / 400;
  EXPECT_EQ(encoder.counts_at(0), 0);
  EXPECT_EQ(encoder.counts_at(0.99 * count), 0);
  EXPECT_EQ(encoder.counts_at(1.01 * count), 1);
  EXPECT_EQ(encoder.counts_at(-0.01 * count), -1);
  EXPECT_EQ(encoder.counts_at(1000 * 2 * std::numbers::pi + 0.5 * count), 400'000);
  for (const double place : {-3.21, 0.0, 0.77, 12.0}) {
    EXPECT_LE(std::abs(encoder.radians_of(encoder.counts_at(place)) - place), 0.5001 * count);
  }
}

TEST(CountedSpeed, of_an_even_motion_comes_to_that_speed) {
  const ShaftEncoder encoder(4000);
  CountedSpeed speed(encoder, Seconds(0.001), Seconds(0.004));
  double last = 0;
  double mean = 0;
  for (int i = 0; i < 2000; ++i) {
    last = speed.update(encoder.counts_at(12.34 * i * 0.001));
    if (i >= 1000) mean += last / 1000;
  }
  EXPECT_NEAR(mean, 12.34, 0.01);
  EXPECT_NEAR(last, 12.34, 1.6);  // a count in a millisecond is 1.57 rad/s
}

TEST(CountedSpeed, of_a_shaft_that_rests_elsewhere_is_zero) {
  const ShaftEncoder encoder(4000);
  CountedSpeed speed(encoder, Seconds(0.001), Seconds(0));
  EXPECT_EQ(speed.update(12'345), 0);
  EXPECT_EQ(speed.update(12'345), 0);
}

}  // namespace
}  // namespace passo
