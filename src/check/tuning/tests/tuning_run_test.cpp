#include "passo/tuning/tuning_run.hpp"

#include "kit/example_machine.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

TEST(TuningPrograms, stay_within_the_travel_and_move_the_named_axes_only) {
  const MachineDescription machine = test::example_machine("strong-router");
  const auto check = [&](const std::string& text) {
    InterpreterOptions options;
    for (const AxisDescription& axis : machine.axes) {
      options.start[axis.axis] = (axis.travel_low + axis.travel_high) / 2;
    }
    Diagnostics findings;
    const bool good = check_program(ProgramReader::from_text("t", text), machine, options, findings).good;
    EXPECT_TRUE(good) << render(findings, false);
  };
  const std::string both = tuning_program(machine, {Axis::x, Axis::y});
  check(both);
  EXPECT_THAT(both, HasSubstr("G2 ")) << "circles, for X and Y";
  EXPECT_THAT(both, testing::Not(HasSubstr("Z")));
  const std::string one = tuning_program(machine, {Axis::x});
  check(one);
  EXPECT_THAT(one, testing::Not(HasSubstr("Y")));
  EXPECT_THAT(one, testing::Not(HasSubstr("G2 ")));
}

TEST(TuningRuns, lower_the_limits_until_the_motors_are_safe) {
  const MachineDescription machine = test::example_machine("strong-router");
  const auto result = tuned(machine, {.wish = {.margin = 0.3}, .axes = {Axis::x}});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->verdict, Verdict::safe);
  ASSERT_EQ(result->axes.size(), 1U);
  const AxisDescription& x = result->machine.axes[0];
  EXPECT_EQ(x.velocity, result->axes[0].velocity);
  EXPECT_EQ(x.acceleration, result->axes[0].acceleration);
  EXPECT_LT(x.velocity, machine.axes[0].velocity) << "above 80 mm/s such motors swing out of step by themselves";
  EXPECT_EQ(result->machine.axes[1].velocity, machine.axes[1].velocity) << "Y was not asked for";
  EXPECT_EQ(result->program, tuning_program(result->machine, {Axis::x})) << "this is what was judged";
}

TEST(TuningRuns, refuse_a_wish_that_no_motor_fulfils_and_name_the_axis) {
  const auto refused = tuned(test::example_machine("strong-router"), {.wish = {.margin = 0.999999}, .axes = {Axis::x}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::StartsWith("axis X: "));
}

}  // namespace
}  // namespace passo
