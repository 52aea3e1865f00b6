// Spindles, inputs and outputs, probing, user codes.
#include <filesystem>
#include <fstream>

#include "interpreted.hpp"
#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

TEST(Spindles, are_chosen_by_their_number) {
  InterpreterOptions options;
  options.spindles = 3;
  const Interpreted result =
      interpret_text("S1\nM3 S2 $1\nM4 $2\nM5 $-1\nM51 P0 $1\nG96 S3 D4 $2\nG33 Z1 K1\n", options);
  EXPECT_THAT(result.calls(), HasSubstr("SET_SPINDLE_SPEED(0, 1.0000)\nSET_SPINDLE_SPEED(1, 2.0000)\n"
                                        "START_SPINDLE_CLOCKWISE(1)\nSTART_SPINDLE_COUNTERCLOCKWISE(2)\n"
                                        "STOP_SPINDLE_TURNING(0)\nSTOP_SPINDLE_TURNING(1)\nSTOP_SPINDLE_TURNING(2)\n"
                                        "DISABLE_SPEED_OVERRIDE(1)\nSET_SPINDLE_MODE(2 4.0000)\n"
                                        "SET_SPINDLE_SPEED(2, 3.0000)\n"));
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.spindle-off");
}

TEST(Spindles, orientation_is_turned_by_the_machines_offset) {
  InterpreterOptions options;
  options.orient_offset = 42;
  const Interpreted result = interpret_text("M3 S1\nM19 R45 Q2\n(debug,#<_spindle_on>)\nM19\nM19 Q3\nM2\n", options);
  EXPECT_THAT(result.calls(), HasSubstr("ORIENT_SPINDLE(0, 87.0000, 0)\nSPINDLE.0.WAIT_ORIENT_COMPLETE(2.0000)\n"
                                        "MESSAGE(\"0.000000\")\nSPINDLE.0.WAIT_ORIENT_COMPLETE(3.0000)\n"));
}

TEST(InputsAndOutputs, are_switched_and_read) {
  const Interpreted result = interpret_text("M62 P1\nM65 P2\nM67 E3 Q1.5\nM66 P4 L1 Q2\n(debug,#5399)\nM2\n");
  EXPECT_THAT(result.calls(),
              HasSubstr("SET_MOTION_OUTPUT_BIT(1)\nCLEAR_AUX_OUTPUT_BIT(2)\nSET_MOTION_OUTPUT_VALUE(3,1.500000)\n"
                        "MESSAGE(\"0.000000\")\n"));
  const auto input = result.last<operation::ReadInput>();
  EXPECT_EQ(input.until, operation::ReadInput::Until::rise);
  EXPECT_EQ(input.timeout, Seconds(2));
}

TEST(InputsAndOutputs, on_the_machine_a_wait_runs_out) {
  InterpreterOptions options;
  options.on_machine = true;
  EXPECT_THAT(interpret_text("M66 P4 L1 Q2\n(debug,#5399 #<_task>)\nM66 P4\n(debug,#5399)\nM2\n", options).calls(),
              HasSubstr("MESSAGE(\"-1.000000 1.000000\")\nMESSAGE(\"0.000000\")\n"));
}

TEST(UserCodes, carry_their_number_and_words_where_they_are_allowed) {
  InterpreterOptions options;
  options.user_codes = true;
  const Interpreted result = interpret_text("M101 P1.5\nM2\n", options);
  const auto code = result.last<operation::UserCode>();
  EXPECT_EQ(code.number, 101);
  EXPECT_EQ(code.p, 1.5);
  EXPECT_EQ(code.q, -1);
}

// A folder with the subroutine of M123.
InterpreterOptions with_m123(const std::string& text) {
  const std::filesystem::path folder = test::scratch_folder();
  std::ofstream(folder / "m123.ngc") << text;
  InterpreterOptions options;
  options.sub_folders = {folder.string()};
  return options;
}

