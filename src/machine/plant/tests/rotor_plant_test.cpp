#include "passo/plant/rotor_plant.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "passo/motor/example_motor.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

MotorSetup small_setup(const char* excitation = "microsteps:4") {
  return small_motor_setup(excitation, {0.02});
}

// Steps of motor 0 from rest at even acceleration, up to a rate, and then at that rate. Returns the time of the last.
Seconds drive(Plant& plant, int steps, double rate, double acceleration) {
  double time = 0;
  double at = std::sqrt(2 * acceleration);
  for (int i = 0; i < steps; ++i) {
    time += 1 / std::min(at, rate);
    at += acceleration / at;
    plant.pulse(Seconds(time), {1});
  }
  return Seconds(time);
}

TEST(RotorPlant, follows_gentle_motion_to_the_step) {
  RotorPlant plant;
  plant.stand_at({100, 7});
  plant.fit_motor(0, small_setup());
  drive(plant, 4000, 2000, 4000);
  EXPECT_TRUE(plant.settle(Seconds(2)));
  EXPECT_NEAR(plant.truth_at(Seconds(0)).positions[0], 4100, 0.3);
  EXPECT_EQ(plant.truth_at(Seconds(0)).positions[1], 7) << "no setup: as in an ideal plant";
  EXPECT_EQ(plant.record(0).lost, 0);
  EXPECT_LT(plant.record(0).most_lag, 1);
  EXPECT_TRUE(plant.losses().empty());
}

TEST(RotorPlant, tells_when_steps_were_lost_and_how_many) {
  RotorPlant plant;
  plant.fit_motor(0, small_setup());
  const Seconds end = drive(plant, 4000, 40'000, 2'000'000);
  EXPECT_TRUE(plant.settle(Seconds(2)));
  ASSERT_FALSE(plant.losses().empty());
  EXPECT_EQ(plant.losses()[0].motor, 0U);
  EXPECT_GT(plant.losses()[0].time, Seconds(0));
  EXPECT_LT(plant.losses()[0].time, end);
  const std::int64_t lost = plant.record(0).lost;
  EXPECT_GT(lost, 0);
  EXPECT_EQ(lost % 16, 0);
  EXPECT_NEAR(plant.truth_at(end).positions[0], 4000 - static_cast<double>(lost), 0.6);
}

TEST(RotorPlant, closes_its_switches_where_the_rotor_is) {
  RotorPlant plant;
  plant.fit_motor(0, small_setup());
  plant.add(TravelSwitch{.input = input_limit, .motor = 0, .at_high_end = true, .closes_at = 3900, .opens_at = 3890});
  EXPECT_EQ(plant.events_to_next_change(), 1);
  const Seconds end = drive(plant, 4000, 40'000, 2'000'000);  // loses steps before the switch
  plant.settle(Seconds(2));
  EXPECT_EQ(plant.inputs_at(end + Seconds(3)), 0);
}

TEST(RotorPlant, feels_a_cutting_force) {
  for (const double force : {0.1, 0.4}) {
    RotorPlant plant;
    plant.fit_motor(0, small_setup());
    plant.set_resistance(0, {force});
    drive(plant, 4000, 2000, 4000);
    plant.settle(Seconds(2));
    EXPECT_EQ(plant.record(0).lost != 0, force > 0.32) << force;
  }
}

TEST(RotorPlant, does_the_same_however_often_somebody_looks) {
  RotorPlant once;
  RotorPlant often;
  for (RotorPlant* plant : {&once, &often}) plant->fit_motor(0, small_setup());
  double time = 0;
  for (int i = 0; i < 500; ++i) {
    time += 1e-3;
    once.pulse(Seconds(time), {1});
    often.inputs_at(Seconds(time - 0.4e-3));
    often.pulse(Seconds(time), {1});
  }
  EXPECT_NEAR(once.truth_at(Seconds(time)).positions[0], often.truth_at(Seconds(time)).positions[0], 0.02);
}

// One plant is asked for its inputs after each pulse, and need not look at its places. The other looks each time. In
// some trials the motor loses steps on its way.
TEST(RotorPlant, its_switches_miss_nothing_between_two_looks) {
  for (const double rate : {700.0, 3000.0, 9000.0, 40'000.0}) {
    RotorPlant asked;
    asked.fit_motor(0, small_setup());
    asked.add(TravelSwitch{.input = input_limit, .at_high_end = true, .closes_at = 300, .opens_at = 280});
    asked.add(
        TravelSwitch{.input = input_limit << 1, .motor = 1, .at_high_end = true, .closes_at = 40, .opens_at = 40});
    RotorPlant watched = asked;
    double time = 0;
    std::uint16_t seen = 0;
    for (int i = 0; i < 3000; ++i) {
      const int way = i < 1000 || i >= 2000 ? 1 : -1;
      time += 1 / std::min(rate, 300.0 + 5 * (i % 1000));
      const MotorSteps steps{way, i % 16 == 0 ? way : 0};
      asked.pulse(Seconds(time), steps);
      watched.pulse(Seconds(time), steps);
      const Truth truth = watched.truth_at(Seconds(time));
      seen |= truth.inputs;
      ASSERT_EQ(asked.inputs_at(Seconds(time)), truth.inputs) << "pulse " << i << " at " << rate << " Hz";
    }
    EXPECT_EQ(seen, input_limit | input_limit << 1);
  }
}

}  // namespace
}  // namespace passo
