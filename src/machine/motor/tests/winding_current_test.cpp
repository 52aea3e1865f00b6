#include "passo/motor/winding_current.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/motor/darlington.hpp"

namespace passo {
namespace {

// The first board: 13.8 V, a volt at the Darlington, 1 A, 10 mH.
WindingCircuit first_stage() {
  return {.supply = {13.8}, .drop = {1}, .diode = {0.7}, .winding = {12.8}, .inductance = {10e-3}};
}

double after(const WindingCircuit& circuit, double seconds, double share = 1) {
  WindingCurrent current(circuit);
  current.switch_to(share);
  current.run(Seconds(seconds));
  return current.now().value;
}

TEST(WindingCurrent, rises_by_the_closed_formula) {
  const WindingCircuit circuit = first_stage();
  EXPECT_DOUBLE_EQ(circuit.final().value, 1);
  EXPECT_DOUBLE_EQ(circuit.time_constant().value(), 10e-3 / 12.8);
  for (const double t : {0.0, 1e-5, 3e-4, 10e-3 / 12.8, 5e-3}) {
    EXPECT_NEAR(after(circuit, t), 12.8 / 12.8 * (1 - std::exp(-t * 12.8 / 10e-3)), 1e-12) << t;
  }
  EXPECT_NEAR(after(circuit, circuit.rise_time({0.9})->value()), 0.9, 1e-12);
  EXPECT_FALSE(circuit.rise_time({1}));
}

TEST(WindingCurrent, rises_in_pieces_as_in_one) {
  const WindingCircuit circuit = first_stage();
  WindingCurrent current(circuit);
  current.switch_to(1);
  for (int i = 0; i < 1000; ++i) current.run(Seconds(1e-6));
  EXPECT_NEAR(current.now().value, after(circuit, 1e-3), 1e-12);
}

// A supply of twice the voltage with a resistor as large as the winding's: the same current in half the time.
TEST(WindingCurrent, rises_in_half_the_time_with_twice_the_voltage_and_a_series_resistor) {
  const WindingCircuit plain = first_stage();
  WindingCircuit raised = plain;
  raised.supply.value = 26.6;
  raised.series.value = 12.8;
  EXPECT_DOUBLE_EQ(raised.final().value, 1);
  for (const double t : {1e-4, 5e-4, 2e-3}) EXPECT_NEAR(after(raised, t / 2), after(plain, t), 1e-12);
}

TEST(WindingCurrent, of_a_chopper_rises_with_the_whole_voltage_and_stays_in_its_band) {
  WindingCircuit chopper = first_stage();
  chopper.supply.value = 36;
  chopper.limit = Amperes{1};
  chopper.ripple = 0.1;
  const double reached = chopper.rise_time({1})->value();
  EXPECT_NEAR(reached, -10e-3 / 12.8 * std::log(1 - 12.8 / 35), 1e-12);
  EXPECT_NEAR(after(chopper, reached / 2), 35 / 12.8 * (1 - std::exp(-reached / 2 * 12.8 / 10e-3)), 1e-12);

  WindingCurrent current(chopper);
  current.switch_to(1);
  current.run(Seconds(reached));
  // It falls through the diode alone, and is pushed up again: these two times are one period.
  const double falls = 10e-3 / 12.8 * std::log((1 + 0.7 / 12.8) / (0.9 + 0.7 / 12.8));
  const double rises = 10e-3 / 12.8 * std::log((35 / 12.8 - 0.9) / (35 / 12.8 - 1));
  current.run(Seconds(falls));
  EXPECT_NEAR(current.now().value, 0.9, 1e-9);
  current.run(Seconds(rises));
  EXPECT_NEAR(current.now().value, 1, 1e-9);
  for (int i = 0; i < 5000; ++i) {
    current.run(Seconds(1.7e-6));
    EXPECT_GE(current.now().value, 0.9 - 1e-12);
    EXPECT_LE(current.now().value, 1 + 1e-12);
  }
  chopper.ripple = 0;
  EXPECT_EQ(after(chopper, 1), 1) << "held";
  EXPECT_EQ(after(chopper, 1, 0.5), 0.5);
}

// A hundred million switchings: whole periods of the ripple are passed over, and the rest of the time counts.
TEST(WindingCurrent, of_a_fast_chopper_is_known_at_once_after_a_long_time) {
  WindingCircuit chopper = first_stage();
  chopper.supply.value = 400;
  chopper.inductance.value = 1e-5;
  chopper.limit = Amperes{1};
  chopper.ripple = 0.01;
  EXPECT_GE(after(chopper, 4), 0.99 - 1e-12);
  EXPECT_LE(after(chopper, 4), 1 + 1e-12);
  chopper.inductance.value = 10e-3;
  WindingCurrent at_once(chopper);
  WindingCurrent in_parts(chopper);
  for (WindingCurrent* current : {&at_once, &in_parts}) current->switch_to(1);
  at_once.run(Seconds(0.02));
  for (int i = 0; i < 20'000; ++i) in_parts.run(Seconds(1e-6));
  EXPECT_NEAR(at_once.now().value, in_parts.now().value, 1e-6);
}

TEST(WindingCurrent, of_a_chopper_with_too_little_voltage_is_that_of_the_resistance) {
  WindingCircuit chopper = first_stage();
  chopper.limit = Amperes{2};
  EXPECT_NEAR(after(chopper, 1e-3), after(first_stage(), 1e-3), 1e-12);
}

TEST(WindingCurrent, falls_through_the_diode_to_zero_and_stays_there) {
  const WindingCircuit circuit = first_stage();
  WindingCurrent current(circuit);
  current.switch_to(1);
  current.settle();
  EXPECT_DOUBLE_EQ(current.now().value, 1);
  current.switch_to(0);
  current.run(Seconds(5e-4));
  const double end = -0.7 / 12.8;
  EXPECT_NEAR(current.now().value, end + (1 - end) * std::exp(-5e-4 * 12.8 / 10e-3), 1e-12);
  EXPECT_FALSE(current.is_settled({1}));
  current.run(Seconds(1));
  EXPECT_EQ(current.now().value, 0);
  EXPECT_TRUE(current.is_settled({1}));
}

TEST(WindingCurrent, follows_a_limit_that_falls) {
  WindingCircuit chopper = first_stage();
  chopper.supply.value = 36;
  chopper.limit = Amperes{1};
  WindingCurrent current(chopper);
  current.switch_to(1);
  current.settle();
  current.switch_to(0.5);
  current.run(Seconds(1e-4));
  EXPECT_LT(current.now().value, 1);
  EXPECT_GT(current.now().value, 0.5);
  current.run(Seconds(0.1));
  EXPECT_EQ(current.now().value, 0.5);
}

TEST(WindingCircuit, is_checked) {
  EXPECT_TRUE(check(first_stage()));
  WindingCircuit wrong = first_stage();
  wrong.drop.value = 14;
  EXPECT_THAT(check(wrong).error().message, testing::HasSubstr("above the transistor's drop, not 13.8 V"));
  wrong = first_stage();
  wrong.series.value = -1;
  EXPECT_FALSE(check(wrong));
  wrong = first_stage();
  wrong.ripple = 1e-6;
  EXPECT_FALSE(check(wrong));
}

// 1 A, gain 750, 5 V less 1.4 V: 30 % more than needed is 2077 Ω at most, and 470 Ω gives 5.7 times the need.
TEST(Darlington, has_an_ample_base_resistor_on_the_first_board) {
  const BaseResistor base = base_resistor_of({}, {1}, {5}, 0.3, {470});
  EXPECT_NEAR(base.needed.value, 1.333e-3, 1e-6);
  EXPECT_NEAR(base.wanted.value, 1.733e-3, 1e-6);
  EXPECT_NEAR(base.largest.value, 2077, 1);
  EXPECT_NEAR(base.given.value, 7.66e-3, 1e-5);
  EXPECT_NEAR(base.overdrive, 5.745, 1e-3);
  EXPECT_DOUBLE_EQ(base.heat.value, 1);
  EXPECT_DOUBLE_EQ(base.warmer, 31);
}

}  // namespace
}  // namespace passo
