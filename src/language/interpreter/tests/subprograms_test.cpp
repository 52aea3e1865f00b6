// Numbered programs (M98, M99), and the modal state saved and restored (M70 to M73).
#include <sstream>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

// Where rapids go along X.
std::vector<double> stops(const std::string& program, const InterpreterOptions& options = {}) {
  const Interpreted result = interpret_text(program, options);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<double> found;
  for (const auto& move : result.all<operation::StraightTraverse>()) found.push_back(move.end[Axis::x]);
  return found;
}

TEST(Subprograms, are_called_as_often_as_they_should) {
  EXPECT_THAT(stops("M98 P1 L3\nG0 X9\nM2\nO1\nG91 G0 X1\nG90\nM99\n"), testing::ElementsAre(1, 2, 3, 9));
  EXPECT_THAT(stops("M98 P1 L0\nG0 X9\nM2\nO1\nG0 X1\nM99\n"), testing::ElementsAre(9));
  EXPECT_THAT(stops("M98 P0001\nM2\nO1\nM98 P[1+1] L2\nG0 X1\nM99\nO0002\nG0 X2\nM99\n"),
              testing::ElementsAre(2, 2, 1));
}

TEST(Subprograms, share_numbers_with_their_caller_but_not_names) {
  EXPECT_THAT(stops("#1=4 #<a>=5\nM98 P1\nG0 X#1\nG0 X#<a>\nM2\nO1\n#1=[#1+1]\n#<a>=7\nM99\n"),
              testing::ElementsAre(5, 5));
}

TEST(Subprograms, end_out_of_what_is_open_in_them) {
  EXPECT_THAT(stops("o3 repeat [2]\nM98 P1 L2\no3 endrepeat\nM2\nO1\nG0 X1\no2 if [1]\nM99\no2 endif\nG0 X3\nM99\n"),
              testing::ElementsAre(1, 1, 1, 1));
}

TEST(Subprograms, a_label_that_the_program_runs_into_does_nothing) {
  EXPECT_THAT(stops("O5\nG0 X1\nO6\nG0 X2\nM2\n"), testing::ElementsAre(1, 2));
}

TEST(Subprograms, the_main_program_runs_again_at_M99_as_often_as_is_allowed) {
  InterpreterOptions options;
  EXPECT_THAT(stops("%\nG0 X1\nG91 G0 X1\nG90\nM99\n%\n", options), testing::ElementsAre(1, 2));
  options.main_passes = 3;
  EXPECT_THAT(stops("%\nG0 X1\nG0 X2\nM99\n%\n", options), testing::ElementsAre(1, 2, 1, 2, 1, 2));
}

TEST(Subprograms, a_main_program_without_end_and_without_motion_is_stopped) {
  InterpreterOptions options;
  options.main_passes = 0;
  options.idle_passes = 50;
  const Interpreted result = interpret_text("#1=[#1+1]\nM99\n", options);
  ASSERT_EQ(result.diagnostics.errors(), 1U);
  EXPECT_EQ(result.diagnostics.all().back().code, "gcode.endless-loop");
  EXPECT_EQ(result.diagnostics.all().back().place.line, 2U);
}

// What (PRINT,…) said.
std::string prints(const std::string& program) {
  const Interpreted result = interpret_text(program);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::string said;
  std::istringstream lines(result.calls());
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(">")) said += line;
  }
  return said;
}

TEST(MacroCalls, letters_are_the_parameters_of_the_program_that_is_called) {
  EXPECT_EQ(prints("G65 P1 A1 B2 C3 I4 J5 K6 D7 E8 F9 H11 M13\nM2\nO1\n"
                   "(print,>%d#1 %d#2 %d#3 %d#4 %d#5 %d#6 %d#7 %d#8 %d#9 %d#10 %d#11 %d#12 %d#13 %d#14)\nM99\n"),
            ">1 2 3 4 5 6 7 8 9 0 11 0 13 0");
  EXPECT_EQ(prints("G65 P1 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26\nM2\nO1\n"
                   "(print,>%d#16 %d#17 %d#18 %d#19 %d#20 %d#21 %d#22 %d#23 %d#24 %d#25 %d#26 %d#27)\nM99\n"),
            ">0 17 18 19 20 21 22 23 24 25 26 0");
}

