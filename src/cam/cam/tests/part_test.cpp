// Profiles and pockets: what is cut, what stays, and what the cutter cannot reach.
#include <algorithm>
#include <cmath>
#include <random>

#include "closed_lines.hpp"
#include "random_star.hpp"
#include <gmock/gmock.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/profile.hpp"

namespace passo {
namespace {

using test::box;
using test::circle;
using test::corner;
using test::PathPoints;

Nanometres mm(double length) {
  return to_nanometres(Mm(length));
}

struct Profiled {
  ProfilePlan plan;
  Diagnostics findings;
};
Profiled profiled(const std::vector<PathPoints>& loops, ProfileSide side, const OutlineOptions& cut,
                  const std::vector<PathPoints>& lines = {}) {
  Profiled result;
  result.plan = plan_profile(loops, lines, {.cut = cut, .side = side}, result.findings);
  return result;
}
const std::vector<MillRun>& runs_of(const MillPlan& plan) {
  return plan.tools.at(0).runs;
}

TEST(Profile, goes_around_a_part_and_inside_its_holes_first) {
  const Profiled result = profiled({box(0, 0, 40, 30), circle(20, 15, 6)}, ProfileSide::part,
                                   {.cutter = mm(2), .depth = mm(-1), .step = mm(1)});
  EXPECT_FALSE(result.findings.any_error());
  EXPECT_EQ(result.plan.outline.outsides, 1U);
  EXPECT_EQ(result.plan.outline.openings, 1U);
  EXPECT_EQ(result.plan.outline.lost_mm2, 0);
  EXPECT_LT(result.plan.unreached_mm2, 1e-3);
  const auto& runs = runs_of(result.plan.outline.mill);
  ASSERT_EQ(runs.size(), 2U);
  for (const MillPoint& point : runs[0]) EXPECT_NEAR(distance_nm(point.at, corner(20, 15).at), 5e6, 5e3);
  EXPECT_LE(runs[0].size(), 4U) << "a circle is arcs";
}

TEST(Profile, inside_and_outside_are_those_of_each_loop) {
  const OutlineOptions cut{.cutter = mm(2), .depth = mm(-1), .step = mm(1)};
  const std::vector<PathPoints> loops = {box(0, 0, 40, 30), box(10, 10, 10, 10)};
  const auto widest_x = [](const MillRun& run) {
    return to_mm(std::ranges::max_element(run, {}, [](const MillPoint& point) { return point.at.x; })->at.x).value();
  };
  const Profiled inside = profiled(loops, ProfileSide::inside, cut);
  const auto& in = runs_of(inside.plan.outline.mill);
  ASSERT_EQ(in.size(), 2U);
  EXPECT_NEAR(widest_x(in[0]), 19, 0.01) << "the inner loop comes first";
  EXPECT_NEAR(widest_x(in[1]), 39, 0.01);
  // Eight corners stay round.
  EXPECT_NEAR(inside.plan.unreached_mm2, 8 * (1 - M_PI / 4), 0.1);
  const Profiled outside = profiled(loops, ProfileSide::outside, cut);
  const auto& out = runs_of(outside.plan.outline.mill);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_NEAR(widest_x(out[0]), 21, 0.01);
  EXPECT_NEAR(widest_x(out[1]), 41, 0.01);
  EXPECT_LT(outside.plan.unreached_mm2, 1e-3);
}

TEST(Profile, gaps_that_are_too_narrow_are_told_and_kept) {
  const OutlineOptions cut{.cutter = mm(2), .depth = mm(-1), .step = mm(1)};
  const Profiled gap = profiled({box(0, 0, 10, 10), box(11, 0, 10, 10)}, ProfileSide::part, cut);
  EXPECT_EQ(runs_of(gap.plan.outline.mill).size(), 1U);
  EXPECT_NEAR(gap.plan.unreached_mm2, 10, 0.5);
  EXPECT_TRUE(contains(gap.plan.unreached, corner(10.5, 5).at));
  const Profiled slot = profiled({box(0, 0, 30, 30), box(10, 10, 1, 10)}, ProfileSide::part, cut);
  ASSERT_EQ(slot.findings.all().size(), 1U);
  EXPECT_EQ(slot.findings.all()[0].code, "outline.narrow-opening");
  EXPECT_FALSE(slot.findings.any_error());
  EXPECT_NEAR(slot.plan.unreached_mm2, 10, 0.1);
}

TEST(Profile, tabs_hold_what_falls_out_of_an_inside) {
  const OutlineOptions cut{.cutter = mm(2), .depth = mm(-4), .step = mm(2), .tabs = 3};
  EXPECT_EQ(profiled({box(0, 0, 60, 60)}, ProfileSide::inside, cut).plan.outline.tabs.size(), 3U);
}

TEST(Profile, on_the_line_open_paths_are_cut_there_and_back) {
  const OutlineOptions cut{.cutter = mm(1), .depth = mm(-1), .step = mm(0.5)};
  const Profiled result =
      profiled({circle(50, 0, 10)}, ProfileSide::on, cut, {{corner(0, 0), corner(10, 0, 1), corner(20, 0)}});
  EXPECT_EQ(result.plan.lines, 1U);
  const auto& runs = runs_of(result.plan.outline.mill);
  ASSERT_EQ(runs.size(), 2U);
  const MillRun& line = runs[0];
  EXPECT_EQ(line.front().at, corner(0, 0).at);
  EXPECT_EQ(line.front().z, mm(-0.5));
  EXPECT_EQ(line.back().at, corner(0, 0).at);
  EXPECT_EQ(line.back().z, mm(-1));
  EXPECT_NEAR(line[1].bulge, 1, 1e-6);
  EXPECT_NEAR(line[line.size() - 3].bulge, -1, 1e-6) << "back along the same arc";
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += way_nm(line[i].at, line[i + 1].at, line[i].bulge) / 1e6;
  EXPECT_NEAR(length, 2 * (10 + 5 * M_PI), 1e-3);
  // With a ramp the ground is still at depth everywhere.
  OutlineOptions ramped = cut;
  ramped.ramp_degrees = 5;
  const Profiled down = profiled({circle(50, 0, 10)}, ProfileSide::on, ramped);
  double deep = 0;
  const MillRun& run = runs_of(down.plan.outline.mill)[0];
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    if (run[i].z == mm(-1) && run[i + 1].z == mm(-1)) deep += way_nm(run[i].at, run[i + 1].at, run[i].bulge) / 1e6;
  }
  EXPECT_NEAR(deep, 20 * M_PI, 1e-3);
  EXPECT_EQ(profiled({}, ProfileSide::on, cut).findings.all().at(0).code, "profile.no-line");
}

struct Pocketed {
  PocketPlan plan;
  Diagnostics findings;
};
Pocketed pocketed(const Region& area, const PocketOptions& options) {
  Pocketed result;
  result.plan = plan_pocket(area, options, result.findings);
  return result;
}
// What a cutter can reach at most: all places of a disc that lies inside.
double opened_mm2(const Region& area, double radius) {
  return area_mm2(grown(grown(area, mm(-radius), {200}), mm(radius), {200}));
}

TEST(Profile, on_the_line_the_cutter_goes_down_at_a_dot) {
  Diagnostics findings;
  ProfileOptions options{.side = ProfileSide::on};
  options.cut.depth = {-300'000};
  const DrawnPoint dot{{5'000'000}, {7'000'000}};
  const ProfilePlan plan = plan_profile({}, {{{dot, 0}}}, options, findings);
  EXPECT_FALSE(findings.any_error());
  EXPECT_EQ(plan.dots, 1U);
  EXPECT_EQ(plan.lines, 0U);
  const std::string program = write_mill_program(plan.outline.mill, {});
  EXPECT_THAT(program, testing::HasSubstr("G0 X5 Y7\nG0 Z0.5\n"));
  EXPECT_THAT(program, testing::HasSubstr("G1 Z-0.3\nG0 Z"));
}

TEST(Pocket, clears_all_but_the_corners_and_keeps_islands) {
  const Region area = enclosed_by({box(0, 0, 40, 30), circle(20, 15, 5)});
  const Pocketed result = pocketed(area, {.cutter = mm(4), .depth = mm(-2), .step = mm(1)});
  EXPECT_TRUE(result.findings.all().empty());
  EXPECT_EQ(result.plan.pockets, 1U);
  EXPECT_LT(result.plan.lost_mm2, 1e-6);
  EXPECT_NEAR(result.plan.unreached_mm2, 4 * (1 - M_PI / 4) * 4, 0.15);
  for (const MillRun& run : runs_of(result.plan.mill)) {
    for (const MillPoint& point : run) {
      EXPECT_LE(point.z, mm(0));
      EXPECT_GE(point.z, mm(-2));
    }
  }
}

TEST(Pocket, sharp_corners_between_loops_are_cleared_too) {
  // Corners of 14 degrees: loops leave ground between them along the bisectors.
  const PathPoints spike = {corner(0, 0), corner(80, 10), corner(0, 20)};
  const Region area = enclosed_by({spike});
  for (const double step_over : {0.3, 0.5, 0.9}) {
    const Pocketed result = pocketed(area, {.cutter = mm(3), .step_over = step_over});
    EXPECT_NEAR(result.plan.unreached_mm2, area_mm2(area) - opened_mm2(area, 1.5), 0.2) << step_over;
    EXPECT_LT(result.plan.lost_mm2, 1e-6);
  }
}

TEST(Pocket, of_random_shapes_leaves_only_what_no_cutter_of_its_size_reaches) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 7; ++trial) {
    const Region area = enclosed_by({test::random_star({.corners = 5 + trial}, random)});
    const double radius = 0.5 + 2 * share(random);
    const Pocketed result = pocketed(
        area, {.cutter = mm(2 * radius), .step_over = 0.2 + 0.7 * share(random), .ramp_degrees = 3.0 * (trial % 2)});
    const double reachable = opened_mm2(area, radius);
    EXPECT_NEAR(area_mm2(area) - result.plan.unreached_mm2, reachable, 0.02 * 2 * M_PI * 25) << trial;
    EXPECT_LT(result.plan.lost_mm2, 1e-6) << trial;
  }
}

