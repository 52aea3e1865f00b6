#include "passo/motor/torque_curve.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "example_motors.hpp"
#include "kit/seed.hpp"

namespace passo {
namespace {

using std::numbers::pi;

const Rotor rotor{.steps_per_revolution = 200, .inertia = {5e-6}};
const MotorDrive supply_24{.supply = {24}};

TorqueCurve from_points(const std::vector<TorquePoint>& pull_out, const std::vector<TorquePoint>& pull_in = {}) {
  auto curve = TorqueCurve::from_points(rotor, pull_out, pull_in);
  EXPECT_TRUE(curve) << curve.error().message;
  return *curve;
}

TorqueCurve from_motor(const MotorData& data, const MotorDrive& drive) {
  auto curve = TorqueCurve::from_motor(data, drive);
  EXPECT_TRUE(curve) << curve.error().message;
  return *curve;
}

// The curve is so long that no motor starts beyond its end.
TorqueCurve flat(double torque) {
  return from_points({{Hertz(0), {torque}}, {Hertz(1e5), {torque}}});
}

TEST(TorqueCurve, points_are_met_at_their_rates_and_nothing_is_promised_beyond_them) {
  const TorqueCurve curve = from_points({{Hertz(200), {0.4}}, {Hertz(1000), {0.3}}, {Hertz(2000), {0.1}}});
  EXPECT_DOUBLE_EQ(curve.speed_at(Hertz(200)).value, 2 * pi);
  EXPECT_DOUBLE_EQ(curve.rate_at({2 * pi}).value(), 200);
  EXPECT_DOUBLE_EQ(curve.pull_out(curve.speed_at(Hertz(0))).value, 0.4);
  EXPECT_DOUBLE_EQ(curve.pull_out(curve.speed_at(Hertz(1000))).value, 0.3);
  EXPECT_DOUBLE_EQ(curve.pull_out(curve.speed_at(Hertz(2000))).value, 0.1);
  EXPECT_EQ(curve.pull_out(curve.speed_at(Hertz(2000.001))).value, 0);
}

TEST(TorqueCurve, acceleration_is_what_pull_out_leaves_over_both_inertias) {
  const TorqueCurve curve = from_points({{Hertz(0), {0.4}}, {Hertz(2000), {0.2}}});
  const Load load{.inertia = {15e-6}, .friction = {0.1}, .friction_per_speed = {0.001}};
  EXPECT_NEAR(curve.available_acceleration({0}, load).value, 0.3 / 20e-6, 1e-6);
  const RadiansPerSecond middle = curve.speed_at(Hertz(1000));
  EXPECT_NEAR(curve.available_acceleration(middle, load, 0.5).value, 0.5 * (0.3 - 0.1 - 0.01 * pi) / 20e-6, 1e-6);
  EXPECT_EQ(curve.available_acceleration(curve.speed_at(Hertz(3000)), load).value, 0);
  EXPECT_EQ(curve.available_acceleration({0}, {.inertia = {}, .friction = {0.5}}).value, 0);
}

TEST(TorqueCurve, the_fastest_speed_is_where_friction_meets_pull_out) {
  const TorqueCurve line = from_points({{Hertz(0), {0.4}}, {Hertz(2000), {0}}});
  EXPECT_NEAR(line.rate_at(*line.fastest_speed({.friction = {0.1}})).value(), 1500, 1e-9);
  EXPECT_NEAR(line.rate_at(*line.fastest_speed({})).value(), 2000, 1e-9);
  EXPECT_EQ(line.fastest_speed({.friction = {0.4}})->value, 0);
  // Half of the torque is taken at rest, all of it at 20π rad/s.
  EXPECT_NEAR(line.rate_at(*line.fastest_speed({.friction = {0.1}, .friction_per_speed = {0.1 / (10 * pi)}})).value(),
              0.3 / (0.4 / 2000 + 0.1 / 1000), 1e-9);
  const TorqueCurve cut = from_points({{Hertz(0), {0.4}}, {Hertz(2000), {0.3}}});
  EXPECT_NEAR(cut.rate_at(*cut.fastest_speed({.friction = {0.1}})).value(), 2000, 1e-9);
}

TEST(TorqueCurve, a_winding_that_cancels_its_own_flux_has_no_end_without_friction_and_one_with_it) {
  MotorData motor = test::small_motor();  // K/(N·L) = 1.34 A, below the rated 1.7 A
  const TorqueCurve curve = from_motor(motor, supply_24);
  EXPECT_FALSE(curve.fastest_speed({}));
  const auto end = curve.fastest_speed({.friction = {0.02}});
  ASSERT_TRUE(end);
  EXPECT_NEAR(curve.pull_out(*end).value, 0.02, 1e-12);
  motor.inductance = {1.4e-3};
  EXPECT_TRUE(from_motor(motor, supply_24).fastest_speed({}));
}

TEST(TorqueCurve, the_starting_speed_falls_with_the_root_of_the_inertia_where_torque_is_flat) {
  const TorqueCurve curve = flat(0.3);
  const double alone = curve.maximum_starting_speed({}).value;
  // ½·J·ω² = 2·T/N
  EXPECT_NEAR(alone, std::sqrt(4 * 0.3 / 50 / 5e-6), 1e-6);
  for (const double ratio : {0.5, 1.0, 3.0, 8.0}) {
    EXPECT_NEAR(curve.maximum_starting_speed({.inertia = {ratio * 5e-6}}).value, alone / std::sqrt(1 + ratio), 1e-6);
  }
}

TEST(TorqueCurve, measured_pull_in_is_carried_to_a_load_by_the_same_rule) {
  const TorqueCurve curve = from_points({{Hertz(0), {0.4}}, {Hertz(5000), {0.2}}},
                                        {{Hertz(0), {0.3}}, {Hertz(600), {0.2}}, {Hertz(1200), {0}}});
  const auto starting = [&](const Load& load) { return curve.rate_at(curve.maximum_starting_speed(load)).value(); };
  EXPECT_NEAR(starting({}), 1200, 1e-6);
  EXPECT_NEAR(starting({.inertia = {15e-6}}), 600, 1e-6);
  EXPECT_NEAR(starting({.friction = {0.2}}), 600, 1e-6);
  EXPECT_NEAR(starting({.inertia = {15e-6}, .friction = {0.2}}), 300, 1e-6);
  EXPECT_EQ(starting({.friction = {0.35}}), 0);
  EXPECT_DOUBLE_EQ(curve.pull_in(curve.speed_at(Hertz(600)), {}).value, 0.2);
  EXPECT_EQ(curve.pull_in(curve.speed_at(Hertz(1300)), {}).value, 0);
}

TEST(TorqueCurve, pull_in_begins_at_pull_out_falls_and_stays_below_it) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int i = 0; i < 200; ++i) {
    const test::Driven driven = test::random_motor(random);
    const TorqueCurve curve = from_motor(driven.motor, driven.drive);
    const KilogramMetres2 inertia{driven.motor.rotor.inertia.value * static_cast<double>(random() % 5)};
    const double end = curve.maximum_starting_speed({.inertia = inertia}).value;
    double last = curve.pull_out({0}).value;
    EXPECT_DOUBLE_EQ(curve.pull_in({0}, inertia).value, last);
    for (double share = 0.02; share < 1; share += 0.02) {
      const double torque = curve.pull_in({share * end}, inertia).value;
      ASSERT_LE(torque, last);
      ASSERT_LE(torque, curve.pull_out({share * end}).value);
      ASSERT_GT(torque, 0);
      last = torque;
    }
    EXPECT_EQ(curve.pull_in({1.001 * end}, inertia).value, 0);
  }
}