TEST(MacroCalls, arguments_move_nothing_and_set_nothing) {
  const Interpreted result = interpret_text("G65 P1 X5 F7 S9 T3 M3\nM2\nO1\nM99\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_TRUE(result.all<operation::StraightTraverse>().empty());
  EXPECT_TRUE(result.all<operation::SelectTool>().empty());
  for (const auto& turn : result.all<operation::TurnSpindle>()) EXPECT_EQ(turn.direction, SpindleDirection::off);
}

TEST(MacroCalls, numbers_and_names_of_the_caller_are_not_the_callees) {
  EXPECT_THAT(stops("#1=4 #2=5\nG65 P1 A[#1+1]\nG0 X#1\nG0 X#2\nM2\nO1\nG0 X#1\nG0 X#2\n#1=9 #2=9\nM99\n"),
              testing::ElementsAre(5, 0, 4, 5));
}

TEST(MacroCalls, repeat_with_their_arguments) {
  EXPECT_THAT(stops("G65 P1 L3 A2\nG65 P1 L0 A5\nM2\nO1\nG0 X#1\n#1=8\nM99\n"), testing::ElementsAre(2, 2, 2));
}

TEST(MacroCalls, nest_and_share_with_what_they_call_by_M98) {
  EXPECT_THAT(stops("G65 P1 A1\nG0 X#1\nM2\nO1\nG65 P2 A[#1+1]\nG0 X#1\nM98 P3\nG0 X#1\nM99\n"
                    "O2\nG0 X#1\nM99\nO3\n#1=7\nM99\n"),
              testing::ElementsAre(2, 1, 7, 0));
}

TEST(MacroCalls, of_G66_come_behind_each_block_that_moves) {
  EXPECT_THAT(stops("G66 P1 A10\nG0 X1\nM8\nG90\nX2\nG92 X3\nG67\nX4\nM2\nO1\nG0 X#1\nG0 X[#1+1]\nM99\n"),
              testing::ElementsAre(1, 10, 11, 2, 10, 11, 4));
}

TEST(MacroCalls, of_G66_repeat_and_reach_into_subs) {
  EXPECT_THAT(stops("G66 P1 A10 L2\nM98 P2\nG67 G0 X3\nM2\nO1\nG0 X#1\nM99\nO2\nG0 X1\nM99\n"),
              testing::ElementsAre(1, 10, 10, 3));
}

TEST(MacroCalls, of_G66_wait_for_the_end_of_a_cycle) {
  const Interpreted result = interpret_text("G21 F100 G91\nG66 P1\nG81 X1 Z-1 R1 L60\nG67\nM2\nO1\nM8\nM99\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const std::string calls = result.calls();
  EXPECT_EQ(calls.find("FLOOD_ON"), calls.rfind("FLOOD_ON"));
  EXPECT_GT(calls.find("FLOOD_ON"), calls.rfind("STRAIGHT_FEED(60.0000"));
}

TEST(MacroCalls, G67_may_stand_in_the_first_line) {
  EXPECT_THAT(stops("G17 G40 G49 G67 G80\nG0 X1\nM2\n"), testing::ElementsAre(1));
}

TEST(ModalState, is_restored_in_the_order_of_a_block) {
  const Interpreted result = interpret_text(
      "G21 F60 S7 M3 M8\nM70\nG20 G18 G91 G55 G95 G61 G7 G98\nM9 M4 S5 F1\nM50 P0\nM52 P1\nM53 P0\nG43.1 "
      "Z1\nM72\n(end)\n");
  const std::string calls = result.calls();
  const std::size_t from = calls.find("USE_TOOL_LENGTH_OFFSET");
  const std::size_t restored = calls.find('\n', from) + 1;
  EXPECT_EQ(calls.substr(restored, calls.find("COMMENT(\"end\")") - restored),
            "USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
            "COMMENT(\"interpreter: feed mode set to units per minute\")\n"
            "SET_FEED_MODE(0, 0)\n"
            "SET_FEED_RATE(0.0000)\n"
            "SET_FEED_RATE(60.0000)\n"
            "SET_SPINDLE_SPEED(0, 7.0000)\n"
            "START_SPINDLE_CLOCKWISE(0)\n"
            "SELECT_PLANE(CANON_PLANE_XY)\n"
            "COMMENT(\"interpreter: Lathe diameter mode changed to radius\")\n"
            "USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 0.0000, 0.0000 0.0000 0.0000, 0.0000 0.0000 0.0000)\n"
            "SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
            "SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
            "SET_XY_ROTATION(0.0000)\n"
            "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.000000)\n"
            "SET_NAIVECAM_TOLERANCE(0.0000)\n"
            "COMMENT(\"interpreter: distance mode changed to absolute\")\n"
            "COMMENT(\"interpreter: retract mode set to r_plane\")\n"
            "FLOOD_ON()\n"
            "ENABLE_FEED_OVERRIDE()\n"
            "DISABLE_ADAPTIVE_FEED()\n"
            "ENABLE_FEED_HOLD()\n");
}

TEST(ModalState, M73_restores_at_the_end_of_its_sub_and_of_no_other) {
  EXPECT_THAT(stops("o1 sub\nM73\nG91\no2 call\nG0 X1\no1 endsub\no2 sub\nM70\nG90\nG91\no2 endsub\n"
                    "G0 X10\no1 call\nG0 X5\nM2\n"),
              testing::ElementsAre(10, 11, 5));
  EXPECT_THAT(stops("o1 sub\nM73\nG91\nM71\no1 return\no1 endsub\nG0 X10\no1 call\nG0 X5\nM2\n"),
              testing::ElementsAre(10, 15));
  EXPECT_THAT(stops("G0 X10\nM98 P1 L2\nG0 X5\nM2\nO1\nM73\nG91 G0 X1\nM99\n"), testing::ElementsAre(10, 11, 12, 5));
}

TEST(ModalState, many_subs_that_restore_do_not_overflow_what_waits) {
  const Interpreted result =
      interpret_text("o1 sub\nM73\nG91\no1 endsub\n#1=0\no2 while [#1 LT 500]\no1 call\n#1=[#1+1]\no2 endwhile\nM2\n");
  EXPECT_EQ(result.all<operation::SetFeedRate>().size(), 501U);
}

TEST(ModalState, constant_surface_speed_is_restored_too) {
  const Interpreted result = interpret_text("G96 D900 S80\nM70\nG97 S500\nM72\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("SET_SPINDLE_SPEED(0, 500.0000)\nSET_FEED_RATE(0.0000)\n"
                                        "SET_SPINDLE_MODE(0 900.0000)\nSET_SPINDLE_SPEED(0, 80.0000)\n"));
}

}  // namespace
}  // namespace passo
