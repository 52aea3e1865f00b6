#include "passo/lab/answers.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/motor/example_motor.hpp"

namespace passo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

StepMove line_to(std::int64_t x, std::int64_t y) {
  return {.from = {0, 0}, .to = {x, y}, .arc = {}};
}

// The move of the reference: master and slaves, (10, 4).
TEST(InterpolationAnswer, HasTheColumnsOfEachPulse) {
  const std::string answer = interpolation_answer({.name = MethodName::lean}, line_to(10, 4));
  EXPECT_THAT(answer, StartsWith(R"({"name":"lean","half_loaded":false,"title":"lean")"));
  EXPECT_THAT(answer, HasSubstr(R"("pulses":10,"together":4,"idle":0)"));
  EXPECT_THAT(answer, HasSubstr(R"("x":[1,2,3,4,5,6,7,8,9,10],"y":[0,1,1,2,2,2,3,3,4,4])"));
  EXPECT_THAT(answer, HasSubstr(R"("judge":{"sum_x":["10",)"));
  EXPECT_THAT(answer, HasSubstr(R"("ideal":{"x":[0,10],"y":[0,4]})"));
}

TEST(InterpolationAnswer, TellsTheFootOfTheToolOnThePath) {
  const std::string answer = interpolation_answer({.name = MethodName::point_comparison}, line_to(1, 1));
  EXPECT_THAT(answer, HasSubstr(R"("foot_x":[0.4999)"));
}

TEST(InterpolationAnswer, OfSeveralAxesHasAColumnForEach) {
  const StepMove move{.from = {0, 0, 0}, .to = {3, -2, 1}, .arc = {}};
  const std::string answer = interpolation_answer({.name = MethodName::lean}, move);
  EXPECT_THAT(answer, HasSubstr(R"("places":[[1,2,3],[-1,-1,-2],[0,1,1]])"));
  EXPECT_THAT(answer, HasSubstr(R"("feet":[[)"));
  EXPECT_THAT(answer, HasSubstr("\"sum_z\""));
}

TEST(InterpolationAnswer, OfAListingTellsItsFault) {
  EXPECT_THAT(interpolation_answer({.name = MethodName::listing_rounding}, line_to(22, 15)),
              HasSubstr(R"("fault":{"right":"lean","first":11,"wrong":[11,12],"end":[22,15],"ends_right":true})"));
  EXPECT_THAT(interpolation_answer({.name = MethodName::listing_projection}, line_to(4, 4)),
              HasSubstr(R"("first":8,"wrong":[],"end":[4,3],"ends_right":false})"));
  EXPECT_THAT(interpolation_answer({.name = MethodName::lean}, line_to(22, 15)), Not(HasSubstr("fault")));
}

TEST(InterpolationAnswer, RefusesInWords) {
  StepMove arc{.from = {5, 0}, .to = {0, 5}, .arc = StepMove::Arc{.centre = {0, 0}}};
  EXPECT_EQ(interpolation_answer({.name = MethodName::slope_blocks}, arc),
            R"({"error":"slope-blocks is for lines; arcs are for point-comparison, dda and midpoint"})");
  EXPECT_THAT(interpolation_answer({}, line_to(std::int64_t{1} << 40, 1)), HasSubstr("exceeds"));
  EXPECT_THAT(interpolation_answer({}, line_to(most_entries + 1, 1)), HasSubstr("more than 20000 pulses"));
  EXPECT_THAT(interpolation_answer({}, {.from = {0}, .to = {1}, .arc = {}}), HasSubstr("fewer than two axes"));
  EXPECT_THAT(interpolation_answer({.name = MethodName::listing_slope_blocks}, line_to(5, 0)), HasSubstr("by zero"));
}

TEST(InterpolationAnswer, OfTheLongestMoveIsBounded) {
  EXPECT_LT(interpolation_answer({.name = MethodName::dda}, line_to(16'000, 9'000)).size(), std::size_t{8} << 20);
}

TEST(ComparisonAnswer, HasEachMethodThatTakesTheMove) {
  const std::string answer = comparison_answer(line_to(27, 10));
  for (const char* name : {"master-slave", "lean", "dda, half loaded", "slope-blocks", "point-comparison"}) {
    EXPECT_THAT(answer, HasSubstr(std::string("\"title\":\"") + name + "\""));
  }
  EXPECT_THAT(answer, Not(HasSubstr("midpoint")));
  EXPECT_THAT(comparison_answer(line_to(most_entries, 0)), HasSubstr("too long"));
}

TEST(WindingsAnswer, HasTheStatesOfThePlaces) {
  const std::string answer = windings_answer(*Excitation::named("two-on"), 200, -1, 1);
  EXPECT_THAT(answer, HasSubstr(R"("pattern":[9,3,6])"));
  EXPECT_THAT(answer, HasSubstr(R"("degrees":[-1.8,0,1.8])"));
  EXPECT_THAT(windings_answer(*Excitation::named("wave"), 200, 5, 4), StartsWith(R"({"error")"));
}

