#include "passo/judge/proposals.hpp"

#include <cmath>

#include "judged_program.hpp"

namespace passo {
namespace {

// X, Y and Z without limits of their own but the travel.
MachineDescription small_machine(double low, double high) {
  MachineDescription machine = test::example_machine("router");
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = axis.axis == Axis::z ? -50 : low;
    axis.travel_high = axis.axis == Axis::z ? 50 : high;
  }
  machine.homing = {};
  return machine;
}

template <class T>
std::optional<T> only_one(const test::JudgedProgram& program) {
  const std::vector<Proposal> all = program.proposals();
  EXPECT_EQ(all.size(), 1U);
  if (all.size() != 1 || !std::holds_alternative<T>(all[0])) return {};
  return std::get<T>(all[0]);
}

TEST(Proposals, of_another_zero_let_the_program_fit_the_travel) {
  test::JudgedProgram program(small_machine(0, 100), "G21 G90\nG0 X5 Y5\nG55 G0 X-12.4 Y10\nX50\nM2\n");
  ASSERT_FALSE(program.check.good);
  const auto zeros = only_one<proposal::WorkZeros>(program);
  ASSERT_TRUE(zeros);
  ASSERT_EQ(zeros->zeros.size(), 1U) << "only G55 leaves the travel, and only in X";
  EXPECT_EQ(zeros->zeros[0].system, 2);
  EXPECT_EQ(zeros->zeros[0].axis, Axis::x);
  EXPECT_EQ(zeros->zeros[0].zero, 13) << "whole millimetres, where there is room for that";
  program.options.parameters[5241] = zeros->zeros[0].zero;
  program.check_again();
  EXPECT_TRUE(program.check.good);
}

TEST(Proposals, name_an_axis_that_no_zero_makes_long_enough) {
  const auto axis = only_one<proposal::AxisTooShort>({small_machine(0, 100), "G21 G90\nG0 X10\nG0 X130.5\nM2\n"});
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->axis, Axis::x);
  EXPECT_NEAR(axis->needed, 120.5, 1e-9);
  EXPECT_EQ(axis->travel, 100);
}

TEST(Proposals, are_none_where_the_place_follows_no_zero) {
  const MachineDescription machine = small_machine(0, 100);
  EXPECT_TRUE(test::JudgedProgram(machine, "G21 G90\nG53 G0 X-5\nM2\n").proposals().empty());
  EXPECT_TRUE(test::JudgedProgram(machine, "G21 G90\nG10 L2 P1 X-20\nG0 X5\nM2\n").proposals().empty());
  EXPECT_TRUE(test::JudgedProgram(machine, "G21 G90\nG0 X5\nM2\n").proposals().empty()) << "nothing is wrong";
}

TEST(Proposals, of_tools_name_those_that_are_missing) {
  const auto tools =
      only_one<proposal::Tools>({small_machine(-100, 100), "G21 G90\nT1 M6\nG0 X1\nT5 M6\nG0 X2\nT4 M6\nG0 X3\nM2\n"});
  ASSERT_TRUE(tools);
  EXPECT_EQ(tools->numbers, (std::vector<std::int32_t>{5, 4})) << "in the program's order";
  const std::string worse = "G21 G90\nT5 M6\nG53 G0 X900\nM2\n";
  EXPECT_TRUE(test::JudgedProgram(small_machine(-100, 100), worse).proposals().empty());
}

TEST(Proposals, of_a_spindle_speed_let_the_axes_follow_a_thread) {
  const MachineDescription machine = small_machine(-100, 100);
  const auto thread = [](double rpm) {
    return "G21 G90\nS" + std::to_string(rpm) + " M3\nG0 Z10\nG33 Z-10 K4\nM5\nM2\n";
  };
  const auto spindle = only_one<proposal::SpindleForThread>({machine, thread(9000)});
  ASSERT_TRUE(spindle);
  const double rpm = spindle->revolutions_per_minute;
  EXPECT_EQ(rpm, std::floor(machine.axes[2].velocity.value() / 4 * 60));
  EXPECT_TRUE(test::JudgedProgram(machine, thread(rpm)).check.good);
  EXPECT_FALSE(test::JudgedProgram(machine, thread(rpm + 1)).check.good);
}

TEST(Proposals, of_slower_feeds_keep_the_chip_where_the_spindle_is_slower) {
  MachineDescription machine = small_machine(-100, 100);
  machine.tool.highest_rpm = 10'000;
  const auto slower = only_one<proposal::SpindleAndFeed>({machine, "G21 G90\nS13000 M3\nG4 P1\nG1 X50 F600\nM5\nM2\n"});
  ASSERT_TRUE(slower);
  EXPECT_EQ(slower->revolutions_per_minute, 10'000);
  EXPECT_EQ(slower->feed_percent, 76);
  EXPECT_NEAR(slower->motion.value(), 50 / 7.6, 0.2);
  const std::string by_turn = "G21 G90\nS13000 M3\nG4 P1\nG95 G1 X50 F0.1\nM5\nM2\n";
  EXPECT_TRUE(test::JudgedProgram(machine, by_turn).proposals().empty()) << "such feeds are slower by themselves";
}

TEST(Proposals, of_an_override_let_the_motors_keep_their_steps) {
  Diagnostics diagnostics;
  const auto machine = load_machine_file(PASSO_SOURCE_DIR "/examples/troubles/too-fast.toml", diagnostics);
  ASSERT_TRUE(machine);
  const auto source = ProgramReader::open(PASSO_SOURCE_DIR "/examples/troubles/too-fast.ngc");
  ASSERT_TRUE(source);
  test::JudgedProgram program(*machine, "M2\n");
  program.program = source->again();
  program.check_again();
  EXPECT_TRUE(program.judge().lost());
  const auto override = only_one<proposal::SlowerMotion>(program);
  ASSERT_TRUE(override);
  EXPECT_EQ(override->feed_percent, 100) << "it is the rapids that are too fast";
  ASSERT_LT(override->rapid_percent, 100);
  const double share = override->rapid_percent / 100.0;
  EXPECT_EQ(program.judge({}, {.rapids = share}).margin.verdict, Verdict::safe);
  EXPECT_NE(program.judge({}, {.rapids = share + 0.1}).margin.verdict, Verdict::safe) << "it is the fastest";
}

}  // namespace
}  // namespace passo
