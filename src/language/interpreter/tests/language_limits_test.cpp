// Where the language ends: what is accepted although it looks wrong, and what is told of what is wrong.
#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

std::string debug_of(const std::string& expression) {
  return interpret_text("#1=" + expression + "\n(debug,%d#1)\nM2\n").calls().substr(0, 12);
}

std::size_t errors_of(const std::string& program, const InterpreterOptions& options = {}) {
  return interpret_text(program, options).diagnostics.errors();
}

// The only error of the program.
Diagnostic error_of(const std::string& program, const InterpreterOptions& options = {}) {
  const Interpreted result = interpret_text(program, options);
  EXPECT_EQ(result.diagnostics.errors(), 1U) << program << result.rendered();
  for (const Diagnostic& finding : result.diagnostics.all()) {
    if (finding.severity == Severity::error) return finding;
  }
  return {};
}

TEST(Limits, le_and_ge_hold_within_the_tolerance_of_eq) {
  EXPECT_EQ(debug_of("[[0.1+0.1+0.1] LE 0.3]"), "MESSAGE(\"1\")");
  EXPECT_EQ(debug_of("[0.3 GE [0.1+0.1+0.1]]"), "MESSAGE(\"1\")");
  EXPECT_EQ(debug_of("[1.00001 LE 1]"), "MESSAGE(\"0\")");
  EXPECT_EQ(debug_of("[1 GE 1.00001]"), "MESSAGE(\"0\")");
}

TEST(Limits, inverse_time_has_no_slowest_feed) {
  const Interpreted result = interpret_text("G21 G93\nG1 X0.01 F1\nG1 X0.01 F1\nM2\n");
  const auto feeds = result.all<operation::SetFeedRate>();
  ASSERT_GE(feeds.size(), 2U);
  EXPECT_NEAR(0.01 / std::get<operation::FeedPerSecond>(feeds[0].feed).linear.value(), 60, 1e-9) << "seconds";
  EXPECT_GT(std::get<operation::FeedPerSecond>(feeds[1].feed).linear.value(), 0) << "of a move that leads nowhere";
}

TEST(Limits, a_rounding_error_below_zero_is_zero) {
  EXPECT_EQ(interpret_text("G4 P[0.3-0.1-0.2]\nM2\n").last<operation::Dwell>().time, Seconds(0));
  EXPECT_EQ(errors_of("S[0.3-0.1-0.2]\nF[0.3-0.1-0.2]\nM2\n"), 0U);
  EXPECT_EQ(errors_of("G21 F9\nG82 X1 Z-1 R1 P[0.3-0.1-0.2]\nM2\n"), 0U);
  EXPECT_EQ(errors_of("G4 P-0.001\nM2\n"), 1U);
}

TEST(Limits, a_word_of_another_code_is_not_refused) {
  EXPECT_EQ(errors_of("G21 F9\nG81 X1 Z-1 R1 M68 E1 Q-2\nM67 E0 Q1.5 G10 L2 P0 X3\nM2\n"), 0U);
  EXPECT_EQ(errors_of("G10 L2 P0 Q1 X3\nM2\n"), 1U);
}

TEST(Limits, a_finishing_cycle_runs_beside_the_contour) {
  const std::string program = "G21 G18 F100\nO7 sub\nG1 X5 Z0\nX5 Z-10\nX8 Z-14\nG2 X10 Z-16 I2\nG1 X20\nO7 endsub\n";
  const std::string cycle = "G70 Q7 X20 Z5 D1 E0 P2\nG40\nG0 X30\nM2\n";
  const Interpreted plain = interpret_text(program + cycle);
  const Interpreted beside = interpret_text(program + "G42.1 D2 L0\n" + cycle);
  EXPECT_FALSE(beside.diagnostics.any_error()) << beside.rendered();
  // The turned diameter is 10. A tool with a radius of 1 on its right runs at X 6.
  const auto runs_at = [](const Interpreted& result, double x) {
    for (const auto& feed : result.all<operation::StraightFeed>()) {
      if (std::abs(feed.end[Axis::x] - x) < 1e-9 && feed.end[Axis::z] < -8) return true;
    }
    return false;
  };
  EXPECT_TRUE(runs_at(plain, 5)) << plain.canon;
  EXPECT_TRUE(runs_at(beside, 6)) << beside.canon;
  for (const char* const other : {"G71 Q7 X20 Z5\n", "G72 Q7 X20 Z5\n"}) {
    EXPECT_EQ(error_of(program + "G42.1 D2 L0\n" + other + "M2\n").code, "gcode.cutter-compensation");
  }
}

