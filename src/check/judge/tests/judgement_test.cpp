#include "passo/judge/judgement.hpp"

#include <algorithm>

#include "judged_program.hpp"

#include "passo/activity/stage_options.hpp"
#include "passo/report/summary_builder.hpp"

namespace passo {
namespace {

const std::string with_tools =
    "G21 G90 G64 P0.01\nT1 M6\n(start)\nG0 X10\nG1 X40 F600\nG4 P1.5\nT2 M6\nG1 Y10\nG0 X0 Y0\nM2\n";

TEST(Judgements, tell_how_long_a_program_takes_and_how_far_it_goes) {
  const test::JudgedProgram program(test::example_machine("router"), with_tools);
  const Judgement judged = program.judge();
  EXPECT_EQ(judged.tool_changes, 2U);
  EXPECT_NEAR(judged.summary.dwell_time.value(), 1.5, 1e-9);
  EXPECT_NEAR(judged.summary.cutting_distance.value(), 40, 1e-6);
  EXPECT_GT(judged.summary.cutting_time, Seconds(4)) << "40 mm at 10 mm/s";
  EXPECT_LT(judged.summary.cutting_time, Seconds(5));
  EXPECT_FALSE(judged.knows_motors) << "the machine file does not describe them";
  EXPECT_FALSE(judged.lost());
  EXPECT_FALSE(judged.line);
  EXPECT_NEAR(judged.summary.time().value(), program.planned_time().value(), 1e-9);
}

TEST(Judgements, are_slower_with_slower_overrides) {
  const test::JudgedProgram program(test::example_machine("router"), with_tools);
  const Judgement full = program.judge();
  const Judgement half = program.judge({}, {.feed = 0.5});
  EXPECT_GT(half.summary.cutting_time, 1.8 * full.summary.cutting_time);
  EXPECT_NEAR(half.summary.rapid_time / full.summary.rapid_time, 1, 0.02) << "but for where a rapid meets a feed";
}

TEST(Judgements, know_the_motors_and_give_the_load_to_all_who_watch) {
  const test::JudgedProgram program(test::example_machine("strong-router"), with_tools);
  const Judgement alone = program.judge();
  ASSERT_TRUE(alone.knows_motors);
  ASSERT_FALSE(alone.margin.worst.empty());
  PathRecorder path;
  LoadTrack track;
  LineTorques lines;
  const Judgement watched = program.judge({.path = &path, .track = &track, .lines = &lines});
  EXPECT_EQ(watched.margin.verdict, alone.margin.verdict) << "watching changes nothing";
  EXPECT_EQ(watched.summary.time(), alone.summary.time());
  EXPECT_FALSE(path.empty());
  double most = 0;
  for (const LoadTrack::Stretch& stretch : track.stretches()) most = std::max(most, stretch.load);
  EXPECT_GT(most, 0);
  EXPECT_THAT(lines.text(), testing::StartsWith("line,load\n4,"));
  EXPECT_THAT(lines.text(), testing::HasSubstr("\n8,"));
  EXPECT_THAT(lines.text(), testing::Not(testing::HasSubstr("\n6,"))) << "a dwell does not move";
}

// The judgement has a thread for each watcher. One thread finds the same, to the last bit.
TEST(Judgements, are_those_of_watchers_that_see_one_item_after_the_other) {
  std::string text = "G21 G90 G64 P0.01\nT1 M6\nG0 X0.3\nX0\n";
  for (int i = 0; i < 24; ++i) text += i % 2 == 0 ? "G2 X1 Y0 I0.5 J0 F3000\n" : "G3 X0 Y0 I-0.5 J0\n";
  const test::JudgedProgram program(test::example_machine("strong-router"), text + "T2 M6\nG1 X0.1\nM2\n");
  const Judgement judged = program.judge();

  PlannedProgram planned(program.program.again(), program.machine, program.options, program.check);
  AxisSet axes;
  for (const AxisDescription& axis : program.machine.axes) axes.add(axis.axis);
  SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
  SpeedSurvey speeds(motion_limits(program.machine), axes);
  MarginSurvey survey(surveyed_motors(program.machine), step_grid(program.machine));
  planned.operations().watch([&](const Operation& operation) { builder.watch_operation(operation); });
  planned.path().watch([&](const PathItem& item) { builder.watch_path(item); });
  MotionItem item;
  while (planned.next(item)) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move != nullptr) speeds.watch(*move);
    survey.watch(item);
    builder.watch(item, move != nullptr ? move->segment.work_zero : Point());
  }
  EXPECT_EQ(to_json(judged.summary), to_json(builder.summary()));
  for (const Axis axis : {Axis::x, Axis::y}) {
    const auto number = static_cast<std::size_t>(axis);
    EXPECT_EQ(judged.summary.axes[number].peak_acceleration, builder.summary().axes[number].peak_acceleration);
  }
  const SpeedReport report = speeds.report();
  ASSERT_EQ(judged.speed.shares.size(), report.shares.size());
  for (std::size_t i = 0; i < report.shares.size(); ++i) EXPECT_EQ(judged.speed.shares[i].time, report.shares[i].time);
  const MarginVerdict margin = survey.verdict();
  ASSERT_EQ(judged.margin.worst.size(), margin.worst.size());
  for (std::size_t i = 0; i < margin.worst.size(); ++i) {
    EXPECT_EQ(judged.margin.worst[i].needed.value, margin.worst[i].needed.value);
    EXPECT_EQ(judged.margin.worst[i].line, margin.worst[i].line);
  }
}

TEST(LineTorques, are_the_greatest_of_each_line_that_moves) {
  LineTorques loads;
  loads.add(3, 0.25);
  loads.add(1, 0);
  loads.add(3, 0.5);
  loads.add(3, 0.1);
  EXPECT_EQ(loads.text(), "line,load\n1,0.000\n3,0.500\n");
}

}  // namespace
}  // namespace passo
