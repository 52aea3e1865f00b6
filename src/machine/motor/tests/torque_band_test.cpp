#include "passo/motor/torque_band.hpp"

#include "example_motors.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(TorqueBand, holds_the_curve_and_widens_with_the_tolerance) {
  const MotorSetup setup = test::on_the_bench(test::small_motor(), "microsteps:8", 0.02);
  const auto curve = TorqueCurve::from_motor(setup.motor, setup.drive);
  const TorqueBand none(setup, 0);
  const TorqueBand wide(setup, 0.2);
  for (const double speed : {0.0, 20.0, 60.0, 120.0}) {
    const double there = curve->pull_out({speed}).value;
    EXPECT_LT(none.of_curve({speed}).low.value, there);
    EXPECT_GT(none.of_curve({speed}).high.value, there);
    EXPECT_LE(wide.of_curve({speed}).low, none.of_curve({speed}).low);
    EXPECT_GE(wide.of_curve({speed}).high, none.of_curve({speed}).high);
  }
  EXPECT_NEAR(wide.of_curve({0}).low.value, 0.8 * none.of_curve({0}).low.value, 1e-9);
}

// A stronger magnet has a higher back-EMF.
TEST(TorqueBand, takes_the_strong_motor_for_the_weak_one_where_the_voltage_limits) {
  MotorSetup setup = test::on_the_bench(test::small_motor(), "microsteps:8", 0.02);
  setup.drive.regulation = Regulation::resistive;
  const RadiansPerSecond fast{250};
  const auto strong = TorqueCurve::from_motor(with_torque(setup, 1.3).motor, setup.drive);
  EXPECT_LE(TorqueBand(setup, 0.3).of_curve(fast).low, strong->pull_out(fast));
}

TEST(TorqueBand, is_lower_where_a_steady_rate_makes_the_rotor_swing) {
  TorqueBand band(test::on_the_bench(test::small_motor(), "two-on", 0.002), 0.1);
  band.try_steady({60});
  bool any = false;
  for (double speed = 0; speed < 60; speed += 0.5) {
    EXPECT_LE(band.while_steady({speed}), band.of_curve({speed}).low) << speed;
    any = any || band.while_steady({speed}).value < 0.9 * band.of_curve({speed}).low.value;
  }
  EXPECT_TRUE(any);
  EXPECT_EQ(band.while_steady({0}), band.of_curve({0}).low);
}

TEST(TorqueBand, of_a_measured_curve_is_that_share_of_it) {
  const auto curve = TorqueCurve::from_points({.steps_per_revolution = 200, .inertia = {3e-5}},
                                              {{Hertz(0), {1.0}}, {Hertz(1000), {0.5}}});
  const TorqueBand band(measured_setup(*curve, *Excitation::named("microsteps:8")), 0.1);
  EXPECT_NEAR(band.of_curve({0}).low.value, 0.9 * 0.97, 1e-9);
  EXPECT_NEAR(band.of_curve({0}).high.value, 1.1 * 1.06, 1e-9);
}

}  // namespace
}  // namespace passo