TEST(Limits, what_a_finishing_cycle_cannot_pass_is_told_at_the_cycle) {
  const Diagnostic error = error_of(
      "G21 G18 F100\nO7 sub\nG1 X5 Z0\nX5 Z-10\nG2 X6 Z-11 I1\nG1 X20\nO7 endsub\nG41.1 D5 L0\nG70 Q7 X20 Z5\nM2\n");
  EXPECT_EQ(error.place.line, 9U);
  EXPECT_EQ(error.text, "G70 Q7 X20 Z5");
}

TEST(Limits, a_computed_label_in_a_skipped_line_needs_no_value) {
  const Interpreted result = interpret_text(
      "o1 sub\n#<n>=5\no[#<n>] call\no1 endsub\no5 sub\nG0 X5\no5 endsub\no2 if [0]\no[#<q>] call\no2 endif\no1 "
      "call\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.last<operation::StraightTraverse>().end[Axis::x], 5);
}

TEST(Limits, a_label_is_used_for_one_if) {
  const Diagnostic error = error_of("o1 if [1]\nG0 X1\no1 endif\no1 if [1]\nG0 X2\no1 endif\nM2\n");
  EXPECT_EQ(error.place.line, 4U);
  EXPECT_THAT(error.message, HasSubstr("the first one is in line 1"));
  EXPECT_EQ(errors_of("o9 sub\no1 if [1]\nG0 X1\no1 endif\no9 endsub\no1 if [1]\nG0 X2\no1 endif\no9 call\nM2\n"), 0U);
  EXPECT_EQ(errors_of("o3 repeat [3]\no1 if [1]\nG0 X1\no1 endif\no3 endrepeat\nM2\n"), 0U);
}

TEST(Limits, an_end_that_is_missing_before_m2_is_told) {
  for (const char* const opening : {"o1 if [1]", "o1 while [1]", "o1 repeat [2]", "o1 do"}) {
    const Diagnostic error = error_of(std::string(opening) + "\nG0 X1\nM2\n");
    EXPECT_EQ(error.code, "gcode.unclosed-o-word") << opening;
    EXPECT_EQ(error.place.line, 1U);
  }
  EXPECT_EQ(error_of("o1 if [1]\no2 if [1]\nM2\no1 endif\n").place.line, 2U);
  EXPECT_EQ(errors_of("o1 if [1]\no2 if [1]\nM2\no2 endif\no1 else\nG0 X1\no1 endif\nM2\n"), 0U);
  EXPECT_EQ(errors_of("o1 if [1]\nG0 X1\no1 endif\nM2\noh, this is a remark\n"), 0U);
}

TEST(Limits, a_line_that_cannot_be_read_does_not_cause_further_errors) {
  for (const char* const program :
       {"o1 if [#1 EQ\nG0 X1\no1 else\nG0 X2\no1 endif\nM2\n", "o1 while [1 GT]\nG0 X1\no1 endwhile\nM2\n",
        "o1 if [1]\nG0 X1\no1 endiff\nM2\n", "o1 repeet [3]\nG0 X1\no1 endrepeat\nM2\n",
        "o if [1]\nG0 X1\no1 endif\nM2\n", "o1 sub [\nG0 X1\no1 endsub\nM2\n"}) {
    EXPECT_EQ(errors_of(program), 1U) << program << interpret_text(program).rendered();
  }
}

TEST(Limits, a_line_that_fails_does_not_cause_errors_that_tell_the_lack_of_it) {
  for (const char* const program :
       {"G12 F100\nG1 X1\nM2\n", "G1 X[ F100\nG1 X1\nM2\n", "F1OO\nG1 X1\nX2\nM2\n", "G0 (F9\nG1 X1\nM2\n",  // a feed
        "F9\nG1 X1 )\nX2\nM2\n", "F9\nG81 X1 Z-1 R\nX2\nX3\nM2\n",                                           // a motion
        "M3 S[\nG33 Z-1 K1\nM2\n",                                                                  // a spindle
        "F9\nG0 X[5\nG2 X10 Y0 I2.5\nM2\n", "F9\nG0 X[1/0]\nG2 X10 Y0 I2.5\nG2 X15 Y0 I2.5\nM2\n",  // a place
        "#<a>=[2\n#<b>=#<A>\nG0 X# < b >\nM2\n", "#<a>=[2/0]\nG0 X#<a>\nM2\n",                      // a value
        "20 while [0]\nG0 X1\no20 endwhile\nM2\n", "Lo1 if [1]\nG0 X1\no1 endif\nM2\n",             // a construct
        "o1/ while [0]\nG0 X1\no12 endwhile\nM2\n", "o<s> su\nG0 X1\no<s> endsub\no<s> call\nM2\n",
        "M98 P10\nM2\nO1O\nG0 X1\nM99\n",                                       // a sub
        "G18 F9\nG71 Q1 X5 Z1\nM2\no1 sub\nG1 X1 Z1 )\nX2 Z0\no1 endsub\n"}) {  // a contour
    EXPECT_EQ(errors_of(program), 1U) << program << interpret_text(program).rendered();
  }
}

TEST(Limits, what_is_wrong_in_itself_is_told_behind_a_line_that_fails) {
  for (const char* const program :
       {"F9\nG12 X5\nG0 X5 Y0\nG2 X10 Y0 I2\nM2\n",  // the place is known again
        "F9\nG12 X5\nG91 G2 X10 Y0 I2\nM2\n",        // an arc that does not depend on the place
        "F9\nG2 X10 Y0 I2\nG2 X20 Y0 I2\nM2\n",      // a wrong arc leads to its end
        "G0 X[5\nG1 X1\nM2\n", "G12\n#1=#<a>\nM2\n", "G12\no1 endif\nM2\n", "G12\no<s> call\nM2\n"}) {
    EXPECT_EQ(errors_of(program), 2U) << program << interpret_text(program).rendered();
  }
}

TEST(Limits, a_code_of_another_control_gets_what_does_the_same_here) {
  EXPECT_THAT(error_of("G68 X0 Y0 R30\nM2\n").expected, HasSubstr("G10 L2 with R"));
  EXPECT_THAT(error_of("M42 P1\nM2\n").expected, HasSubstr("M62 to M65"));
  EXPECT_THAT(error_of("G12 I5\nM2\n").expected, HasSubstr("full circle"));
  EXPECT_EQ(error_of("G13.5\nM2\n").expected, "a code listed in docs/gcode.md");
  EXPECT_EQ(error_of("G38.7 X1\nM2\n").expected, "G38.2, G38.3, G38.4 or G38.5");
}

TEST(Limits, a_value_out_of_range_tells_the_range) {
  EXPECT_EQ(error_of("G10 L2 P10 X1\nM2\n").message, "P is 10, outside 0 to 9");
  EXPECT_EQ(error_of("M62 P99\nM2\n").message, "P is 99, outside 0 to 63");
  EXPECT_EQ(error_of("M62 P1.5\nM2\n").message, "P is 1.5, which is not a whole number");
  const Diagnostic table = error_of("G10 L3 P1 X1\nM2\n");
  EXPECT_EQ(table.message, "there is no G10 L3");
  EXPECT_THAT(table.expected, HasSubstr("L0, L1, L2, L10, L11 or L20"));
}

TEST(Limits, each_error_tells_its_own_cause) {
  EXPECT_EQ(error_of("G4 X2\nM2\n").message, "G4 without P");
  EXPECT_EQ(error_of("G0 @5 X1\nM2\n").message, "@ and X in one block: both set the position in X and Y");
  EXPECT_EQ(error_of("G18\nG0 @5\nM2\n").message, "polar coordinates outside the plane XY");
  EXPECT_EQ(error_of("#1=sqrt[-1]\nM2\n").expected, "SQRT of 0 or more");
  EXPECT_EQ(error_of("#1=LN[0]\nM2\n").expected, "LN of more than 0");
  EXPECT_EQ(error_of("#1=ASIN[2]\nM2\n").expected, "ASIN of -1 to 1");
  EXPECT_EQ(error_of("#1=[[0-2]**0.5]\nM2\n").expected, "a whole-number exponent, because the base is negative");
}

}  // namespace
}  // namespace passo
