// What is modal, in which order a block is executed, and which words a block may have together.
#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

Point end_of(const Interpreted& result) {
  return result.last<operation::StraightFeed>().end;
}

TEST(Modes, a_program_starts_in_millimetres_and_with_linuxcncs_six_calls) {
  const Interpreted result = interpret_text("M2\n");
  EXPECT_THAT(result.canon,
              testing::StartsWith("    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
                                  "    2 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                  "    3 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                  "    4 N..... SET_XY_ROTATION(0.0000)\n"
                                  "    5 N..... SET_FEED_REFERENCE(CANON_XYZ)\n"
                                  "    6 N..... ON_RESET()\n"));
}

TEST(Modes, the_start_is_a_machine_position_and_the_units_an_option) {
  InterpreterOptions options;
  options.units = LengthUnits::inch;
  options.start[Axis::y] = 50.8;
  const Interpreted result = interpret_text("(debug,#5421)\nF10 G1 X1\nM2\n", options);
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"2.000000\")"));
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::x], 25.4);
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::y], 50.8);
}

TEST(Modes, motion_and_distance_modes_stay_until_they_are_changed) {
  const Interpreted result = interpret_text("G21 G91 F100 G1 X1\nX1\nY2\nG90 X5\nX6\nM2\n");
  EXPECT_EQ(result.all<operation::StraightFeed>().size(), 5U);
  EXPECT_EQ(end_of(result)[Axis::x], 6);
  EXPECT_EQ(end_of(result)[Axis::y], 2);
}

TEST(Modes, lengths_are_millimetres_whatever_the_program_says) {
  const Interpreted result = interpret_text("G20\nF60\nG1 X1 A90 U2\nM2\n");
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::x], 25.4);
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::a], 90);
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::u], 50.8);
  const auto feed = result.all<operation::SetFeedRate>().front();
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(feed.feed).linear.value(), 25.4);
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(feed.feed).rotary, 1);
}

TEST(Modes, units_change_where_the_tool_is_told_and_not_where_it_is) {
  const Interpreted result = interpret_text("G21 G0 X25.4\nG20\n(debug,#5420)\nG91\nF5\nG1 X1\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000\")"));
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::x], 50.8);
}

TEST(Modes, units_of_a_block_hold_for_its_axis_words_and_not_for_its_feed) {
  const Interpreted result = interpret_text("G21\nG20 F10 G1 X1\nM2\n");
  EXPECT_DOUBLE_EQ(end_of(result)[Axis::x], 25.4);
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(result.all<operation::SetFeedRate>().front().feed).linear.value(),
                   10.0 / 60);
  ASSERT_EQ(result.diagnostics.all().size(), 1U);
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.feed-before-units");
  EXPECT_FALSE(result.diagnostics.any_error());
}

TEST(Modes, a_block_is_executed_in_the_order_of_rs274) {
  const Interpreted result = interpret_text("G21 T1\nM2 G1 G54 X1 G90 G61 G18 G4 P1 M8 M3 M6 S100 F200 G94 (note)\n");
  const std::string calls = result.calls();
  std::size_t at = 0;
  for (const char* const call :
       {"COMMENT(\"note\")", "SET_FEED_MODE(0, 0)", "SET_FEED_RATE(200.0000)", "SET_SPINDLE_SPEED(0, 100.0000)",
        "CHANGE_TOOL(1)", "START_SPINDLE_CLOCKWISE(0)", "FLOOD_ON()", "DWELL(1.0000)", "SELECT_PLANE(CANON_PLANE_XZ)",
        "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)", "STRAIGHT_FEED(1.0000", "PROGRAM_END()"}) {
    const std::size_t found = calls.find(call, at);
    ASSERT_NE(found, std::string::npos) << call << " is not behind its predecessor in\n" << calls;
    at = found;
  }
  EXPECT_EQ(calls.find("PROGRAM_END()") + std::string("PROGRAM_END()\n").size(), calls.size());
}

TEST(Modes, inverse_time_gives_each_move_its_own_feed) {
  const Interpreted result = interpret_text("G21 G93\nG1 X30 F2\nA90 F4\nM2\n");
  const auto feeds = result.all<operation::SetFeedRate>();
  ASSERT_GE(feeds.size(), 2U);
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(feeds[0].feed).linear.value(), 30 * 2 / 60.0);
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(feeds[1].feed).rotary, 90 * 4 / 60.0);
}

