#include "passo/motor/motor_trials.hpp"

#include <cmath>
#include <numbers>

#include "example_motors.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(MotorTrials, find_the_textbooks_pull_out_where_the_rotor_does_not_swing) {
  const MotorSetup setup = test::on_the_bench(test::small_motor(), "microsteps:8", 0.015);
  const auto curve = TorqueCurve::from_motor(setup.motor, setup.drive);
  for (const double rate : {300.0, 800.0, 1500.0}) {
    const RadiansPerSecond speed = curve->speed_at(Hertz(rate));
    const double expected = curve->pull_out(speed).value - setup.damping.value * speed.value;
    EXPECT_NEAR(tried_pull_out(setup, Hertz(rate)).value, expected, 0.06 * expected) << rate;
  }
}

TEST(MotorTrials, find_that_pull_in_ends_and_is_below_pull_out) {
  const MotorSetup setup = test::on_the_bench(test::small_motor(), "two-on", 0.02);
  EXPECT_GT(tried_pull_in(setup, Hertz(400)).value, 0.05);
  EXPECT_EQ(tried_pull_in(setup, Hertz(3000)).value, 0);
  for (const double rate : {400.0, 500.0, 600.0}) {
    EXPECT_LE(tried_pull_in(setup, Hertz(rate)).value, tried_pull_out(setup, Hertz(rate)).value) << rate;
  }
}

// Full steps at the rotor's own frequency make it swing; microsteps do not.
TEST(MotorTrials, find_the_resonance) {
  const MotorSetup full = test::on_the_bench(test::small_motor(), "two-on", 0.02);
  const double inertia = full.motor.rotor.inertia.value + full.load.inertia.value;
  const double own =
      std::sqrt(full.motor.rotor.teeth() * full.motor.holding_torque.value / inertia) / (2 * std::numbers::pi);
  EXPECT_GT(tried_lag(full, Hertz(own)), 1.5 * tried_lag(full, Hertz(4 * own)));
  EXPECT_LT(tried_lag(test::on_the_bench(test::small_motor(), "microsteps:16", 0.02), Hertz(own)), 0.3);
}

TEST(MotorTrials, show_the_response_to_one_step) {
  const auto moments =
      tried_motion(test::on_the_bench(test::small_motor(), "two-on", 0.02), 1, Hertz(100), Seconds(0.5), Seconds(1e-4));
  EXPECT_EQ(moments.size(), 5001U);
  EXPECT_EQ(moments.front().commanded, 1);
  EXPECT_EQ(moments.front().place, 0);
  double most = 0;
  for (const MotorMoment& moment : moments) most = std::max(most, moment.place);
  EXPECT_GT(most, 1.7) << "it overshoots";
  EXPECT_LT(most, 2);
  EXPECT_NEAR(moments.back().place, 1, 0.01) << "and comes to rest";
}

TEST(MotorTrials, show_that_a_stop_without_a_ramp_overshoots) {
  const auto moments = tried_motion(test::on_the_bench(test::small_motor(), "half-step", 0.02), 40, Hertz(300),
                                    Seconds(0.5), Seconds(1e-4));
  double most = 0;
  for (const MotorMoment& moment : moments) most = std::max(most, moment.place);
  EXPECT_EQ(moments.back().commanded, 20);
  EXPECT_GT(most, 20.3);
  EXPECT_NEAR(moments.back().place, 20, 0.05);
}

}  // namespace
}  // namespace passo
