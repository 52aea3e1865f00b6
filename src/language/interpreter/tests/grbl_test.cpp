// What grbl 1.1 accepts and refuses, and with which of its error numbers.
#include "interpreted.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

Interpreted as_grbl(const std::string& text) {
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  return interpret_text(text, options);
}

struct Refusal {
  const char* program;
  int number;
};
void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.program;
}

class GrblRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(GrblRefuses, with_its_own_number) {
  const Interpreted result = as_grbl(GetParam().program);
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  const std::string rule = "grbl error:" + std::to_string(GetParam().number) + ",";
  EXPECT_NE(result.rendered().find("= rule: " + rule), std::string::npos) << result.rendered();
}

INSTANTIATE_TEST_SUITE_P(
    Grbl, GrblRefuses,
    testing::Values(
        Refusal{"% G0 X1\nM2", 1}, Refusal{"#1=5\nM2", 1}, Refusal{"@5\nM2", 1}, Refusal{"G0 X[1+2]\nM2", 2},
        Refusal{"G0 X#1\nM2", 2}, Refusal{"G0 X\nM2", 2}, Refusal{"G4 P-1\nM2", 4}, Refusal{"S-5\nM2", 4},
        Refusal{"G1 F-5\nM2", 4}, Refusal{"T-1\nM2", 4},
        Refusal{"G0 X1.00000000000000000000 Y1.00000000000000000000 Z1.00000000000000000000 F1.000000000\nM2", 11},
        Refusal{"G5 X1\nM2", 20}, Refusal{"G64\nM2", 20}, Refusal{"G81 X1 Z-1 R1\nM2", 20}, Refusal{"G90.1\nM2", 20},
        Refusal{"G41\nM2", 20}, Refusal{"G43 H1\nM2", 20}, Refusal{"G61.1\nM2", 20}, Refusal{"G92.2\nM2", 20},
        Refusal{"G95\nM2", 20}, Refusal{"G33 Z1 K1\nM2", 20}, Refusal{"M6 T1\nM2", 20}, Refusal{"M48\nM2", 20},
        Refusal{"G0 A1\nM2", 20}, Refusal{"G0 X1 Q1\nM2", 20}, Refusal{"o1 sub\nM2", 20},
        Refusal{"G10 L1 P1 Z1\nM2", 20}, Refusal{"G10 L2 P1 X1 R5\nM2", 20}, Refusal{"G999.5\nM2", 20},
        Refusal{"G0 G1 X1\nM2", 24}, Refusal{"G80 G0 X1\nM2", 21}, Refusal{"G20 G21\nM2", 21}, Refusal{"M3 M5\nM2", 21},
        Refusal{"M1 M0\nM2", 21}, Refusal{"G54 G55\nM2", 21}, Refusal{"G1 X1\nM2", 22}, Refusal{"G93\nG1 X1\nM2", 22},
        Refusal{"G59.1\nM2", 23}, Refusal{"G17.1\nM2", 23}, Refusal{"M3.1\nM2", 23}, Refusal{"G0 G28 X1\nM2", 24},
        Refusal{"G0 G49 X1\nM2", 24}, Refusal{"G92 G1 X1 F1\nM2", 24}, Refusal{"G0 X1 X2\nM2", 25},
        Refusal{"G92\nM2", 26}, Refusal{"G10 L2 P1\nM2", 26}, Refusal{"F9 G2 I1\nM2", 26},
        Refusal{"N10000001 G0\nM2", 27}, Refusal{"G4\nM2", 28}, Refusal{"G10 X1\nM2", 28}, Refusal{"G10 P1 X1\nM2", 20},
        Refusal{"G10 L2 P7 X1\nM2", 29}, Refusal{"F9 G53 G2 X1 I.5\nM2", 30}, Refusal{"G80 X1\nM2", 31},
        Refusal{"F9 G2 Z1 I1\nM2", 32}, Refusal{"F9 G18 G2 Y1 I1\nM2", 32}, Refusal{"F9 G2 X1 Y9 I1\nM2", 33},
        Refusal{"F9 G2 X9 R1\nM2", 34}, Refusal{"F9 G2 X1\nM2", 35}, Refusal{"F9 G2 X1 K1\nM2", 35},
        Refusal{"F9 G2 X2 I1 P2\nM2", 36}, Refusal{"G0 X1 L2\nM2", 36}, Refusal{"F9 G2 X2 I1 R1\nM2", 36},
        Refusal{"G43.1 X1\nM2", 37}, Refusal{"G43.1\nM2", 37}, Refusal{"G43.1 X1 Z1\nM2", 37}, Refusal{"T256\nM2", 38},
        Refusal{"$H\nM2", 3}, Refusal{"$10=1\nM2", 3}, Refusal{" $5\nM2", 3}, Refusal{"G80\nG92 X1\nM2", 31},
        Refusal{"G80\nG10 L2 P1 X1\nM2", 31}, Refusal{"G80\nG43.1 Z1\nM2", 31}, Refusal{"G80\nG53\nM2", 30}));