// The rotor itself, integrated: the field turns at `speed` from the first moment, the torque goes with the sine of the
// lag, and dry friction holds a rotor that rests. Returns whether it ever reaches the field's speed.
bool rotor_starts(double torque, double friction, double inertia, double teeth, double speed) {
  const double swing = std::sqrt(torque * teeth / inertia);  // rad/s of the small oscillation
  const double h = std::min(1 / swing, 1 / (teeth * speed)) / 400;
  double rotor_angle = 0;
  double rotor_speed = 0;
  for (double t = 0; t < 400 / swing + 40 / (teeth * speed); t += h) {
    const auto pull = [&](double time, double angle) { return torque * std::sin(teeth * (speed * time - angle)); };
    if (rotor_speed == 0 && pull(t, rotor_angle) <= friction) continue;
    const auto change = [&](double time, double angle) { return (pull(time, angle) - friction) / inertia; };
    const double a1 = change(t, rotor_angle);
    const double a2 = change(t + h / 2, rotor_angle + h / 2 * rotor_speed);
    const double a3 = change(t + h / 2, rotor_angle + h / 2 * rotor_speed + h * h / 4 * a1);
    const double a4 = change(t + h, rotor_angle + h * rotor_speed + h * h / 2 * a2);
    rotor_angle += h * rotor_speed + h * h / 6 * (a1 + a2 + a3);
    rotor_speed += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (rotor_speed >= speed) return true;
    if (teeth * (speed * t - rotor_angle) > 2 * pi) return false;
  }
  return false;
}

