// explain(): lines in words, with the values, positions and modes that they have when they run.
#include "passo/interpreter/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Explanations explain_text(const std::string& text, LineRange range, const ExplainLimits& limits = {}) {
  Diagnostics diagnostics(1000);
  return explain(ProgramReader::from_text("test.ngc", text), {}, range, diagnostics, limits);
}
Explanation line_of(const std::string& text, std::uint32_t line) {
  Explanations result = explain_text(text, {line, line});
  EXPECT_EQ(result.lines.size(), 1U);
  return result.lines.empty() ? Explanation{} : result.lines.front();
}
std::string meaning(const Explanation& line, std::string_view word) {
  for (const auto& [written, meaning] : line.words) {
    if (written == word) return meaning;
  }
  return "no such word";
}
Explanation::Mode mode(const Explanation& line, std::string_view name) {
  for (const Explanation::Mode& mode : line.modes) {
    if (mode.name == name) return mode;
  }
  return {};
}

TEST(Explain, a_move_is_said_with_its_ends_in_work_and_machine) {
  const Explanation line = line_of("G10 L2 P1 X25\nF300 G1 X1\nG1 X10 Y-2.5 F600\nM2\n", 3);
  EXPECT_EQ(line.text, "G1 X10 Y-2.5 F600");
  EXPECT_EQ(line.executions, 1U);
  EXPECT_EQ(meaning(line, "G1"), "feed move");
  EXPECT_EQ(meaning(line, "X10"), "to X 10 mm (work), 35 mm (machine)");
  EXPECT_EQ(meaning(line, "Y-2.5"), "to Y -2.5 mm (work), -2.5 mm (machine)");
  EXPECT_EQ(meaning(line, "F600"), "feed 600 mm/min");
  EXPECT_EQ(in_words(line.before.work), "X 1 mm, Y 0 mm, Z 0 mm");
  EXPECT_EQ(in_words(line.before.machine), "X 26 mm, Y 0 mm, Z 0 mm");
  EXPECT_EQ(in_words(line.after.work), "X 10 mm, Y -2.5 mm, Z 0 mm");
  EXPECT_EQ(in_words(line.after.machine), "X 35 mm, Y -2.5 mm, Z 0 mm");
  EXPECT_THAT(line.operations, ElementsAre("SET_FEED_RATE(600.0000)",
                                           "STRAIGHT_FEED(10.0000, -2.5000, 0.0000, 0.0000, 0.0000, 0.0000)"));
}

TEST(Explain, the_modes_are_those_the_line_runs_under) {
  const Explanation line = line_of("G20 G91\nF10 S900 M3 M8 T4\nG55 G18 G1 X1\nG21 G90\nM2\n", 3);
  EXPECT_EQ(mode(line, "units").code, "G20");
  EXPECT_EQ(mode(line, "units").meaning, "inches");
  EXPECT_FALSE(mode(line, "units").set_here);
  EXPECT_EQ(mode(line, "distances").code, "G91");
  EXPECT_EQ(mode(line, "plane").code, "G18");
  EXPECT_TRUE(mode(line, "plane").set_here);
  EXPECT_EQ(mode(line, "work coordinate system").code, "G55");
  EXPECT_TRUE(mode(line, "motion").set_here);
  EXPECT_EQ(mode(line, "feed").meaning, "10 in/min");
  EXPECT_EQ(mode(line, "spindle").meaning, "clockwise, 900 rev/min");
  EXPECT_EQ(mode(line, "coolant").meaning, "flood");
  EXPECT_EQ(mode(line, "tool").meaning, "none in the spindle; 4 is selected");
  EXPECT_EQ(meaning(line, "X1"), "by X 1 in (25.4 mm), to X 25.4 mm (work), 25.4 mm (machine)");
}

// G41 takes a tool of the table, G41.1 a diameter.
TEST(Explain, a_letter_means_what_the_row_of_its_code_says) {
  EXPECT_EQ(meaning(line_of("G41.1 D6\nM2\n", 1), "D6"), "a tool 6 mm wide");
  EXPECT_EQ(meaning(line_of("G42.1 D6\nM2\n", 1), "D6"), "a tool 6 mm wide");
  EXPECT_EQ(meaning(line_of("G41 D0\nM2\n", 1), "D0"), "the radius of tool 0");
  EXPECT_EQ(meaning(line_of("G98 G83 X1 Z-2 R1 Q.5 F100\nM2\n", 1), "Q.5"), "0.5 mm depth per peck");
}

TEST(Explain, axis_words_alone_name_the_motion_that_is_active) {
  const Explanation line = line_of("G1 X1 F100\nX2\nM2\n", 2);
  ASSERT_EQ(line.words.size(), 2U);
  EXPECT_EQ(line.words[0].word, "(G1)");
  EXPECT_EQ(line.words[0].meaning, "feed move, still active");
}

TEST(Explain, expressions_and_parameters_have_the_values_of_that_moment) {
  const std::string program = "#1=3\n#<side>=[#1*2]\nG0 X[#<side>+#1] Y#1\n#1=[#1+1]\nM2\n";
  EXPECT_EQ(line_of(program, 2).words.front().meaning, "parameter #<side> is set to 6");
  const Explanation move = line_of(program, 3);
  EXPECT_THAT(meaning(move, "X[#<side>+#1]"), HasSubstr("to X 9 mm (work)"));
  EXPECT_THAT(meaning(move, "Y#1"), HasSubstr("to Y 3 mm (work)"));
  EXPECT_EQ(line_of(program, 4).words.front().meaning, "parameter #1 is set to 4");
}