// grbl reads word by word, then checks in an order of its own. Its number is that of the first error.
INSTANTIATE_TEST_SUITE_P(GrblFirst, GrblRefuses,
                         testing::Values(Refusal{"G99 X\nM2", 20}, Refusal{"G0 X1 X2 G99\nM2", 25},
                                         Refusal{"G0 X Y1 G99\nM2", 2}, Refusal{"T300 T1\nM2", 38},
                                         Refusal{"S-1 S-1\nM2", 4}, Refusal{"G1 X1 K1\nM2", 22},
                                         Refusal{"G2 X1\nM2", 22}, Refusal{"G2\nM2", 22},
                                         Refusal{"G93 G2 X1 F0\nM2", 22}, Refusal{"G38.2 Z-1\nM2", 22},
                                         Refusal{"F9 G2 K1\nM2", 26}, Refusal{"M3 M4 X\nM2", 21},
                                         Refusal{"N10000001 G7\nM2", 20}, Refusal{"N10000001 G4\nM2", 27},
                                         Refusal{"G10 G0.5\nM2", 24}, Refusal{"G1 G38.7\nM2", 24},
                                         Refusal{"G-.5\nM2", 23}, Refusal{"G-1\nM2", 20}, Refusal{"M-1\nM2", 23},
                                         Refusal{"G257\nM2", 23}, Refusal{"G0 X[1]\nM2", 2}, Refusal{"N5 $G\nM2", 1}));

// Last of all it looks for words without use: behind the place of an arc and of a probe move.
INSTANTIATE_TEST_SUITE_P(GrblLast, GrblRefuses,
                         testing::Values(Refusal{"F9 G2 X1 Y9 I1 P2\nM2", 33}, Refusal{"F9 G2 X9 R1 P2\nM2", 34},
                                         Refusal{"F9 G2 X9 R1 I1\nM2", 34}, Refusal{"F9 G2 X9 R5 I1\nM2", 36},
                                         Refusal{"F9 G2 X0 R5 P1\nM2", 33}, Refusal{"F9 G38.3 X0 P1\nM2", 33},
                                         Refusal{"F9 G38.3 X1 P1\nM2", 36}, Refusal{"G80 G10 L20 P1 X1 R2\nM2", 31},
                                         Refusal{"G10 L20 P1 X1 R2\nM2", 36}, Refusal{"F9 G2 X1 I1 L1\nM2", 33},
                                         Refusal{"F9 G2 X2 I1\nI1\nM2", 36}, Refusal{"F9 G2 X2 I1\nG49 I1\nM2", 36},
                                         Refusal{"F9 G2 X2 I1\nG49 X5 I1\nM2", 36}));

// In grbl radii may differ by 0.005 mm, or by a thousandth of the radius up to 0.5 mm, in inches too.
INSTANTIATE_TEST_SUITE_P(GrblArcs, GrblRefuses,
                         testing::Values(Refusal{"F9 G2 X2.006 I1\nM2", 33}, Refusal{"F9 G2 X2000.6 I1000\nM2", 33},
                                         Refusal{"F9 G20 G2 X.2003 I.1\nM2", 33}, Refusal{"F9 G2 X2 R.999\nM2", 34}));

TEST(Grbl, counts_the_hundredths_of_a_code) {
  EXPECT_EQ(as_grbl("G0.004 X1\nG49.5\nM2.004").calls(), as_grbl("G0 X1\nG49\nM2").calls());
}