TEST(Modes, feed_for_each_revolution_is_millimetres_a_revolution) {
  const Interpreted result = interpret_text("G20 S100\nG95 F.1\nG1 X1\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerRevolution>(result.all<operation::SetFeedRate>()[1].feed).linear.value(),
                   2.54);
}

TEST(Modes, m2_puts_back_what_programs_expect) {
  const Interpreted result = interpret_text("G21 G10 L2 P2 X5\nG55 G18 G91 M3 M8 M49\nM2\nG0 X99\n");
  EXPECT_THAT(result.calls(), HasSubstr("SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "SET_XY_ROTATION(0.0000)\n"
                                        "SELECT_PLANE(CANON_PLANE_XY)\n"
                                        "SET_FEED_MODE(0, 0)\n"
                                        "SET_FEED_RATE(0.0000)\n"
                                        "ENABLE_FEED_OVERRIDE()\n"
                                        "ENABLE_SPEED_OVERRIDE(0)\n"
                                        "STOP_SPINDLE_TURNING(0)\n"
                                        "SET_SPINDLE_MODE(0 0.0000)\n"
                                        "FLOOD_OFF()\n"
                                        "PROGRAM_END()\n"));
  EXPECT_TRUE(result.all<operation::StraightTraverse>().empty()) << "nothing after M2 counts";
}

TEST(Modes, g80_gives_way_to_another_motion_of_its_block) {
  const Interpreted result = interpret_text("G90 G17 G40 G80 G0 G20\nX1\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 2U);
}

TEST(Modes, block_delete_is_up_to_the_operator) {
  const std::string program = "G21 G0 X1\n/X2\n  / N5 X3\nM2\n";
  EXPECT_EQ(interpret_text(program).all<operation::StraightTraverse>().size(), 3U);
  InterpreterOptions options;
  options.block_delete = true;
  EXPECT_EQ(interpret_text(program, options).all<operation::StraightTraverse>().size(), 1U);
}

TEST(Modes, operations_tell_the_line_and_the_number_they_come_from) {
  const Interpreted result = interpret_text("G21\n\nN0120 G0 X1\nX2\nM2\n");
  std::vector<OperationSource> sources;
  for (const Operation& operation : result.operations) {
    if (std::holds_alternative<operation::StraightTraverse>(operation.what)) sources.push_back(operation.source);
  }
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0].line, 3U);
  EXPECT_EQ(sources[0].line_number, 120);
  EXPECT_EQ(sources[1].line, 4U);
  EXPECT_EQ(sources[1].line_number, -1);
}

TEST(Modes, a_program_between_percent_signs_ends_at_the_second) {
  const Interpreted result = interpret_text("%\nG0 X1\n%\nG0 X2\n");
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 1U);
  EXPECT_TRUE(result.diagnostics.all().empty()) << result.rendered();
  EXPECT_EQ(result.all<operation::Finish>().size(), 1U);
}

TEST(Modes, a_program_that_merely_ends_is_told_and_done) {
  const Interpreted result = interpret_text("G0 X1\n");
  ASSERT_EQ(result.diagnostics.all().size(), 1U);
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.no-end");
  EXPECT_FALSE(result.diagnostics.any_error());
}

TEST(Modes, rigid_tapping_ends_where_it_began) {
  const Interpreted result = interpret_text("G21 G0 Z5 M3\nG33.1 Z-5 K1\n(debug,#5422)\nM2\n");
  EXPECT_EQ(result.last<operation::RigidTap>().end[Axis::z], -5);
  EXPECT_EQ(result.last<operation::StartSpeedFeedSync>().pitch, Mm(1));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"5.000000\")"));
}

TEST(Modes, the_borrowed_text_of_a_comment_lives_until_the_next_call) {
  Diagnostics diagnostics;
  const InterpreterOptions options;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", "(one)\n(debug, two #1)\n(MSG,three)\nM2\n"), options,
                          diagnostics);
  std::vector<std::string> texts;
  Operation operation;
  while (interpreter.next(operation)) {
    if (const auto* comment = std::get_if<operation::Comment>(&operation.what)) texts.emplace_back(comment->text);
    if (const auto* message = std::get_if<operation::Message>(&operation.what)) texts.emplace_back(message->text);
  }
  EXPECT_THAT(texts, testing::ElementsAre("one", " two 0.000000", "three"));
}

}  // namespace
}  // namespace passo
