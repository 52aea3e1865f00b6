// Pen plots and drag knives: the drawn lines, the number of lifts, and the path of the tip of a dragged blade.
#include "passo/cam/plot_plan.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "closed_lines.hpp"
#include "random_star.hpp"
#include <gmock/gmock.h>

#include "passo/cam/plot_program.hpp"

namespace passo {
namespace {

using test::box;
using test::circle;
using test::corner;
using test::PathPoints;

struct TipPlace {
  double x;
  double y;
};

TipPlace tip_place(DrawnPoint at) {
  return {to_mm(at.x).value(), to_mm(at.y).value()};
}

// Many points of a path, mm.
std::vector<TipPlace> places_of(const PathPoints& path, double step) {
  std::vector<TipPlace> places;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double length = way_nm(path[i].at, path[i + 1].at, path[i].bulge) / nanometres_per_mm;
    const int parts = 1 + static_cast<int>(length / step);
    for (int k = 0; k < parts; ++k) {
      places.push_back(tip_place(point_along(path[i].at, path[i + 1].at, path[i].bulge, double(k) / parts)));
    }
  }
  places.push_back(tip_place(path.back().at));
  return places;
}

// Simulates a blade with this offset that is dragged along: its tip moves only towards the axis. `tip`: its initial
// position, relative to the axis.
std::vector<TipPlace> dragged(const std::vector<TipPlace>& axis, double offset, TipPlace& tip) {
  TipPlace at{axis.front().x + tip.x, axis.front().y + tip.y};
  std::vector<TipPlace> places;
  for (const TipPlace& to : axis) {
    const double away = std::hypot(to.x - at.x, to.y - at.y);
    at = {to.x + (at.x - to.x) * offset / away, to.y + (at.y - to.y) * offset / away};
    places.push_back(at);
  }
  tip = {at.x - axis.back().x, at.y - axis.back().y};
  return places;
}

double to_nearest(const TipPlace& from, const std::vector<TipPlace>& places) {
  double least = 1e9;
  for (const TipPlace& to : places) least = std::min(least, std::hypot(to.x - from.x, to.y - from.y));
  return least;
}

// The tip cuts all lines, and nothing else.
TEST(PlotPlan, the_tip_of_a_dragged_blade_follows_the_lines) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 3; ++trial) {
    EdgeLoops lines;
    lines.loops.push_back(
        test::random_star({.corners = 5 + trial, .nearest = 5, .farthest = 12, .bulge = 0.2}, random));
    lines.loops.push_back(circle(1, 0, 2));
    lines.open.push_back({corner(15, 0), corner(20, 5, -0.4), corner(25, 5), corner(24, 5.5)});
    const PlotOptions options{.knife = to_nanometres(Mm(0.25)), .swivel_degrees = 5, .overcut = to_nanometres(Mm(0.6))};
    const PlotPlan plan = plan_plot(lines, options);
    ASSERT_EQ(plan.paths.size(), 3U);
    std::vector<TipPlace> drawn;
    for (const PathPoints& loop : lines.loops) {
      PathPoints closed = loop;
      closed.push_back({loop.front().at, 0});
      const std::vector<TipPlace> places = places_of(closed, 0.01);
      drawn.insert(drawn.end(), places.begin(), places.end());
    }
    const std::vector<TipPlace> open = places_of(lines.open.front(), 0.01);
    drawn.insert(drawn.end(), open.begin(), open.end());
    TipPlace tip{-0.25, 0};
    std::vector<TipPlace> cut;
    for (const PathPoints& path : plan.paths) {
      const std::vector<TipPlace> places = dragged(places_of(path, 0.004), 0.25, tip);
      cut.insert(cut.end(), places.begin(), places.end());
    }
    for (std::size_t i = 0; i < cut.size(); i += 71) {
      ASSERT_LE(to_nearest(cut[i], drawn), 0.02) << trial << ": " << cut[i].x << ", " << cut[i].y;
    }
    for (std::size_t i = 0; i < drawn.size(); i += 37) {
      ASSERT_LE(to_nearest(drawn[i], cut), 0.02) << trial << ": " << drawn[i].x << ", " << drawn[i].y;
    }
  }
}