TEST(UserCodes, call_the_subroutine_of_their_name_with_p_and_q) {
  const InterpreterOptions options = with_m123("o<m123> sub\nG0 X#1 Y#2\no<m123> endsub\n");
  const Interpreted result = interpret_text("G21\nM123 P7 Q8\nM123 Q5\nG0 Z1\nM2\n", options);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_TRAVERSE(7.0000, 8.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "STRAIGHT_TRAVERSE(-1.0000, 5.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "STRAIGHT_TRAVERSE(-1.0000, 5.0000, 1.0000"));
  EXPECT_TRUE(result.all<operation::UserCode>().empty());
}

TEST(UserCodes, with_a_subroutine_stand_alone_and_do_not_call_themselves_endlessly) {
  const InterpreterOptions options = with_m123("o<m123> sub\nM123 P#1\no<m123> endsub\n");
  const auto code = [](const std::string& text, const InterpreterOptions& with) {
    const Interpreted result = interpret_text(text, with);
    return result.diagnostics.any_error() ? result.diagnostics.all().front().code : std::string();
  };
  EXPECT_EQ(code("G21\nM123 P7\nM2\n", options), "gcode.calls-too-deep");
  EXPECT_EQ(code("G21\nG1 X1 F100 M123\nM2\n", options), "gcode.unused-word");
  EXPECT_EQ(code("G21\nM124 P7\nM2\n", options), "gcode.user-code") << "no file";
  const InterpreterOptions other = with_m123("o<m124> sub\no<m124> endsub\n");
  EXPECT_EQ(code("G21\nM123 P7\nM2\n", other), "gcode.unknown-sub") << "the file has another subroutine";
}

TEST(Probing, a_preview_stops_before_the_end_as_rs274_does) {
  const Interpreted result = interpret_text(
      "G21 F100\nG38.2 X10\n(debug,#5061 #5070 #5420)\nG20\nG38.3 X1\n"
      "(debug,#5061 #5420)\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("TURN_PROBE_ON()\nSTRAIGHT_PROBE(10.0000, 0.0000, 0.0000, 0.0000, 0.0000, "
                                        "0.0000)\nTURN_PROBE_OFF()\nMESSAGE(\"10.000000 0.000000 9.746000\")\n"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000 0.990000\")\n"));
}

TEST(Probing, on_a_machine_is_touched_at_its_end_as_long_as_nobody_knows_better) {
  InterpreterOptions options;
  options.on_machine = true;
  const Interpreted result = interpret_text("G21 F100\nG38.2 X10\n(debug,#5061 #5070 #5420)\nM2\n", options);
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"10.000000 1.000000 10.000000\")\n"));
  EXPECT_FALSE(result.diagnostics.any_error());
}

TEST(Probing, goes_on_from_where_the_machine_rests_with_what_it_found) {
  ProbeOutcome outcome;
  outcome.touched = true;
  outcome.contact[Axis::x] = 6;
  outcome.rest[Axis::x] = 6.25;
  StoredResults answers;
  answers.record(outcome);
  const Interpreted result = interpret_text(
      "G21 G10 L2 P1 X1 F100\nG38.2 X10\n(debug,#5061 #5070 #5420)\nG91 G0 X1\nM2\n", InterpreterOptions(), answers);
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"5.000000 1.000000 5.250000\")\n"));
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_TRAVERSE(6.2500,"));
}

TEST(Probing, that_failed_ends_the_program_at_its_line) {
  ProbeOutcome outcome;
  const InterpreterOptions options;
  StoredResults answers;
  for (const char* must : {"G38.2", "G38.4"}) {
    const Interpreted untouched =
        interpret_text("G21 F100\n" + std::string(must) + " X10\nG0 X11\nM2\n", options, answers);
    ASSERT_EQ(untouched.diagnostics.errors(), 1U);
    EXPECT_EQ(untouched.diagnostics.all().front().code, "gcode.probe-untouched");
    EXPECT_EQ(untouched.diagnostics.all().front().place.line, 2U);
    EXPECT_TRUE(untouched.all<operation::StraightTraverse>().empty()) << "nothing of the program comes behind";
  }
  EXPECT_FALSE(interpret_text("G21 F100\nG38.3 X10\nG0 X11\nM2\n", options, answers).diagnostics.any_error());
  outcome.refused = true;
  answers.record(outcome);
  for (const char* any : {"G38.2", "G38.3", "G38.4", "G38.5"}) {
    const Interpreted refused = interpret_text("G21 F100\n" + std::string(any) + " X10\nM2\n", options, answers);
    ASSERT_EQ(refused.diagnostics.errors(), 1U);
    EXPECT_EQ(refused.diagnostics.all().front().code, "gcode.probe-before");
  }
}

TEST(Debug, messages_are_shown_or_not_by_5599) {
  EXPECT_EQ(interpret_text("#5599=0\n(debug,x)\n#5599=1\n(debug,y)\n").calls(), "MESSAGE(\"y\")\n");
}

}  // namespace
}  // namespace passo
