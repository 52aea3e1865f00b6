#include "passo/feedback/loop_trial.hpp"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "passo/motor/example_motor.hpp"

namespace passo {
namespace {

TEST(ServoMotor, gives_the_torque_that_is_asked_for) {
  const ShaftEncoder encoder(40'000);
  ServoMotor motor(small_motor_setup("microsteps:64", {0}), encoder, Seconds(0.0002));
  for (int i = 0; i < 20; ++i) motor.run({0.1}, motor.speed());
  // 4 ms of 0.1 N·m on 136 g·cm², less the time that the currents need.
  const double without_delay = 0.1 / 136e-7 * 0.004;
  EXPECT_LT(motor.speed().value, without_delay);
  EXPECT_GT(motor.speed().value, 0.8 * without_delay);
  EXPECT_NEAR(motor.most_torque().value, 0.45 / std::sqrt(2.0), 1e-9);
}

LoopSetup speed_loop() {
  return {.motor = small_motor_setup("microsteps:64", {0.01}), .counts_per_turn = 4000, .to = 30};
}

TEST(LoopTrial, a_speed_loop_with_an_integral_leaves_no_error) {
  LoopSetup setup = speed_loop();
  setup.gains = {.kp = 0.003};
  const auto with_p = figures_of(step_response(setup, Seconds(0.6)), setup);
  setup.gains.ki = 0.1;
  const auto with_pi = figures_of(step_response(setup, Seconds(0.6)), setup);
  EXPECT_GT(with_p.error, 1);
  EXPECT_LT(std::abs(with_pi.error), 0.3);
  ASSERT_TRUE(with_pi.settled);
}

TEST(LoopTrial, finds_the_gain_at_which_a_loop_swings) {
  const auto cycle = ultimate_cycle(speed_loop());
  ASSERT_TRUE(cycle);
  std::printf("Ku %g Tu %g ms\n", cycle->gain, cycle->period.value() * 1e3);
  LoopSetup setup = speed_loop();
  const auto swing_with = [&](double share) {
    setup.gains = {.kp = share * cycle->gain};
    return figures_of(step_response(setup, Seconds(0.6)), setup).swing;
  };
  EXPECT_LT(swing_with(0.5), 0.15 * swing_with(1.2));
  EXPECT_GT(swing_with(1.2), 0.05 * setup.to);
}

TEST(LoopTrial, a_position_loop_goes_there_and_stays) {
  LoopSetup setup = speed_loop();
  setup.speed_gains = ziegler_nichols_pi(*ultimate_cycle(setup));
  setup.controlled = Controlled::position;
  setup.to = 1.5;
  setup.gains = {.kp = 40};
  const auto figures = figures_of(step_response(setup, Seconds(0.5)), setup);
  EXPECT_LT(std::abs(figures.error), 0.01);
  EXPECT_LT(figures.overshoot, 0.1);
  ASSERT_TRUE(figures.settled);
  EXPECT_LT(*figures.settled, Seconds(0.2));
}

TEST(LoopTrial, does_not_lose_a_step_whatever_holds_it) {
  LoopSetup setup = speed_loop();
  setup.gains = {.kp = 0.01, .ki = 0.2};
  setup.load = {2};  // six times what the motor has
  setup.load_at = Seconds(0.1);
  const auto moments = step_response(setup, Seconds(0.3));
  EXPECT_NEAR(moments.back().speed.value, 0, 1);
  EXPECT_GT(moments.back().asked.value, 0.3);
}

TEST(LoopTrial, gives_the_same_numbers_again) {
  LoopSetup setup = speed_loop();
  setup.gains = {.kp = 0.01, .ki = 0.2};
  const auto a = step_response(setup, Seconds(0.1));
  const auto b = step_response(setup, Seconds(0.1));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].is, b[i].is);
}

}  // namespace
}  // namespace passo