TEST(Grbl, takes_the_dwell_of_an_arc_by_its_p) {
  const Interpreted result = as_grbl("F9 G4 P2 G2 X2 I1\nG2 X4 I1.002\nM2");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.all<operation::Dwell>().front().time, Seconds(2));
  EXPECT_EQ(result.all<operation::ArcFeed>().front().turns, -1);
}

TEST(Grbl, accepts_what_it_knows) {
  const Interpreted result = as_grbl(
      "G17 G21 G90 G94 G54 G49 G80\nG0\n"
      "G10 L2 P1 X1 Y2\nG10 L20 P0 Z3\nG0 X1 Y1\nG1 Z-1 F100\nG2 X2 Y1 I.5\nG3 X3 R.5\nG18 G2 X4 I.5\nG17\n"
      "G28 Z1\nG28.1\nG30\nG30.1\nG43.1 Z2\nG53 G0 Z0\nG55\nG59\nG92 X0\nG92.1\nG93 G1 X1 F2\nG94\nG4 P.1\n"
      "M3 S1000\nM4\nM5\nM8\nM9\nM0\nT255\nG91\nG20\nN10000000 G0 X1\nM30\n");
  EXPECT_TRUE(result.diagnostics.all().empty()) << result.rendered();
}

// A sender takes them out. To grbl itself a '%' is error 1, which a sender is told line by line.
TEST(Grbl, passes_over_a_percent_sign_that_stands_alone) {
  const Interpreted result = as_grbl("%\nG0 X1\n %\nG0 X2\nM30\n%\n");
  EXPECT_TRUE(result.diagnostics.all().empty()) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 2U);
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  options.open_ended = true;
  const Interpreted line = interpret_text("%\n", options);
  EXPECT_EQ(line.diagnostics.all().front().code, "grbl.expected-letter") << line.rendered();
}

TEST(Grbl, names_a_command_to_grbl_itself_in_every_dialect) {
  for (const char* const program : {"$H\nG0 X1\nM2\n", "G0 X1\n$32=1\nM2\n", "$X\n%\nG0 X1\nM2\n%\n"}) {
    const Interpreted grbl = as_grbl(program);
    ASSERT_EQ(grbl.diagnostics.errors(), 1U) << program << grbl.rendered();
    EXPECT_EQ(grbl.diagnostics.all().front().code, "grbl.system-command");
    const Interpreted linuxcnc = interpret_text(program);
    ASSERT_EQ(linuxcnc.diagnostics.errors(), 1U) << program << linuxcnc.rendered();
    EXPECT_EQ(linuxcnc.diagnostics.all().front().code, "gcode.grbl-command");
    EXPECT_EQ(grbl.diagnostics.all().front().message, linuxcnc.diagnostics.all().front().message);
  }
}

TEST(Grbl, begins_with_rapids) {
  EXPECT_EQ(as_grbl("X10\nM2").all<operation::StraightTraverse>().size(), 1U);
  EXPECT_EQ(interpret_text("X10\nM2").diagnostics.errors(), 1U);
}

TEST(Grbl, moves_in_machine_coordinates_in_incremental_distances_too) {
  const Interpreted result = as_grbl("G10 L2 P1 Z5\nG91\nG0 Z1\nG53 G0 Z1\nG53\nG53 G0\nM2");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.last<operation::StraightTraverse>().end[Axis::z], -4);
}

TEST(Grbl, keeps_the_feed_where_g94_is_active_already) {
  EXPECT_FALSE(as_grbl("G1 X5 F100\nG94\nG1 X6\nM2").diagnostics.any_error());
  EXPECT_EQ(as_grbl("G1 X5 F100\nG93\nG94\nG1 X6\nM2").diagnostics.errors(), 1U);
  EXPECT_EQ(interpret_text("G1 X5 F100\nG94\nG1 X6\nM2").diagnostics.errors(), 1U);
}

TEST(Grbl, takes_the_feed_in_the_units_of_its_own_block) {
  const Interpreted inches = as_grbl("G1 G20 X1 F10\nM2");
  EXPECT_TRUE(inches.diagnostics.all().empty()) << inches.rendered();
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(inches.all<operation::SetFeedRate>().front().feed).linear.value(),
                   254.0 / 60);
  EXPECT_EQ(inches.all<operation::SetLengthUnits>().size(), 2U) << "at the start, and by G20";
  const Interpreted mm = as_grbl("G20\nF254 G21 G1 X1\nM2");
  EXPECT_TRUE(mm.diagnostics.all().empty()) << mm.rendered();
  EXPECT_DOUBLE_EQ(std::get<operation::FeedPerSecond>(mm.all<operation::SetFeedRate>().front().feed).linear.value(),
                   254.0 / 60);
}