TEST(TorqueCurve, a_simulated_rotor_starts_just_below_the_computed_speed_and_not_just_above) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 100; ++i) {
    const double torque = 0.05 + share(random);
    const double friction = torque * 0.95 * share(random);
    const double load = rotor.inertia.value * 4 * share(random);
    const double computed = flat(torque).maximum_starting_speed({.inertia = {load}, .friction = {friction}}).value;
    const double inertia = rotor.inertia.value + load;
    EXPECT_TRUE(rotor_starts(torque, friction, inertia, 50, 0.995 * computed)) << friction / torque;
    EXPECT_FALSE(rotor_starts(torque, friction, inertia, 50, 1.005 * computed)) << friction / torque;
  }
}

TEST(TorqueCurve, from_points_refuses_what_is_no_torque_curve_and_says_why) {
  const auto error = [](std::vector<TorquePoint> pull_out, std::vector<TorquePoint> pull_in = {}) {
    const auto curve = TorqueCurve::from_points(rotor, pull_out, pull_in);
    return curve ? std::string("accepted") : curve.error().message;
  };
  const std::vector<TorquePoint> good{{Hertz(0), {0.4}}, {Hertz(1000), {0.2}}};
  EXPECT_EQ(error(good), "accepted");
  EXPECT_EQ(error({{Hertz(0), {0.4}}}), "pull-out: a curve needs at least 2 points, not 1");
  EXPECT_EQ(error({{Hertz(0), {0.4}}, {Hertz(500), {0.5}}}),
            "pull-out: torque must fall with the rate, but rises to 0.5 N\u00B7m at 500 steps/s");
  EXPECT_EQ(error({{Hertz(-1), {0.4}}, {Hertz(500), {0.3}}}),
            "pull-out: rate and torque cannot be negative, but -1:0.4 is");
  EXPECT_EQ(error({{Hertz(0), {0.4}}, {Hertz(500), {-0.3}}}),
            "pull-out: rate and torque cannot be negative, but 500:-0.3 is");
  EXPECT_NE(error({{Hertz(600), {0.4}}, {Hertz(500), {0.3}}}).find("must be in ascending order"), std::string::npos);
  EXPECT_EQ(error({{Hertz(0), {0}}, {Hertz(500), {0}}}), "pull-out: the torque of all points is 0");
  EXPECT_NE(error({{Hertz(0), {std::numeric_limits<double>::infinity()}}, {Hertz(500), {0}}}), "accepted");
  EXPECT_EQ(error(good, {{Hertz(0), {0.3}}, {Hertz(900), {0.3}}}),
            "pull-in torque cannot be above pull-out torque, as at 900 steps/s");
  EXPECT_EQ(error(good, {{Hertz(0), {0.3}}}), "pull-in: a curve needs at least 2 points, not 1");
  EXPECT_EQ(TorqueCurve::from_points({.steps_per_revolution = 30, .inertia = {1e-6}}, good).error().message,
            "the full steps per revolution of a two-phase motor must be a multiple of 4, not 30");
}

TEST(TorqueCurve, a_load_that_pushes_or_weighs_less_than_nothing_is_refused) {
  EXPECT_TRUE(check(Load{}));
  EXPECT_FALSE(check(Load{.inertia = {-1}}));
  EXPECT_EQ(check(Load{.friction = {-0.1}}).error().message, "friction must be 0 N\u00B7m or more, not -0.1");
  EXPECT_FALSE(check(Load{.friction_per_speed = {std::nan("")}}));
}

}  // namespace
}  // namespace passo
