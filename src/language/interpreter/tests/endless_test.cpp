// Programs that never end, and programs in which an error would keep a loop from ending.
#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

// Bounds that a test reaches soon.
InterpreterOptions small_bounds() {
  InterpreterOptions options;
  options.idle_passes = 100;
  options.repeated_steps = 5000;
  return options;
}

std::vector<std::string> codes_of(const Interpreted& result) {
  std::vector<std::string> codes;
  for (const Diagnostic& finding : result.diagnostics.all()) {
    if (finding.severity == Severity::error) codes.push_back(finding.code);
  }
  return codes;
}

TEST(Endless, a_typo_in_a_loop_ends_its_repetition) {
  const Interpreted result = interpret_text("#1=0\no1 while [#1 LT 5]\nG0 X#1\n#1=[#1+1\no1 endwhile\nG0 Y1\nM2\n");
  EXPECT_THAT(codes_of(result), testing::ElementsAre("gcode.unclosed-bracket")) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 2U) << "one pass, and the move after the loop";
}

TEST(Endless, a_wrong_line_ends_the_repetition_of_every_kind_of_loop) {
  const char* const loops[] = {
      "o1 while [1]\nG0 X1 K1\no1 endwhile\n",
      "o1 do\nG0 X1 K1\no1 while [1]\n",
      "o1 repeat [1000000]\nG0 X1 K1\no1 endrepeat\n",
      "o1 while [1]\no2 repeat [1000000]\nG0 X1 K1\no2 endrepeat\no1 endwhile\n",
      "o1 while [1]\nG0 X1 K1\no1 continue\no1 endwhile\n",
      "o1 while [1]\nM98 P9 L1000000\no1 endwhile\n",
  };
  for (const std::string loop : loops) {
    const Interpreted result = interpret_text(loop + "G0 Y2\nM2\nO9\nG0 X1 K1\nM99\n");
    EXPECT_THAT(codes_of(result), testing::ElementsAre("gcode.unused-word")) << loop << result.rendered();
    EXPECT_EQ(result.last<operation::StraightTraverse>().end[Axis::y], 2) << loop;
  }
}

TEST(Endless, an_error_before_a_loop_does_not_end_its_repetition) {
  const Interpreted result = interpret_text("G0 X1 K1\no1 repeat [3]\nG0 X2\no1 endrepeat\nM2\n");
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 3U);
}

TEST(Endless, a_main_program_with_an_error_does_not_begin_again) {
  InterpreterOptions options;
  options.main_passes = 0;
  const Interpreted result = interpret_text("G0 X1\nG0 X1 K1\nM99\n", options);
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 1U);
}

TEST(Endless, a_loop_that_only_sets_modes_and_talks_does_nothing) {
  for (const char* const body : {"G18", "(msg,again)", "(print,again)", "G43.1 Z1", "G10 L2 P1 X1", "M3 S1", "M66 P0",
                                 "G4 P0", "M8", "G92 X0", "T1", "M62 P1", "G91"}) {
    const Interpreted result =
        interpret_text(std::string("o1 while [1]\n") + body + "\no1 endwhile\nM2\n", small_bounds());
    EXPECT_THAT(codes_of(result), testing::ElementsAre("gcode.endless-loop")) << body << result.rendered();
    EXPECT_THAT(result.rendered(), HasSubstr(":1:1: error: the loop ran 100 times without any motion"));
  }
}

TEST(Endless, a_loop_with_moves_that_never_ends_is_stopped_after_the_steps_that_are_allowed) {
  for (const char* const body : {"G0 X1", "G1 F100 X1", "G4 P1", "M0", "G38.3 X5 F10", "T1 M6"}) {
    const Interpreted result =
        interpret_text(std::string("G0 X1\no1 while [1]\n") + body + "\no1 endwhile\nM2\n", small_bounds());
    EXPECT_THAT(codes_of(result), testing::ElementsAre("gcode.endless-loop")) << body << result.rendered();
    EXPECT_THAT(result.rendered(), HasSubstr(":2:1: error: the loop reached 5000 passes, calls and operations"));
  }
}

TEST(Endless, calls_without_end_are_stopped) {
  const std::string doubling = "o1 sub\no2 if [#1 GT 0]\no1 call [#1-1]\no1 call [#1-1]\no2 endif\no1 endsub\n";
  const Interpreted idle = interpret_text(doubling + "o1 call [60]\nM2\n", small_bounds());
  EXPECT_THAT(codes_of(idle), testing::ElementsAre("gcode.endless-calls")) << idle.rendered();
  const Interpreted moving =
      interpret_text("o1 sub\nG0 X#1\n" + doubling.substr(7) + "o1 call [60]\nM2\n", small_bounds());
  EXPECT_THAT(codes_of(moving), testing::ElementsAre("gcode.endless-calls")) << moving.rendered();
  EXPECT_THAT(moving.rendered(), HasSubstr("the call from line 8 reached 5000 passes, calls and operations"));
}

TEST(Endless, a_cycle_with_very_many_holes_or_pecks_is_stopped) {
  for (const char* const cycle :
       {"G91 G81 X1 Z-1 R1 L1000000", "G91 G83 X1 Z-1 R1 Q0.00002 L1000000", "G83 X1 Z-1 R1 Q0.0001",
        "G91 G73 X1 Z-1 R1 Q0.001 L1000000", "G18 G8 G76 P1 Z-20 I-1 J0.0001 K10 R1 H90000"}) {
    const Interpreted result =
        interpret_text(std::string("G21 F100 S100 M3\nG0 X5 Z5\n") + cycle + "\nG0 X1\nM2\n", small_bounds());
    EXPECT_THAT(codes_of(result), testing::ElementsAre("gcode.endless-cycle")) << cycle << result.rendered();
    EXPECT_THAT(result.rendered(), HasSubstr("the cycle reached 5000 operations")) << cycle;
    EXPECT_THAT(result.rendered(), HasSubstr(":3:")) << cycle;
    EXPECT_LT(result.operations.size(), 6000U) << cycle;
  }
  const Interpreted inside =
      interpret_text("G21 F100\no1 repeat [1000]\nG91 G81 X1 Z-1 R1 L10\no1 endrepeat\nM2\n", small_bounds());
  EXPECT_EQ(codes_of(inside).size(), 1U) << "the loop's steps and the cycle's count together";
}

// The bound is about what is repeated. A program of many lines, loops and calls is only long.
TEST(Endless, a_long_program_is_not_an_endless_one) {
  std::string program = "o1 sub\nG0 X1\no1 endsub\n";
  for (int i = 0; i < 3000; ++i) program += "G0 X1\no1 call\no2 repeat [2]\nG0 X2\no2 endrepeat\n";
  const Interpreted result = interpret_text(program + "M2\n", small_bounds());
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 12000U);
}

}  // namespace
}  // namespace passo
