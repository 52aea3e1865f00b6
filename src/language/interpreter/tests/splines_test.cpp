// Splines: the control points that G5, G5.1 and G5.2 give; and scaling, G51.
#include "interpreted.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using Points = std::vector<operation::ControlPoint>;

void expect_points(const Points& found, const std::vector<std::array<double, 3>>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].x, expected[i][0], 1e-9) << i;
    EXPECT_NEAR(found[i].y, expected[i][1], 1e-9) << i;
    EXPECT_NEAR(found[i].weight, expected[i][2], 1e-9) << i;
  }
}

Points only_spline(const std::string& program) {
  const Interpreted result = interpret_text(program + "M2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.splines.size(), 1U);
  return result.splines.empty() ? Points{} : result.splines.back();
}

TEST(Splines, cubic_words_are_ways_from_both_ends) {
  expect_points(only_spline("G0 X1 Y2\nG5 X11 Y3 I1 J4 P-2 Q5 F100\n"), {{1, 2, 1}, {2, 6, 1}, {9, 8, 1}, {11, 3, 1}});
}

TEST(Splines, a_cubic_goes_on_in_the_direction_of_the_one_before) {
  const Interpreted result = interpret_text("G0 X0 Y0\nG5 X1 Y1 I0 J3 P0 Q-3 F100\nG5 X2 Y2 P0 Q-3\nX3 Y3 P1 Q1\nM2\n");
  ASSERT_FALSE(result.diagnostics.any_error()) << result.rendered();
  ASSERT_EQ(result.splines.size(), 3U);
  expect_points(result.splines[1], {{1, 1, 1}, {1, 4, 1}, {2, -1, 1}, {2, 2, 1}});
  expect_points(result.splines[2], {{2, 2, 1}, {2, 5, 1}, {4, 4, 1}, {3, 3, 1}});
}

TEST(Splines, a_quadratic_has_one_control_point_between_its_ends) {
  expect_points(only_spline("G0 X1 Y2\nG91 G5.1 X10 I1 J4 F100\n"), {{1, 2, 1}, {2, 6, 1}, {11, 2, 1}});
}

TEST(Splines, inches_and_diameters_are_those_of_the_program) {
  expect_points(only_spline("G20 G7 G5.1 X4 Y1 I1 J2 F9\n"), {{0, 0, 1}, {25.4, 50.8, 1}, {50.8, 25.4, 1}});
}

TEST(Splines, a_nurbs_begins_where_the_tool_is) {
  expect_points(only_spline("G0 X1 Y2\nG5.2 X3 Y4 P2 F100\nX5 Y6 P3\nG5.3\n"), {{1, 2, 1}, {3, 4, 2}, {5, 6, 3}});
}

TEST(Splines, the_weight_of_the_start_may_be_given_alone) {
  expect_points(only_spline("G5.2 P4 L3 F100\nX3 Y4 P2\nX5 Y6 P3\nG5.3\n"), {{0, 0, 4}, {3, 4, 2}, {5, 6, 3}});
}

TEST(Splines, incremental_control_points_count_from_the_start) {
  expect_points(only_spline("G0 X1 Y2\nG91 G5.2 X3 Y4 P2 F100\nX5 Y6 P3\nG5.3\n"), {{1, 2, 1}, {4, 6, 2}, {6, 8, 3}});
}

TEST(Splines, the_tool_is_at_the_end_of_the_nurbs_and_no_motion_is_active) {
  const Interpreted result =
      interpret_text("F9 G5.2 X3 Y4 P2\nX5 Y6 P3\nG5.3\nG91 G1 X1 Y1\nG90 G5.2 X1 Y1 P1\nX2 Y2 P1\nG5.3\nX3\nM2\n");
  const Point end = result.last<operation::StraightFeed>().end;
  EXPECT_EQ(end[Axis::x], 6);
  EXPECT_EQ(end[Axis::y], 7);
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.missing-motion");
}

TEST(Splines, a_wrong_control_point_is_told_once_and_there_is_no_curve) {
  const Interpreted result = interpret_text("F9 G5.2 X3 Y4 P-2\nG5.3\nG1 X1\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_TRUE(result.splines.empty());
}

TEST(Splines, a_nurbs_that_is_never_ended_is_told_at_the_end) {
  const Interpreted result = interpret_text("%\nF9 G5.2 X3 Y4 P2\n%\n");
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.open-nurbs");
}

TEST(Splines, a_nurbs_has_a_bounded_number_of_points) {
  std::string program = "F9 G5.2 X1 Y1 P1\n#1=0\no1 repeat [4096]\n#1=[#1+1]\nX#1 Y1 P1\no1 endrepeat\nG5.3\nM2\n";
  const Interpreted result = interpret_text(program);
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.too-many-points");
}

// G5.1 along a line whose control point is its middle: 10 mm in a half of a minute.
TEST(Splines, inverse_time_counts_the_length_of_the_curve) {
  const Interpreted result = interpret_text("G93 G5.1 X10 I5 J0 F2\nM2\n");
  const std::vector<operation::SetFeedRate> rates = result.all<operation::SetFeedRate>();
  ASSERT_FALSE(rates.empty());
  EXPECT_NEAR(std::get<operation::FeedPerSecond>(rates.front().feed).linear.value(), 20.0 / 60, 1e-12);
}

Point last_feed(const std::string& program) {
  const Interpreted result = interpret_text(program + "M2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  return result.last<operation::StraightFeed>().end;
}

TEST(Scaling, places_are_scaled_from_the_centre_and_ways_by_the_factor) {
  const Point place = last_feed("F9\nG51 X10 Y0 Z0 P2\nG1 X11 Y1 Z-1\n");
  EXPECT_EQ(place[Axis::x], 12);
  EXPECT_EQ(place[Axis::y], 2);
  EXPECT_EQ(place[Axis::z], -2);
  EXPECT_EQ(last_feed("F9 G0 X1\nG51 X10 P2\nG91 G1 X11\n")[Axis::x], 23);
}

TEST(Scaling, without_a_centre_it_is_where_the_tool_is) {
  EXPECT_EQ(last_feed("F9 G0 X10\nG51 P3\nG1 X11\n")[Axis::x], 13);
}

TEST(Scaling, each_axis_has_its_factor_and_other_axes_none) {
  const Point place = last_feed("F9\nG51 I2 K-1\nG1 X1 Y1 Z1 A1\n");
  EXPECT_EQ(place[Axis::x], 2);
  EXPECT_EQ(place[Axis::y], 1);
  EXPECT_EQ(place[Axis::z], -1);
  EXPECT_EQ(place[Axis::a], 1);
}

TEST(Scaling, ends_with_G50_and_leaves_machine_coordinates_and_offsets_alone) {
  EXPECT_EQ(last_feed("F9\nG51 P2\nG50\nG1 X5\n")[Axis::x], 5);
  EXPECT_EQ(last_feed("F9\nG51 P2\nG53 G1 X5\n")[Axis::x], 5);
  const Interpreted result = interpret_text("G51 P2\nG92 X5\nM2\n");
  EXPECT_EQ(result.last<operation::SetG92Offset>().offset[Axis::x], -5);
}

TEST(Scaling, arcs_keep_their_shape) {
  for (const char* arc : {"G3 X10 Y0 I5 J0", "G3 X10 Y0 R5", "G90.1 G3 X10 Y0 I5 J0"}) {
    const Interpreted result = interpret_text(std::string("F9\nG51 X0 Y0 P2\n") + arc + "\nM2\n");
    ASSERT_FALSE(result.diagnostics.any_error()) << result.rendered();
    const auto found = result.last<operation::ArcFeed>();
    EXPECT_EQ(found.end[Axis::x], 20) << arc;
    EXPECT_NEAR(found.first_center.value(), 10, 1e-9) << arc;
    EXPECT_NEAR(found.second_center.value(), 0, 1e-9) << arc;
  }
}

TEST(Scaling, splines_may_be_stretched) {
  expect_points(only_spline("F9\nG51 I2 J3\nG5 X1 Y1 I0 J1 P-1 Q0\n"), {{0, 0, 1}, {0, 3, 1}, {0, 3, 1}, {2, 3, 1}});
}

}  // namespace
}  // namespace passo
