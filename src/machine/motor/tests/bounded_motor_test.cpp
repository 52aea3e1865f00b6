// The motor that is integrated only where its bound fails, against the one that always is.
#include "passo/motor/bounded_motor.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "example_motors.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

MotorSetup random_setup(std::mt19937_64& random) {
  const MotorData motor = random() % 2 == 0 ? test::small_motor() : test::large_motor();
  const char* const parts[] = {"microsteps:8", "microsteps:16", "microsteps:32"};
  const Excitation excitation = *Excitation::named(parts[random() % 3]);
  MotorSetup setup{.motor = motor, .drive = {.supply = {between(random, 24, 60)}}, .excitation = excitation};
  setup.damping = damping_of(motor);
  if (random() % 4 == 0) {
    const double top = motor.holding_torque.value / 1.5;
    const auto curve = TorqueCurve::from_points(
        motor.rotor, {{Hertz(0), {top}}, {Hertz(1000), {0.8 * top}}, {Hertz(4000), {0.2 * top}}});
    setup = measured_setup(*curve, excitation);
  }
  if (random() % 4 == 0) setup.weight = {between(random, -0.1, 0.1) * motor.holding_torque.value};
  if (random() % 4 == 0) setup.detent = {0.03 * motor.holding_torque.value};
  setup.load = {.inertia = {between(random, 0, 2) * motor.rotor.inertia.value},
                .friction = {between(random, 0.02, 0.15) * motor.holding_torque.value},
                .friction_per_speed = {}};
  return setup;
}

// Moves there and back, with rests between some of them. `act(time, way)` for each step.
template <typename Act>
void random_moves(std::mt19937_64& random, const MotorSetup& setup, const Act& act) {
  const double inertia = setup.motor.rotor.inertia.value + setup.load.inertia.value;
  const int steps = setup.excitation.steps_per_full_step();
  const double can = 0.7 * setup.motor.holding_torque.value / inertia * setup.motor.rotor.steps_per_revolution / 6.2832;
  // Most are gentle; some ask for more than the motor has.
  const double acceleration =
      can * steps * (random() % 4 == 0 ? between(random, 0.5, 1.6) : between(random, 0.05, 0.4));
  const double rate = steps * between(random, 100, 1500);
  const double grid = random() % 2 == 0 ? 1e-9 : between(random, 5e-6, 20e-6);  // as of an axis that is not the longest
  double time = 0;
  for (int move = 0; move < 6; ++move) {
    const int way = random() % 2 == 0 ? 1 : -1;
    const int count = static_cast<int>(between(random, 1, 400)) * steps;
    for (int i = 0; i < count; ++i) {
      time += 1 / std::min(rate, std::sqrt(2 * acceleration * (std::min(i, count - 1 - i) + 0.5)));
      act(std::ceil(time / grid) * grid, way);
    }
    if (random() % 2 == 0) time += between(random, 0.001, 0.3);
  }
}

struct Compared {
  double most_lag_in_full = 0;  // full steps
  double most_lag = 0;
  bool lost_in_full = false;
  bool lost = false;
  double apart = 0;  // full steps, until one loses steps
  double time = 0;
  double reduced = 0;
};

Compared compare(std::mt19937_64& random) {
  const MotorSetup setup = random_setup(random);
  BoundedMotor bounded(setup, Integration::where_needed);
  BoundedMotor full(setup, Integration::always);
  Compared result;
  random_moves(random, setup, [&](double time, int way) {
    for (BoundedMotor* motor : {&bounded, &full}) {
      motor->run(Seconds(time - result.time));
      motor->step(way);
    }
    result.lost |= bounded.slipped() != 0;
    result.lost_in_full |= full.slipped() != 0;
    if (!result.lost) result.most_lag = std::max(result.most_lag, std::abs(bounded.lag()));
    if (!result.lost_in_full) result.most_lag_in_full = std::max(result.most_lag_in_full, std::abs(full.lag()));
    if (!result.lost && !result.lost_in_full) {
      result.apart = std::max(result.apart, std::abs(full.place() - bounded.place()) / full.steps_per_full_step());
    }
    result.reduced += bounded.is_reduced() ? time - result.time : 0;
    result.time = time;
  });
  return result;
}