TEST(Pocket, a_part_that_is_too_narrow_is_told) {
  const Region area = enclosed_by({box(0, 0, 40, 30), box(60, 0, 2, 30)});
  const Pocketed result = pocketed(area, {.cutter = mm(4)});
  ASSERT_EQ(result.findings.all().size(), 1U);
  EXPECT_EQ(result.findings.all()[0].code, "pocket.narrow");
  EXPECT_THAT(result.findings.all()[0].message, testing::HasSubstr("X61 Y15"));
  EXPECT_TRUE(contains(result.plan.unreached, corner(61, 15).at));
  EXPECT_EQ(pocketed({}, {}).findings.all().at(0).code, "pocket.no-area");
}

// A dumb-bell has two middles: between them the cutter lifts, or goes where it has cut.
TEST(Pocket, goes_through_uncut_ground_no_farther_than_its_width) {
  const Region area = united(enclosed_by({box(0, 0, 20, 20)}),
                             united(enclosed_by({box(60, 0, 20, 20)}), enclosed_by({box(19, 8, 42, 4)})));
  const Pocketed result = pocketed(area, {.cutter = mm(3), .depth = mm(-1), .step = mm(1), .ramp_degrees = 0});
  EXPECT_GE(runs_of(result.plan.mill).size(), 2U);
  EXPECT_LT(result.plan.lost_mm2, 1e-6);
}

}  // namespace
}  // namespace passo