TEST(Grbl, takes_a_line_number_amid_the_line) {
  const Interpreted result = as_grbl("G0 N20 X1\nX2 N30\nM2");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_NE(result.canon.find("N20    STRAIGHT_TRAVERSE"), std::string::npos) << result.canon;
  EXPECT_EQ(interpret_text("G0 N20 X1\nM2").diagnostics.errors(), 1U);
}

TEST(Grbl, takes_the_whole_part_of_a_tool) {
  const Interpreted result = as_grbl("T2.5\nM2");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.last<operation::SelectTool>().tool, 2);
}

TEST(Grbl, probes_in_inverse_time) {
  const Interpreted result = as_grbl("G93\nG38.3 Z-10 F2\nM2");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_TRUE(result.diagnostics.all().empty()) << result.rendered();
  EXPECT_NEAR(std::get<operation::FeedPerSecond>(result.all<operation::SetFeedRate>().front().feed).linear.value(),
              20.0 / 60, 1e-12);
}

TEST(Grbl, passes_over_centre_words_outside_the_plane_of_an_arc) {
  EXPECT_EQ(as_grbl("F9 G2 X2 I1 K5\nM2").calls(), as_grbl("F9 G2 X2 I1\nM2").calls());
  EXPECT_EQ(as_grbl("F9 G18 G2 X2 I1 J5\nM2").calls(), as_grbl("F9 G18 G2 X2 I1\nM2").calls());
  EXPECT_EQ(interpret_text("F9 G2 X2 I1 K5\nM2").diagnostics.errors(), 1U);
}

TEST(Grbl, drops_the_slash_and_runs_the_line) {
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  options.block_delete = true;
  EXPECT_EQ(interpret_text("/G0 X10\nM2", options).all<operation::StraightTraverse>().size(), 1U);
}

TEST(Grbl, takes_what_has_no_effect_without_effect) {
  const std::string plain = as_grbl("G0 X1\nM2").calls();
  EXPECT_EQ(as_grbl("G40 G61 G91.1 M1 G0 X1\nM2").calls(), plain);
  const Interpreted comments = as_grbl("(print,hello)\n(abort,stop)\nG0 X1\nM2");
  EXPECT_TRUE(comments.diagnostics.all().empty()) << comments.rendered();
  EXPECT_TRUE(comments.all<operation::StraightTraverse>().size() == 1);
  EXPECT_EQ(comments.canon.find("MESSAGE"), std::string::npos);
}

// As grblHAL does: the operator reads it where the program waits.
TEST(Grbl, shows_messages) {
  const Interpreted message = as_grbl("(MSG,Turn the plate)\nM0\nM2");
  EXPECT_TRUE(message.diagnostics.all().empty()) << message.rendered();
  EXPECT_NE(message.canon.find("MESSAGE(\"Turn the plate\")"), std::string::npos) << message.canon;
}

TEST(Grbl, counts_neither_blanks_nor_comments_of_a_line) {
  const std::string blanks(100, ' ');
  std::string comment(102, 'c');
  comment.front() = '(';
  comment.back() = ')';
  EXPECT_FALSE(
      as_grbl("G0" + blanks + "X1" + comment + "Y1 ;" + std::string(99, 'c') + "\nM2").diagnostics.any_error());
  EXPECT_FALSE(as_grbl("G0X" + std::string(76, '1').replace(1, 1, ".") + "\nM2").diagnostics.any_error());
  EXPECT_TRUE(as_grbl("G0X" + std::string(77, '1').replace(1, 1, ".") + "\nM2").diagnostics.any_error());
}

TEST(Grbl, numbers_are_said_in_its_dialect_alone) {
  const Interpreted result = interpret_text("G1 X1\nM2");
  ASSERT_EQ(result.diagnostics.errors(), 1U);
  EXPECT_EQ(result.rendered().find("grbl"), std::string::npos);
}

}  // namespace
}  // namespace passo
