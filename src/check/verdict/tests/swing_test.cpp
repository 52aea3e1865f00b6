#include "../swing.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Swing, from_rest_needs_the_textbooks_multiple) {
  // sin δ·(π − δ) = 1 + cos δ has the solution sin δ = 0.7246.
  EXPECT_NEAR(torque_to_catch(0, 1), 1 / 0.7246, 1e-3);
  EXPECT_NEAR(torque_to_catch(0, -1), 1 / 0.7246, 1e-3);
}

TEST(Swing, from_the_opposite_load_needs_more) {
  const double lag = std::atan(2 / std::numbers::pi);
  EXPECT_NEAR(torque_to_catch(-1, 1), 1 / std::sin(lag), 1e-3);
}

TEST(Swing, without_a_jump_needs_the_load_alone) {
  EXPECT_DOUBLE_EQ(torque_to_catch(0.5, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(torque_to_catch(0, 0), 0);
  EXPECT_GE(torque_to_catch(1, 0), 1);
}

// A pendulum in place of the rotor: sine torque, constant load, no damping.
bool stays(double pull_out, double before, double after) {
  double lag = std::asin(before / pull_out);
  double rate = 0;
  constexpr double step = 1e-4;
  for (double t = 0; t < 100; t += step) {
    rate += step * (after - pull_out * std::sin(lag));
    lag += step * rate;
    if (std::abs(lag) > std::numbers::pi) return false;
  }
  return true;
}

TEST(Swing, agrees_with_a_simulated_rotor) {
  for (const double before : {-0.9, -0.3, 0.0, 0.4, 0.8}) {
    const double least = torque_to_catch(before, 1);
    EXPECT_TRUE(stays(1.005 * least, before, 1)) << before;
    EXPECT_FALSE(stays(0.99 * least, before, 1)) << before;
  }
}

}  // namespace
}  // namespace passo