TEST(PlotPlan, a_knife_swivels_at_corners_and_cuts_beyond_the_start) {
  EdgeLoops lines;
  lines.loops.push_back(box(0, 0, 10, 10));
  PlotOptions options{.knife = to_nanometres(Mm(0.5)), .overcut = to_nanometres(Mm(1))};
  const PlotPlan plan = plan_plot(lines, options);
  ASSERT_EQ(plan.paths.size(), 1U);
  const PathPoints& path = plan.paths.front();
  const auto arcs = std::ranges::count_if(path, [](const PathPoint& point) { return point.bulge != 0; });
  EXPECT_EQ(arcs, 4);  // three corners, and that of the start before the overcut
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i].bulge == 0) continue;
    EXPECT_NEAR(std::abs(path[i].bulge), std::tan(M_PI / 8), 1e-9);
    EXPECT_NEAR(way_nm(path[i].at, path[i + 1].at, path[i].bulge) / nanometres_per_mm, M_PI / 4, 1e-6);
  }
  // The tip ends 1 mm beyond the start, the axis 0.5 mm before it.
  EXPECT_EQ(path.back().at, corner(1.5, 0).at);
  options.swivel_degrees = 100;
  const PlotPlan blunt = plan_plot(lines, options);
  for (const PathPoint& point : blunt.paths.front()) EXPECT_EQ(point.bulge, 0);
}

TEST(PlotPlan, what_is_inside_is_cut_before_what_is_around_it) {
  EdgeLoops lines;
  lines.loops = {box(0, 0, 20, 20), box(5, 5, 10, 10), circle(10, 10, 2)};
  lines.open = {{corner(1, 1)}};  // a dot
  const PlotPlan plan = plan_plot(lines, {.knife = to_nanometres(Mm(0.25))});
  ASSERT_EQ(plan.paths.size(), 4U);
  EXPECT_EQ(plan.paths[0].size(), 1U);
  EXPECT_EQ(plan.closed, 3U);
  EXPECT_GT(to_mm(plan.paths[1].front().at.x).value(), 7.5);
  EXPECT_LT(to_mm(plan.paths[3].front().at.x).value(), 4);
}

// Rows in a jumbled order: each is drawn once, and from the end that is near.
TEST(PlotPlan, a_pen_draws_each_line_once_by_a_short_way) {
  EdgeLoops lines;
  for (int i = 0; i < 40; ++i) {
    const int row = i * 17 % 40;
    lines.open.push_back({corner(0, row), corner(100, row)});
  }
  lines.open.push_back({corner(50, 40)});  // a dot
  const PlotPlan plan = plan_plot(lines, {});
  EXPECT_EQ(plan.open, 40U);
  EXPECT_EQ(plan.dots, 1U);
  EXPECT_NEAR(plan.drawn_nm / nanometres_per_mm, 4000, 1e-6);
  EXPECT_LT(plan.travel_nm / nanometres_per_mm, 39 + 120 + 65);
}

TEST(PlotPlan, points_and_lines_without_a_length_are_dots) {
  Drawing drawing;
  drawing.holes = {{corner(1, 1).at, {}, 0, 0}, {corner(5, 5).at, to_nanometres(Mm(2)), 0, 0}};
  drawing.paths = {{.points = {corner(2, 2), corner(2, 2)}}, {.points = {corner(0, 0), corner(1, 0)}}};
  drawing.paths.push_back(drawing.paths.front());
  EXPECT_THAT(take_dots(drawing), testing::ElementsAre(corner(1, 1).at, corner(2, 2).at));
  EXPECT_EQ(drawing.holes.size(), 1U);
  EXPECT_EQ(drawing.paths.size(), 1U);
}

TEST(PlotProgram, a_pen_is_moved_by_z_or_by_a_servo) {
  const PlotPlan plan = plan_plot({.open = {{corner(0, 0), corner(10, 0, 1), corner(20, 0)}, {corner(30, 0)}}}, {});
  EXPECT_THAT(write_plot_program(plan, {.name = "p", .down = to_nanometres(Mm(-0.5))}),
              testing::EndsWith("G0 Z3\nG0 X0 Y0\nG1 Z-0.5 F600\nG1 X10 Y0 F1500\nG3 X20 Y0 I5 J0\nG0 Z3\n"
                                "G0 X30 Y0\nG1 Z-0.5 F600\nG4 P0.1\nG0 Z3\nG0 X0 Y0\nM2\n"));
  const std::string by_servo = write_plot_program(plan, {.servo = PenServo{.down = 90, .up = {}, .seconds = 0.3}});
  EXPECT_THAT(by_servo, testing::HasSubstr("M5\nG4 P0.3\nG0 X0 Y0\nM3 S90\nG4 P0.3\nG1 X10 Y0 F1500\n"));
  EXPECT_THAT(by_servo, testing::Not(testing::HasSubstr("Z")));
  EXPECT_THAT(write_plot_program(plan, {.servo = PenServo{.down = 90, .up = 30}}),
              testing::HasSubstr("M3 S30\nG4 P0.2\nG0 X0 Y0\nM3 S90\n"));
}

}  // namespace
}  // namespace passo
