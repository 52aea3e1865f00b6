#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// X and Y of the moves, in order.
std::vector<std::pair<double, double>> moves(const std::string& program) {
  const Interpreted result = interpret_text("G21 G90\n" + program + "M2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<std::pair<double, double>> ends;
  for (const auto& move : result.all<operation::StraightTraverse>()) {
    ends.emplace_back(move.end[Axis::x], move.end[Axis::y]);
  }
  return ends;
}

TEST(Offsets, g92_makes_the_position_the_given_one) {
  EXPECT_THAT(moves("G0 X10 Y5\nG92 X1\nG91\nX1\n"), ElementsAre(std::pair(10.0, 5.0), std::pair(2.0, 5.0)));
}

TEST(Offsets, g92_is_suspended_restored_and_cleared) {
  EXPECT_THAT(moves("G0 X10\nG92 X0\nG92.2\nG91 X1\nG92.3\nX1\nG92.1\nX1\n"),
              ElementsAre(std::pair(10.0, 0.0), std::pair(11.0, 0.0), std::pair(2.0, 0.0), std::pair(13.0, 0.0)));
}

TEST(Offsets, g10_l20_makes_the_position_the_given_one_in_a_turned_system_too) {
  const auto ends = moves("G10 L2 P1 R30 X5 Y7\nG0 X10 Y20\nG10 L20 P1 X1 Y2\nG91 X1\n");
  EXPECT_NEAR(ends.back().first, 2, 1e-12);
  EXPECT_NEAR(ends.back().second, 2, 1e-12);
}

TEST(Offsets, g10_l20_of_one_axis_in_a_turned_system_leaves_the_other) {
  const auto ends = moves("G10 L2 P2 R30\nG55\nG0 X10 Y20\nG10 L20 P0 X1\nG91 Y0\n");
  EXPECT_NEAR(ends.back().first, 1, 1e-12);
  EXPECT_NEAR(ends.back().second, 20, 1e-12);
}

TEST(Offsets, another_systems_offset_is_set_without_a_move_of_the_frame) {
  const Interpreted result = interpret_text("G21\nG10 L2 P3 X5\nG56\nM2\n");
  EXPECT_THAT(result.calls(), testing::StartsWith("USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
                                                  "COMMENT(\"interpreter: setting coordinate system origin\")\n"
                                                  "SET_G5X_OFFSET(3, 5.0000, "));
}

TEST(Offsets, g28_goes_by_way_of_the_given_point_and_home_in_the_given_axes) {
  EXPECT_THAT(moves("G0 X3 Y4\nG28.1\nG0 X10 Y20\nG28 X5\n"),
              ElementsAre(std::pair(3.0, 4.0), std::pair(10.0, 20.0), std::pair(5.0, 20.0), std::pair(3.0, 20.0)));
  EXPECT_THAT(moves("G0 X3 Y4\nG30.1\nG0 X10 Y20\nG30\n"),
              ElementsAre(std::pair(3.0, 4.0), std::pair(10.0, 20.0), std::pair(10.0, 20.0), std::pair(3.0, 4.0)));
}

TEST(Offsets, homes_are_machine_positions) {
  const auto ends = moves("G10 L2 P1 X100 R90\nG0 X1 Y2\nG28.1\nG10 L2 P1 X0 R0\nG28\n");
  EXPECT_NEAR(ends.back().first, 98, 1e-12);
  EXPECT_NEAR(ends.back().second, 1, 1e-12);
}

TEST(Offsets, g53_leaves_unnamed_axes_where_they_are_bit_for_bit) {
  const auto ends = moves("G10 L2 P1 X0.1 Y0.7\nG0 X0.3 Y0.123456789\nG53 G0 X0\n");
  EXPECT_EQ(ends.back().second, 0.123456789);
  EXPECT_EQ(ends.back().first, -0.1);
}

TEST(Offsets, tool_length_moves_the_numbers_and_not_the_tool) {
  const Interpreted result = interpret_text("G21\nG0 Z10\nG43.1 Z3\n(debug,#5422 #<_abs_z>)\nG49\n(debug,#5422)\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"7.000000 10.000000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"10.000000\")"));
}

TEST(Offsets, live_in_parameters_in_millimetres) {
  const Interpreted result = interpret_text(
      "G20\nG10 L2 P2 X1 A90 R45\n(debug,#5241 #5244 #5250)\nG0 X2\nG92 X1\n"
      "(debug,#5210 #5211)\n#5261=25.4\nG56\n(debug,#5420 #5220)\nG28.1\n"
      "(debug,#5161)\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"25.400000 90.000000 45.000000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000 25.400000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"0.000000 3.000000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"50.800000\")"));
}

}  // namespace
}  // namespace passo