TEST(Explain, a_line_in_a_loop_is_explained_as_it_is_first_run_and_counted) {
  const std::string program = "#1=0\no1 while [#1 LT 5]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nM2\n";
  const Explanation line = line_of(program, 4);
  EXPECT_EQ(line.executions, 5U);
  EXPECT_EQ(line.after.work[Axis::x], 1);
  EXPECT_EQ(line.operations.size(), 1U);
  const Explanation loop = line_of(program, 2);
  EXPECT_EQ(loop.executions, 6U);
  EXPECT_EQ(loop.words.front().meaning, "a loop that repeats while the value is not 0: 1");
}

TEST(Explain, counting_ends_somewhere) {
  const std::string endless = "G0 X1\no1 while [1]\nG0 X2\nG0 X3\no1 endwhile\nM2\n";
  const Explanations counted = explain_text(endless, {3, 3}, {1000, 100});
  EXPECT_FALSE(counted.whole_run);
  EXPECT_GE(counted.lines.front().executions, 40U);
  EXPECT_LE(counted.lines.front().executions, 60U);
  const Explanations never = explain_text(endless, {6, 6}, {1000, 100});
  EXPECT_FALSE(never.whole_run);
  EXPECT_EQ(never.lines.front().executions, 0U);
}

TEST(Explain, a_line_that_is_never_executed_says_so) {
  const std::string program = "o1 if [0]\nG0 X1\no1 endif\nM2\nG0 X2\n";
  for (const std::uint32_t line : {2U, 5U}) {
    EXPECT_EQ(line_of(program, line).executions, 0U);
    EXPECT_TRUE(line_of(program, line).words.empty());
  }
}

TEST(Explain, a_line_with_an_error_has_its_diagnostic) {
  const std::string program = "G0 X1\nG1 X5 H2\nG0 X(\nM2\n";
  const Explanation meaningless = line_of(program, 2);
  ASSERT_EQ(meaningless.findings.size(), 1U);
  EXPECT_EQ(meaningless.findings.front().code, "gcode.unused-word");
  EXPECT_EQ(meaning(meaningless, "H2"), "used by no code of the block");
  const Explanation unreadable = line_of(program, 3);
  EXPECT_EQ(unreadable.findings.size(), 1U);
  EXPECT_EQ(unreadable.executions, 0U);
  EXPECT_TRUE(line_of(program, 1).findings.empty());
}

TEST(Explain, the_line_that_ends_the_program_ends_it_and_no_more) {
  const Explanation line = line_of("G0 X1\nM2\n", 2);
  ASSERT_FALSE(line.operations.empty());
  EXPECT_EQ(line.operations.back(), "PROGRAM_END()");
}

TEST(Explain, ranges_stop_at_the_end_of_the_file) {
  const Explanations result = explain_text("G0 X1\n\nM2\n", {2, 99});
  ASSERT_EQ(result.lines.size(), 2U);
  EXPECT_EQ(result.lines[0].line, 2U);
  EXPECT_EQ(result.lines[1].text, "M2");
  EXPECT_EQ(result.lines_in_file, 3U);
  EXPECT_TRUE(explain_text("G0 X1\nM2\n", {3, 3}).lines.empty());
}

TEST(Explain, words_that_depend_on_their_code_are_said_by_it) {
  EXPECT_EQ(meaning(line_of("G4 P1.5\nM2", 1), "P1.5"), "wait 1.5 s");
  EXPECT_EQ(meaning(line_of("G64 P.05\nM2", 1), "P.05"), "path tolerance 0.05 mm");
  const Explanation arc = line_of("F100\nG2 X2 I1\nM2", 2);
  EXPECT_EQ(meaning(arc, "I1"), "the arc's centre is 1 mm in X from its start");
  EXPECT_EQ(meaning(line_of("F100\nG3 X2 R-7 P2\nM2", 2), "R-7"), "the arc's radius is -7 mm");
  EXPECT_EQ(meaning(line_of("G90.1 F100\nG2 X2 I1 J0\nM2", 2), "I1"), "the arc's centre is at X 1 mm");
  EXPECT_EQ(meaning(line_of("G92 X7\nM2", 1), "X7"), "this position is X 7 mm from now on");
  EXPECT_EQ(meaning(line_of("G10 L2 P2 X7\nM2", 1), "X7"), "set X 7 mm");
  EXPECT_EQ(meaning(line_of("G10 L2 P1 X5\nG53 G0 X7\nM2", 2), "X7"), "to X 7 mm (machine)");
  EXPECT_EQ(meaning(line_of("G93 G1 X1 F2\nM2", 1), "F2"), "the move takes 1/2 minute");
  EXPECT_EQ(meaning(line_of("N10 S500 T3 (hello)\nM2", 1), "N10"), "the line's number");
  EXPECT_EQ(meaning(line_of("N10 S500 T3 (hello)\nM2", 1), "(hello)"), "a comment");
}

}  // namespace
}  // namespace passo