// docs/ramps/physics.md states these differences.
TEST(BoundedMotor, goes_and_fails_as_the_motor_that_is_always_integrated) {
  std::mt19937_64 random(test::seed());
  double time = 0;
  double reduced = 0;
  int losing = 0;
  std::vector<double> apart;  // of the motors that are never near their edge
  for (int trial = 0; trial < 100; ++trial) {
    const Compared one = compare(random);
    time += one.time;
    reduced += one.reduced;
    losing += one.lost_in_full;
    if (one.lost != one.lost_in_full) {
      EXPECT_GT(one.lost ? one.most_lag_in_full : one.most_lag, 1) << "trial " << trial << " was not at the edge";
    }
    if (one.lost_in_full || one.most_lag_in_full > 0.7) continue;
    EXPECT_FALSE(one.lost);
    apart.push_back(one.apart);
  }
  std::ranges::sort(apart);
  EXPECT_GT(losing, 5);
  EXPECT_GT(apart.size(), 40U);
  EXPECT_LT(apart[apart.size() / 2], 0.03);
  EXPECT_LT(apart[apart.size() * 9 / 10], 0.15);
  EXPECT_LT(apart.back(), 0.8);
  EXPECT_GT(reduced, 0.6 * time);
}

MotorSetup gentle_setup() {
  MotorSetup setup{
      .motor = test::small_motor(), .drive = {.supply = {24}}, .excitation = *Excitation::named("microsteps:16")};
  setup.damping = damping_of(setup.motor);
  setup.load.friction = {0.02};
  return setup;
}

TEST(BoundedMotor, is_integrated_in_full_where_the_supply_cannot_push_the_currents) {
  BoundedMotor motor(gentle_setup(), Integration::where_needed);
  double rate = 500;
  double left_at = 0;
  while (rate < 40'000) {
    motor.step(1);
    motor.run(Seconds(1 / rate));
    rate += 40'000 / rate;
    if (left_at == 0 && !motor.is_reduced()) left_at = rate;
  }
  // L·I·Δ = (24 V − R·I − K·ω)/f: where the current of a step is reached just before the next one.
  EXPECT_GT(left_at, 18'000);
  EXPECT_LT(left_at, 27'000);
  EXPECT_FALSE(motor.is_reduced());
  EXPECT_EQ(motor.slipped(), 0);
}

TEST(BoundedMotor, is_always_integrated_with_full_steps_and_with_resistors) {
  for (const char* const excitation : {"two-on", "half-step"}) {
    MotorSetup setup = gentle_setup();
    setup.excitation = *Excitation::named(excitation);
    EXPECT_FALSE(BoundedMotor(setup, Integration::where_needed).is_reduced());
  }
  MotorSetup resistive = gentle_setup();
  resistive.drive.regulation = Regulation::resistive;
  EXPECT_FALSE(BoundedMotor(resistive, Integration::where_needed).is_reduced());
  EXPECT_TRUE(BoundedMotor(gentle_setup(), Integration::where_needed).is_reduced());
}

TEST(BoundedMotor, does_the_same_however_often_somebody_looks) {
  BoundedMotor once(gentle_setup(), Integration::where_needed);
  BoundedMotor often(gentle_setup(), Integration::where_needed);
  for (int i = 0; i < 2000; ++i) {
    once.step(1);
    often.step(1);
    once.run(Seconds(0.4e-3));
    for (int part = 0; part < 4; ++part) often.run(Seconds(0.1e-3));
  }
  EXPECT_TRUE(often.is_reduced());
  EXPECT_NEAR(once.place(), often.place(), 1e-6);
}

TEST(BoundedMotor, comes_to_rest) {
  BoundedMotor motor(gentle_setup(), Integration::where_needed);
  for (int i = 0; i < 100; ++i) {
    motor.step(1);
    motor.run(Seconds(1e-3));
  }
  motor.run(Seconds(1));
  EXPECT_TRUE(motor.rests());
  EXPECT_TRUE(motor.is_reduced());
  EXPECT_NEAR(motor.place(), 100, 16 * 2 / 3.1416 * std::asin(0.02 / 0.318) + 1e-6);
}

}  // namespace
}  // namespace passo