TEST(RampAnswer, HasIntervalsErrorsAndTheIdealLine) {
  RampRequest request;
  request.setup = {.clock = Hertz(250'000), .steps_per_turn = 400, .acceleration = {50}};
  request.method = RampMethod::table;
  request.steps = 8;
  const std::string answer = ramp_answer(request);
  EXPECT_THAT(answer, HasSubstr("\"ticks\":[6266,2595,1991,"));
  EXPECT_THAT(answer, HasSubstr("\"ideal_time_s\":[0,"));
  EXPECT_THAT(answer, HasSubstr("\"whole_ticks\":true"));
  request.setup.clock = Hertz(1e7);
  EXPECT_THAT(ramp_answer(request), HasSubstr("more than a table method's 16 bits hold"));
  request.steps = most_entries + 1;
  EXPECT_THAT(ramp_answer(request), HasSubstr("expected 1 to 20000 steps"));
  request.setup.clock = Hertz(0);
  EXPECT_THAT(ramp_answer(request), HasSubstr("the clock must be above 0 Hz"));
}

TEST(TorqueAnswer, HasPullOutAboveTheFrictionUpToTheFastestRate) {
  const MotorSetup motor = small_motor_setup("microsteps:64", {0.01});
  TorqueQuestion question{.motor = motor.motor, .drive = motor.drive, .load = motor.load, .rows = 5};
  EXPECT_THAT(torque_answer(question), HasSubstr("\"pull_out_nm\":[0.318"));
  question.acceleration = {5000};
  EXPECT_THAT(torque_answer(question), HasSubstr("\"needed_nm\":[0.078,"));
  question.margin = 2;
  EXPECT_THAT(torque_answer(question), HasSubstr("margin"));
  question.motor.resistance = {0};
  EXPECT_THAT(torque_answer(question), HasSubstr("resistance"));
}

// The first board: 13.8 V less a volt, 12.8 Ω and 10 mH; 1 A.
TEST(DriverAnswer, ComparesThreeStages) {
  MotorData motor = small_motor();
  motor.rated_current = {1};
  motor.resistance = {12.8};
  motor.inductance = {10e-3};
  DriverQuestion question{.motor = motor,
                          .supply = {13.8},
                          .raised = {36},
                          .series = {22.2},
                          .ripple = 0.1,
                          .rate = Hertz(1000),
                          .logic = {5},
                          .reserve = 0.3,
                          .base = {470}};
  const std::string answer = driver_answer(question);
  EXPECT_THAT(answer, StartsWith(R"({"plain":{"final_a":1,"tau_s":0.00078)"));
  EXPECT_THAT(answer, HasSubstr(R"("series":{"final_a":1,"tau_s":0.000285714)"));
  EXPECT_THAT(answer, HasSubstr(R"("chopper":{"final_a":2.734375,"tau_s":0.00078)"));
  EXPECT_THAT(answer, HasSubstr(R"("base":{"needed_a":0.0013333)"));
  EXPECT_THAT(answer, HasSubstr(R"("largest_ohm":2076.9)"));
  question.raised = {0.5};
  EXPECT_THAT(driver_answer(question), HasSubstr("the supply must be above the transistor's drop"));
  question.base = {0};
  EXPECT_THAT(driver_answer(question), HasSubstr("base resistor"));
}

// A small inductance at a low rate: half a billion switchings in the two periods that are shown.
TEST(DriverAnswer, OfAFastChopperIsGivenAtOnce) {
  MotorData motor = small_motor();
  motor.rated_current = {1};
  motor.resistance = {12.8};
  motor.inductance = {1e-5};
  DriverQuestion question{.motor = motor,
                          .supply = {13.8},
                          .raised = {400},
                          .series = {22.2},
                          .ripple = 0.01,
                          .rate = Hertz(1),
                          .logic = {5},
                          .reserve = 0.3,
                          .base = {470}};
  const auto before = std::chrono::steady_clock::now();
  EXPECT_THAT(driver_answer(question), HasSubstr(R"("chopper":{"final_a")"));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
}

TEST(LoopAnswer, HasTheResponseAndItsFigures) {
  LoopSetup setup{.motor = small_motor_setup("microsteps:64", {0.01})};
  setup.to = 30;
  setup.gains = {.kp = 0.02, .ki = 2};
  EXPECT_THAT(loop_answer(setup, Seconds(0.02)), HasSubstr("\"overshoot\":0.1"));
  EXPECT_THAT(ultimate_answer(setup), HasSubstr("\"pi\":{\"kp\":0.04"));
  EXPECT_THAT(loop_answer(setup, Seconds(100)), HasSubstr("periods"));
  setup.to = 0;
  EXPECT_THAT(loop_answer(setup, Seconds(0.02)), HasSubstr("a step other than 0"));
}

}  // namespace
}  // namespace passo
