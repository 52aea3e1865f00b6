// A motor with an encoder in a plant: what the drive does when something holds the axis.
#include "passo/plant/encoder_drive.hpp"

#include <cmath>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/motor/example_motor.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

MotorSetup held_setup(const char* excitation = "microsteps:8") {
  return small_motor_setup(excitation, {0.02});
}

// One turn of the shaft has 1600 steps.
constexpr double counts_per_step = 4000.0 / 1600;
constexpr double run_rate = 4000;  // 2.5 turns a second
constexpr double run_acceleration = 20'000;

struct Hold {
  double from = 0.6;
  double until = 0.66;
  double torque = 2;  // the motor has 0.32
};

// There at an even rate and back, from rest to rest, while something holds the axis for a time.
void go(RotorPlant& plant, const Hold& hold, int steps = 4000) {
  double time = 0;
  const auto move = [&](int way) {
    const int ramp = static_cast<int>(run_rate * run_rate / (2 * run_acceleration));
    for (int i = 0; i < steps; ++i) {
      const int from_end = std::min({i + 1, steps - i, ramp});
      const double speed = std::min(run_rate, std::sqrt(2 * run_acceleration * from_end));
      const double next = time + 1 / speed;
      for (const double moment : {hold.from, hold.until}) {
        if (time < moment && next >= moment) {
          static_cast<void>(plant.truth_at(Seconds(moment)));
          plant.set_resistance(0, {moment == hold.from ? hold.torque : 0});
        }
      }
      time = next;
      plant.pulse(Seconds(time), {way});
    }
  };
  move(1);
  move(-1);
  plant.settle(Seconds(2));
}

TEST(EncoderDrive, recovers_an_axis_that_an_open_loop_loses) {
  RotorPlant open;
  RotorPlant closed;
  for (RotorPlant* plant : {&open, &closed}) plant->fit_motor(0, held_setup());
  closed.fit_encoder(0, {.counts_per_step = counts_per_step, .closes_loop = true});
  for (RotorPlant* plant : {&open, &closed}) go(*plant, {});
  EXPECT_NE(open.record(0).lost, 0);
  EXPECT_GT(std::abs(open.truth_at(Seconds(9)).positions[0]), 30);
  EXPECT_EQ(closed.record(0).lost, 0);
  EXPECT_NEAR(closed.truth_at(Seconds(9)).positions[0], 0, 1.0);
  // It was held for 60 ms at 4000 steps/s: 240 steps are 30 full steps.
  EXPECT_GT(closed.record(0).most_lag, 20);
  EXPECT_LT(closed.record(0).most_lag, 40);
  EXPECT_FALSE(closed.following_fault());
}

TEST(EncoderDrive, that_only_measures_moves_nothing) {
  RotorPlant without;
  RotorPlant with;
  for (RotorPlant* plant : {&without, &with}) plant->fit_motor(0, held_setup());
  with.fit_encoder(0, {.counts_per_step = counts_per_step});
  for (RotorPlant* plant : {&without, &with}) go(*plant, {});
  EXPECT_NEAR(with.truth_at(Seconds(9)).positions[0], without.truth_at(Seconds(9)).positions[0], 0.05);
  EXPECT_EQ(with.record(0).lost, without.record(0).lost);
}

TEST(EncoderDrive, leaves_an_axis_alone_that_follows) {
  RotorPlant open;
  RotorPlant closed;
  for (RotorPlant* plant : {&open, &closed}) plant->fit_motor(0, held_setup());
  closed.fit_encoder(0, {.counts_per_step = counts_per_step, .closes_loop = true});
  for (RotorPlant* plant : {&open, &closed}) go(*plant, {.torque = 0.1});
  EXPECT_NEAR(closed.truth_at(Seconds(9)).positions[0], open.truth_at(Seconds(9)).positions[0], 0.05);
  EXPECT_LT(closed.record(0).most_lag, 1);
}

TEST(EncoderDrive, gives_its_alarm_when_the_error_passes_the_limit) {
  for (const bool closes_loop : {false, true}) {
    RotorPlant plant;
    plant.fit_motor(0, held_setup());
    plant.fit_encoder(0, {.counts_per_step = counts_per_step, .most_error = 40, .closes_loop = closes_loop});
    go(plant, {});
    ASSERT_TRUE(plant.following_fault());
    EXPECT_EQ(plant.following_fault()->motor, 0U);
    EXPECT_GT(plant.following_fault()->time, Seconds(0.6));
    EXPECT_LT(plant.following_fault()->time, Seconds(0.66));
    EXPECT_GT(plant.following_fault()->error, 40);
    EXPECT_LT(plant.following_fault()->error, 46);
    EXPECT_NE(plant.inputs_at(Seconds(9)) & input_emergency_stop, 0);
  }
}

// Whatever holds the axis, and when: it comes back to the step. An open loop does not in many of the cases.
TEST(EncoderDrive, comes_back_from_random_holds) {
  std::mt19937_64 random(test::seed());
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int lost_open = 0;
  for (int i = 0; i < 30; ++i) {
    Hold hold;
    hold.from = between(0.02, 1.6);
    hold.until = hold.from + between(0.005, 0.15);
    hold.torque = between(0.2, 4);
    const char* const excitation = i % 3 == 0 ? "microsteps:4" : i % 3 == 1 ? "microsteps:16" : "half-step";
    SCOPED_TRACE(testing::Message() << i << ": " << hold.from << " " << hold.until << " " << hold.torque << excitation);
    for (const bool closes_loop : {false, true}) {
      RotorPlant plant;
      plant.fit_motor(0, held_setup(excitation));
      plant.fit_encoder(0, {.counts_per_step = counts_per_step, .closes_loop = closes_loop});
      go(plant, hold, 3000);
      if (!closes_loop) {
        lost_open += plant.record(0).lost != 0 ? 1 : 0;
      } else {
        EXPECT_EQ(plant.record(0).lost, 0);
        EXPECT_NEAR(plant.truth_at(Seconds(9)).positions[0], 0, 1.5);
      }
    }
  }
  EXPECT_GT(lost_open, 5);
}

}  // namespace
}  // namespace passo
