// AxisTuner on a motor whose torque is simple, so that the proposal can be computed by hand.
#include "passo/tuning/axis_tuner.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double radians_per_mm = 2 * std::numbers::pi / 5;
constexpr double rotor = 1e-5;  // kg·m²
const BoardDescription board{.clock = Hertz(72e6), .highest_event_rate = Hertz(400e3)};

// The torque falls evenly from 1 N·m to 0.2 N·m at 5000 full steps/s, which are 125 mm/s. Sixteen microsteps.
AxisDescription axis_with(double friction, double tolerance = 0) {
  const auto curve = TorqueCurve::from_points({.steps_per_revolution = 200, .inertia = {rotor}},
                                              {{Hertz(0), {1.0}}, {Hertz(2500), {0.6}}, {Hertz(5000), {0.2}}});
  AxisDescription axis;
  axis.steps_per_unit = 640;
  axis.travel_low = -100;
  axis.travel_high = 100;
  axis.velocity = MmPerSecond(50);
  axis.acceleration = MmPerSecond2(1000);
  axis.motor = AxisMotor{.curve = *curve,
                         .load = {.inertia = {rotor}, .friction = {friction}},
                         .tolerance = tolerance,
                         .limits_motion = false,
                         .radians_per_unit = radians_per_mm};
  return axis;
}

AxisTuning tuning_of(const AxisDescription& axis, const TuningWish& wish) {
  const auto tuner = AxisTuner::of(axis, board);
  EXPECT_TRUE(tuner);
  auto tuning = tuner->propose(wish);
  EXPECT_TRUE(tuning) << (tuning ? "" : tuning.error().message);
  return tuning ? *tuning : AxisTuning{};
}

TEST(AxisTuner, leaves_the_margin_at_the_proposed_velocity) {
  for (const double margin : {0.1, 0.3, 0.6}) {
    const AxisTuning tuning = tuning_of(axis_with(0.05), {.margin = margin});
    const TuningPoint* at_velocity = nullptr;
    for (const TuningPoint& point : tuning.curve) {
      if (point.speed <= tuning.velocity) at_velocity = &point;
    }
    ASSERT_NE(at_velocity, nullptr);
    EXPECT_LE(at_velocity->needed.value, at_velocity->usable.value);
    EXPECT_GT(at_velocity->needed.value, 0.9 * at_velocity->usable.value);
    EXPECT_NEAR(at_velocity->usable.value, (1 - margin) * at_velocity->pull_out.value, 1e-9);
  }
}

// Shares no code with the tuner: the torque by hand, every velocity of a fine grid, and the time by small steps.
TEST(AxisTuner, finds_a_velocity_that_makes_the_reference_move_short) {
  constexpr double margin = 0.3;
  const AxisTuning tuning = tuning_of(axis_with(0.05), {.margin = margin, .way = 30});
  const auto time_with = [&](double v) {
    const double torque = 0.97 * (1 - 0.8 * v / 125);
    const double a = ((1 - margin) * torque - 0.05) / (2 * rotor) / radians_per_mm;
    return 30 / v + v / a;
  };
  double shortest = 1e9;
  for (double v = 1; v < 125; v += 0.5) shortest = std::min(shortest, time_with(v));
  EXPECT_LE(time_with(tuning.velocity.value()), 1.03 * shortest);
  EXPECT_NEAR(tuning.time.value(), time_with(tuning.velocity.value()), 0.03);
}

TEST(AxisTuner, takes_one_period_of_the_ringing_for_the_acceleration) {
  const AxisTuning tuning = tuning_of(axis_with(0.05), {.margin = 0.3});
  const double ringing = tuning.acceleration.value() / tuning.jerk.value();
  EXPECT_NEAR(ringing, tuning.period.value(), 0.02 * ringing);
  const double torque = 0.97 * (1 - 0.8 * tuning.velocity.value() / 125);
  const double stiffness = 50 * torque * std::sqrt(1 - 0.7 * 0.7);
  EXPECT_NEAR(tuning.period.value(), 2 * std::numbers::pi * std::sqrt(2 * rotor / stiffness), 0.02 * ringing);
}

TEST(AxisTuner, gives_less_to_weaker_motors_and_to_friction) {
  const AxisTuning usual = tuning_of(axis_with(0.05), {.margin = 0.3});
  const auto strength = [](const AxisTuning& tuning) { return 1 / tuning.time.value(); };
  EXPECT_LT(strength(tuning_of(axis_with(0.05, 0.3), {.margin = 0.3})), strength(usual));
  EXPECT_LT(strength(tuning_of(axis_with(0.3), {.margin = 0.3})), strength(usual));
  EXPECT_LT(strength(tuning_of(axis_with(0.05), {.margin = 0.6})), strength(usual));
}

TEST(AxisTuner, heeds_the_board_and_the_wish) {
  const AxisTuning wished = tuning_of(axis_with(0.05), {.margin = 0.3, .fastest = MmPerSecond(20)});
  EXPECT_LE(wished.velocity, MmPerSecond(20));
  EXPECT_GT(wished.velocity, MmPerSecond(19.5));
  EXPECT_EQ(wished.bound, TuningBound::wish);
  const auto slow = AxisTuner::of(axis_with(0.05), {.clock = Hertz(16e6), .highest_event_rate = Hertz(6400)});
  const auto tuning = slow->propose({.margin = 0.3});
  ASSERT_TRUE(tuning);
  EXPECT_LE(tuning->velocity, MmPerSecond(10));
  EXPECT_EQ(tuning->bound, TuningBound::board);
}

TEST(AxisTuner, refuses_a_load_that_takes_all) {
  const auto tuner = AxisTuner::of(axis_with(0.6), board);
  const auto tuning = tuner->propose({.margin = 0.3});
  ASSERT_FALSE(tuning);
  EXPECT_NE(tuning.error().message.find("friction and weight need"), std::string::npos);
  AxisDescription unknown = axis_with(0.05);
  unknown.motor.reset();
  EXPECT_FALSE(AxisTuner::of(unknown, board));
}

// The move is played in small steps: no phase may break a limit, and the move ends where and when it should.
TEST(AxisTuner, knows_the_time_of_a_move) {
  for (const double way : {0.01, 1.0, 20.0, 300.0}) {
    const double v = 40;
    const double a = 500;
    const double j = 20'000;
    const double half = time_of_move(way, MmPerSecond(v), MmPerSecond2(a), MmPerSecond3(j)).value() / 2;
    constexpr int steps = 200'000;
    const double h = half / steps;
    double speed = 0;
    double gain = 0;
    double place = 0;
    // The fastest first half: raise the acceleration, hold it, and lower it so that it ends with the speed's peak.
    const double peak = [&] {
      double low = 0;
      double high = v;
      for (int i = 0; i < 80; ++i) {
        const double middle = (low + high) / 2;
        const double ramp = middle >= a * a / j ? middle / a + a / j : 2 * std::sqrt(middle / j);
        (middle * ramp <= way ? low : high) = middle;
      }
      return low;
    }();
    for (int i = 0; i < steps; ++i) {
      const double left = peak - speed;
      const double most = std::min(a, std::sqrt(std::max(2 * j * left, 0.0)));
      gain = std::min(gain + j * h, most);
      speed = std::min(speed + gain * h, peak);
      place += speed * h;
    }
    EXPECT_NEAR(place, way / 2, 0.002 * way) << way;
  }
}

}  // namespace
}  // namespace passo
