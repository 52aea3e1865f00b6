#include "passo/units/constant_jerk.hpp"

#include <random>

#include "kit/seed.hpp"

namespace passo {
namespace {

TEST(ConstantJerk, the_time_at_a_way_is_where_the_polynomial_has_it) {
  std::mt19937_64 random(test::seed());
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int run = 0; run < 100'000; ++run) {
    const double duration = between(0.01, 10);
    const double jerk = run % 3 == 0 ? 0 : between(-100, 100);
    // The speed is a parabola in time. The way grows if the parabola's ends and its lowest point are above 0.
    const double acceleration = between(-100, 100);
    const ConstantJerk rising{0, acceleration, jerk};
    double lowest = std::min(0.0, rising.speed_after(duration));
    const double turn = -acceleration / (jerk == 0 ? 1 : jerk);
    if (jerk != 0 && turn > 0 && turn < duration) lowest = std::min(lowest, rising.speed_after(turn));
    const ConstantJerk motion{between(0.01, 10) - lowest, acceleration, jerk};
    const double time = between(0, duration);
    ASSERT_NEAR(motion.time_to(motion.way_after(time), duration), time, 1e-9 * duration) << run;
  }
}

TEST(ConstantJerk, stays_within_its_duration) {
  const ConstantJerk motion{1, 2, 3};
  EXPECT_EQ(motion.time_to(-1, 5), 0);
  EXPECT_EQ(motion.time_to(0, 5), 0);
  EXPECT_NEAR(motion.time_to(1e9, 5), 5, 1e-9);
  EXPECT_EQ((ConstantJerk{1, 0, 0}.time_to(7, 5)), 5);
}

TEST(ConstantJerk, from_rest_the_first_way_takes_the_cube_root) {
  EXPECT_NEAR((ConstantJerk{0, 0, 6e6}.time_to(1e-12, 100)), 1e-6, 1e-18);
}

}  // namespace
}  // namespace passo
