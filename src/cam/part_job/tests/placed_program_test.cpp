#include "passo/part_job/placed_program.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(PlacedProgram, positions_turn_and_move_and_centres_turn) {
  EXPECT_EQ(placed_program("(a)\nG0 Z5\nG0 X10 Y0\nG1 Z-1\nG2 X20 Y10 I10\nG1 X25\nF200\n", {90, 100, 50}, "X0 Y0"),
            "(a)\nG0 Z5\nG0 X100 Y60\nG1 Z-1\nG2 X90 Y70 I0 J10\nG1 X90 Y75\nF200\n");
}

TEST(PlacedProgram, cycles_move_and_the_park_position_stays) {
  EXPECT_EQ(placed_program("G98 G83 X18 Y18 Z-8.3 R0.5 Q2\nX18 Y62\nG80\nG0 X0 Y0\nM2\n", {180, 100, 100}, "X0 Y0"),
            "G98 G83 X82 Y82 Z-8.3 R0.5 Q2\nX82 Y38\nG80\nG0 X0 Y0\nM2\n");
}

TEST(PlacedProgram, only_arcs_in_the_horizontal_plane_can_be_turned) {
  EXPECT_TRUE(can_be_turned("G17 G21\nG2 X1 Y1 I1 J0\n"));
  EXPECT_FALSE(can_be_turned("G17 G21\nG18\nG2 X1 Z1 I1 K0\n"));
}

TEST(PlacedProgram, each_tool_has_a_program_with_the_same_beginning) {
  const auto programs = programs_of_tools(
      "G17 G21\nG0 Z5\n\n(MSG, tool 1: flat)\nT1 M6\nG1 X1\nM5\nG0 X0 Y0\n(MSG, tool 2: V)\nT2 M6\nG1 X2\nM5\n"
      "G0 X0 Y0\nM2\n");
  ASSERT_EQ(programs.size(), 2U);
  EXPECT_EQ(programs[0], "G17 G21\nG0 Z5\n\nT1 M6\nG1 X1\nM5\nG0 X0 Y0\nM2\n");
  EXPECT_EQ(programs[1], "G17 G21\nG0 Z5\n\nT2 M6\nG1 X2\nM5\nG0 X0 Y0\nM2\n");
}

TEST(PlacedProgram, cuts_below_the_surface_are_sampled) {
  const auto points = cut_points_of("G0 Z5\nG0 X10 Y0\nG1 Z-1\nG3 X-10 Y0 I-10 J0\nG0 Z5\nG0 X50 Y50\n", 1);
  double top = 0;
  for (const ProgramPoint& point : points) {
    EXPECT_LE(point.x, 10 + 1e-9);
    top = std::max(top, point.y);
  }
  EXPECT_NEAR(top, 10, 0.05);
}

}  // namespace
}  // namespace passo
