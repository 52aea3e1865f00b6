#include "passo/cam/isolation.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "isolated_pads.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/cam/isolation_proof.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/mirror.hpp"

namespace passo {
namespace {

using test::isolated;
using test::pad;
using test::spot;
using test::two_pads;
using test::wide;
using test::with;

Region disc(double x, double y, double diameter) {
  return swept({{spot(x, y)}}, wide(diameter / 2));
}
std::size_t runs_of(const IsolationPlan& plan) {
  std::size_t runs = 0;
  for (const MillTool& tool : plan.mill.tools) runs += tool.runs.size();
  return runs;
}
double milled_mm(const IsolationPlan& plan) {
  double milled = 0;
  for (const MillTool& tool : plan.mill.tools) milled += lengths_of(tool, {}).milled_nm / nanometres_per_mm;
  return milled;
}
TEST(Isolation, one_loop_around_each_island_parts_them_and_takes_no_copper) {
  const auto [plan, proof] = isolated(two_pads(1), with({0.2}));
  EXPECT_EQ(plan.islands, 2U);
  EXPECT_EQ(runs_of(plan), 2U);
  EXPECT_TRUE(plan.gaps.empty());
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  // Around each pad four sides of 2 mm and four quarters of a circle of 0.107 mm.
  EXPECT_NEAR(milled_mm(plan), 2 * (8 + 2 * M_PI * 0.107), 0.01);
}

TEST(Isolation, corners_are_arcs_and_sides_are_lines) {
  const auto [plan, proof] = isolated(pad(0, 0, 2), with({0.2}));
  ASSERT_EQ(plan.mill.tools.at(0).runs.size(), 1U);
  std::size_t arcs = 0;
  for (const MillPoint& point : plan.mill.tools[0].runs[0]) arcs += point.bulge != 0 ? 1 : 0;
  EXPECT_GE(arcs, 4U);
  EXPECT_LE(arcs, 5U);  // the loop may begin within one
  EXPECT_LE(plan.mill.tools[0].runs[0].size(), 12U);
}

TEST(Isolation, copper_lies_to_the_right_when_climbing) {
  IsolationOptions options = with({0.2});
  for (const bool climb : {true, false}) {
    options.climb = climb;
    const auto [plan, proof] = isolated(pad(0, 0, 2), options);
    EXPECT_EQ(area_mm2(chords_of(plan.mill.tools.at(0).runs.at(0), {1000})) < 0, climb);
  }
}

TEST(Isolation, a_gap_too_narrow_is_told_with_its_place_and_width) {
  const auto [plan, proof] = isolated(two_pads(0.15), with({0.2}));
  ASSERT_EQ(plan.gaps.size(), 1U);
  EXPECT_EQ(plan.gaps[0].width, wide(0.15));
  EXPECT_EQ(plan.gaps[0].at.x, wide(1.075));
  EXPECT_GT(area_mm2(plan.unmilled), 0.2);
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 2U);
  EXPECT_EQ(proof.groups, 1U);
}

TEST(Isolation, a_finer_cutter_mills_only_what_the_wide_one_left_between_islands) {
  const Region copper = united(two_pads(0.3), disc(10, 0, 2));
  const auto [alone, joined] = isolated(copper, with({1}));
  EXPECT_EQ(joined.joined, 2U);
  const auto [plan, proof] = isolated(copper, with({0.2, 1}));
  ASSERT_EQ(plan.mill.tools.size(), 2U);
  EXPECT_EQ(plan.mill.tools[0].width, wide(1));
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  EXPECT_TRUE(plan.gaps.empty());
  // Along both sides of the gap and a little beyond; not around the pads.
  EXPECT_LT(lengths_of(plan.mill.tools[1], {}).milled_nm, 8e6);
}

TEST(Isolation, width_says_how_many_loops_and_the_cutter_stays_down_between) {
  IsolationOptions options = with({0.2});
  options.width = wide(0.6);
  const auto [plan, proof] = isolated(pad(0, 0, 2), options);
  EXPECT_EQ(runs_of(plan), 1U);
  EXPECT_EQ(proof.lost_mm2, 0);
  // 0.6 mm and the margin of 0.007 mm are free around the pad.
  const double outside = area_mm2(grown(pad(0, 0, 2), wide(0.607)));
  const double inside = area_mm2(grown(pad(0, 0, 2), wide(0.007)));
  // The proof's disc is 0.0017 mm wider than the cutter, along rims of 20 mm.
  EXPECT_NEAR(proof.milled_mm2, outside - inside, 0.0017 * 20);
}

TEST(Isolation, clearing_leaves_nothing_but_the_copper) {
  const Region copper = united({pad(3, 3, 2), disc(8, 6, 3), pad(6.5, 2, 0.8)});
  IsolationOptions options = with({0.4});
  options.clear = true;
  options.board = filled({rectangle({spot(0, 0), spot(12, 9)})});
  const auto [plan, proof] = isolated(copper, options);
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  std::vector<DrawnRing> ways;
  for (const MillRun& run : plan.mill.tools.at(0).runs) ways.push_back(chords_of(run, {500}));
  const Region left = subtracted(subtracted(options.board, grown(copper, wide(0.007))), swept(ways, wide(0.2)));
  EXPECT_LT(area_mm2(left), 0.05);
}

TEST(Isolation, nothing_is_milled_beyond_the_edge) {
  IsolationOptions options = with({0.2});
  options.board = filled({rectangle({spot(-3, -3), spot(0.5, 3)})});
  const auto [plan, proof] = isolated(pad(0, 0, 2), options);
  ASSERT_EQ(runs_of(plan), 1U);
  const MillRun& run = plan.mill.tools[0].runs[0];
  for (const MillPoint& point : run) EXPECT_LE(point.at.x, wide(0.6));
  // Climb milling: the copper is to the right of an open way, too.
  EXPECT_LT(run.front().at.y, Nanometres{});
  EXPECT_GT(run.back().at.y, Nanometres{});
}

TEST(Isolation, random_layouts_lose_no_copper_and_join_only_what_is_told) {
  std::uint64_t state = 7;
  const auto random = [&state](double least, double most) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return least + (most - least) * static_cast<double>(state >> 40U) / static_cast<double>(1U << 24U);
  };
  for (int layout = 0; layout < 15; ++layout) {
    std::vector<Region> shapes;
    for (int i = 0; i < 12; ++i) {
      const DrawnPoint from = spot(random(0, 8), random(0, 8));
      shapes.push_back(i % 3 == 0 ? pad(random(0, 8), random(0, 8), random(0.3, 1.5))
                                  : swept({{from, spot(random(0, 8), random(0, 8))}}, wide(random(0.05, 0.3))));
    }
    IsolationOptions options = with({layout % 2 == 0 ? 0.2 : 0.35, 0.12});
    options.passes = 1 + static_cast<std::uint32_t>(layout) % 3;
    const auto [plan, proof] = isolated(united(shapes), options);
    EXPECT_EQ(proof.lost_mm2, 0) << "layout " << layout;
    EXPECT_EQ(proof.joined == 0, plan.gaps.empty()) << "layout " << layout;
  }
}

TEST(Isolation, voronoi_goes_midway_and_parts_all_islands) {
  IsolationOptions options = with({0.2});
  options.voronoi = true;
  options.board = filled({rectangle({spot(-4, -4), spot(7, 4)})});
  const auto [plan, proof] = isolated(two_pads(1), options);
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  ASSERT_EQ(runs_of(plan), 1U);
  // Beside two equal pads it is a straight line, from edge to edge.
  EXPECT_NEAR(milled_mm(plan), 8.2, 0.05);
  for (const MillPoint& point : plan.mill.tools[0].runs[0]) EXPECT_NEAR(to_mm(point.at.x).value(), 1.5, 1e-5);

  options.passes = 3;
  const auto [wider, wide_proof] = isolated(two_pads(1), options);
  EXPECT_EQ(wide_proof.lost_mm2, 0);
  EXPECT_NEAR(wide_proof.milled_mm2, (8.2 + 0.2) * 0.6, 0.02);
}

// The oracle is the distance to each disc, not the diagram.
TEST(Isolation, voronoi_is_as_far_from_two_islands_and_no_nearer_to_a_third) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> within(0, 20);
  struct Disc {
    double x, y, radius;
  };
  std::vector<Disc> discs;
  std::vector<Region> faces;
  while (discs.size() < 12) {
    const Disc one{within(random), within(random), 0.3 + within(random) / 20};
    const bool is_apart = std::ranges::all_of(
        discs, [&](const Disc& d) { return std::hypot(d.x - one.x, d.y - one.y) > d.radius + one.radius + 0.3; });
    if (!is_apart) continue;
    discs.push_back(one);
    faces.push_back(disc(one.x, one.y, 2 * one.radius));
  }
  IsolationOptions options = with({0.2});
  options.voronoi = true;
  options.board = filled({rectangle({spot(-2, -2), spot(22, 22)})});
  const auto [plan, proof] = isolated(united(faces), options);
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  for (const MillTool& tool : plan.mill.tools) {
    for (const MillRun& run : tool.runs) {
      for (const DrawnPoint& at : chords_of(run, {1'000})) {
        std::vector<double> away;
        for (const Disc& one : discs)
          away.push_back(std::hypot(to_mm(at.x).value() - one.x, to_mm(at.y).value() - one.y) - one.radius);
        std::ranges::sort(away);
        EXPECT_NEAR(away[0], away[1], 0.006) << to_mm(at.x).value() << ", " << to_mm(at.y).value();
      }
    }
  }
}

TEST(Isolation, voronoi_leaves_to_a_finer_cutter_what_is_narrow_and_tells_what_remains) {
  const Region copper = united(united(two_pads(0.3), pad(6, 0, 2)), pad(8.15, 0, 2));
  IsolationOptions options = with({0.5, 0.2});
  options.voronoi = true;
  options.board = filled({rectangle({spot(-4, -4), spot(12, 4)})});
  const auto [plan, proof] = isolated(copper, options);
  EXPECT_EQ(proof.lost_mm2, 0);
  ASSERT_EQ(plan.mill.tools.size(), 2U);
  ASSERT_EQ(plan.gaps.size(), 1U);
  EXPECT_EQ(plan.gaps[0].width, wide(0.15));
  EXPECT_EQ(proof.joined, 2U);
}

TEST(Isolation, thermal_reliefs_are_milled_in_both_ways_and_told_where_they_are_too_narrow) {
  // A pad in a plane, on four spokes: one island with four openings.
  Region thermal = subtracted(pad(0, 0, 8), subtracted(disc(0, 0, 3), disc(0, 0, 2)));
  thermal = united(
      thermal, united(swept({{spot(-2, 0), spot(2, 0)}}, wide(0.2)), swept({{spot(0, -2), spot(0, 2)}}, wide(0.2))));
  for (const bool voronoi : {false, true}) {
    IsolationOptions options = with({0.3});
    options.voronoi = voronoi;
    const auto [plan, proof] = isolated(united(thermal, pad(10, 0, 2)), options);
    EXPECT_EQ(proof.lost_mm2, 0);
    EXPECT_TRUE(plan.narrow_openings.empty());
    EXPECT_EQ(proof.joined, 0U);
    EXPECT_EQ(runs_of(plan), 6U);
    options.cutters[0].width = wide(0.6);
    const IsolationPlan coarse = isolated(united(thermal, pad(10, 0, 2)), options).plan;
    EXPECT_EQ(coarse.narrow_openings.size(), 4U);
    EXPECT_EQ(runs_of(coarse), 2U);
  }
}

TEST(Isolation, a_v_cutter_is_as_wide_as_its_depth_makes_it) {
  EXPECT_EQ(v_cutter_width(wide(0.1), 90, wide(0.05)), wide(0.2));
  EXPECT_NEAR(to_mm(v_cutter_width(wide(0.1), 30, wide(0.1))).value(), 0.1536, 1e-4);
}

TEST(Isolation, no_copper_is_an_error) {
  Diagnostics findings;
  plan_isolation({}, with({0.2}), findings);
  ASSERT_EQ(findings.errors(), 1U);
  EXPECT_EQ(findings.all()[0].code, "isolation.no-copper");
}

TEST(IsolationProof, counts_copper_that_a_plan_takes) {
  MillPlan plan;
  plan.tools.push_back({wide(0.2), "cutter", {{{spot(-2, 0), 0, {}}, {spot(2, 0), 0, {}}}}});
  const IsolationProof proof = prove_isolation(pad(0, 0, 2), plan);
  EXPECT_NEAR(proof.lost_mm2, 0.4, 2 * 0.0017 * 2);  // the proof's disc is 0.0017 mm wider than the cutter
  EXPECT_EQ(proof.copper_mm2, 4);
}

TEST(IsolationProof, counts_what_is_taken_within_copper_and_copper_that_is_taken_whole) {
  MillPlan plan;
  plan.tools.push_back({wide(0.2), "cutter", {{{spot(-0.2, 0), 0, {}}, {spot(0.2, 0), 0, {}}}}});
  EXPECT_NEAR(prove_isolation(pad(0, 0, 2), plan).lost_mm2, 0.4 * 0.2 + M_PI * 0.01, 0.0025);
  EXPECT_NEAR(prove_isolation(pad(0, 0, 0.1), plan).lost_mm2, 0.01, 1e-6);
  EXPECT_EQ(prove_isolation(pad(0, 0.2, 0.19), plan).lost_mm2, 0);
}

// So many corners are proved strip by strip. No strip reaches from the pads on the left to those on the right, and yet
// they hang together, until a way across the board parts the upper ones from the lower ones.
TEST(IsolationProof, joins_the_strips_of_a_large_board) {
  constexpr int columns = 60;
  constexpr int corners = 500;
  Region copper = united({pad(-4, 0, 2), pad(4 * columns + 4, 0, 2), pad(-4, -20, 2), pad(4 * columns + 4, -20, 2)});
  MillPlan plan;
  plan.tools.push_back({wide(0.2), "cutter", {}});
  std::vector<MillRun>& runs = plan.tools.front().runs;
  for (int i = 0; i < columns; ++i) {
    copper = united(copper, pad(4 * i, 0, 1));
    MillRun around;
    for (int k = 0; k <= corners; ++k) {
      const double angle = 2 * M_PI * k / corners;
      around.push_back({spot(4 * i + 1.5 * std::cos(angle), 1.5 * std::sin(angle)), 0, {}});
    }
    runs.push_back(std::move(around));
  }
  IsolationProof proof = prove_isolation(copper, plan);
  EXPECT_EQ(proof.islands, columns + 4U);
  EXPECT_EQ(proof.joined, 4U);
  EXPECT_EQ(proof.groups, 1U);
  EXPECT_EQ(proof.lost_mm2, 0);
  EXPECT_NEAR(proof.milled_mm2, columns * 2 * M_PI * 1.5 * 0.2, columns * 2 * M_PI * 1.5 * 0.0045);

  runs.push_back({{{spot(-100, -10), 0, {}}, {spot(400, -10), 0, {}}}});
  proof = prove_isolation(copper, plan);
  EXPECT_EQ(proof.joined, 4U);  // around the ends, where the copper goes on
  const Region board = filled({rectangle({spot(-10, -30), spot(4 * columns + 10, 10)})});
  proof = prove_isolation(copper, plan, board);
  EXPECT_EQ(proof.joined, 4U);
  EXPECT_EQ(proof.groups, 2U);

  runs.push_back({{{spot(-100, 0), 0, {}}, {spot(-3.5, 0), 0, {}}}});
  EXPECT_NEAR(prove_isolation(copper, plan).lost_mm2, 1.5 * 0.2 + M_PI * 0.005, 0.01);
}

TEST(MillProgram, goes_down_along_and_up_and_ends_at_rest) {
  MillPlan plan;
  plan.tools.push_back({wide(0.2),
                        "cutter 0.2 mm",
                        {{{spot(1, 2), 0, wide(-0.1)}, {spot(3, 2), 1, wide(-0.1)}, {spot(5, 2), 0, wide(-0.1)}}}});
  const std::string program =
      write_mill_program(plan, {.name = "front.ngc", .command = "passo cam isolate", .spindle = 10'000});
  EXPECT_THAT(program, testing::HasSubstr("G17 G21 G40 G80 G90 G94\n\nG0 Z20\nM3 S10000\n"));
  EXPECT_THAT(program, testing::HasSubstr("M3 S10000\n"));
  EXPECT_THAT(program, testing::HasSubstr("G0 X1 Y2\nG0 Z0.5\nF60\nG1 Z-0.1\nF200\nG1 X3 Y2\nG3 X5 Y2 I1 J0\nG0 Z2\n"));
  EXPECT_THAT(program, testing::EndsWith("G0 Z2\nG0 Z20\nM5\nG0 X0 Y0\nM2\n"));
}

TEST(Mirror, turns_a_board_over_about_a_line) {
  const Mirror mirror{Mirror::Turned::x, wide(10)};
  EXPECT_EQ(mirrored(spot(3, 4), mirror), spot(17, 4));
  EXPECT_EQ(mirrored(spot(3, 4), {Mirror::Turned::y, wide(1)}), spot(3, -2));
  const Region turned = mirrored(pad(0, 0, 2), mirror);
  EXPECT_EQ(area_mm2(turned), 4);
  EXPECT_TRUE(contains(turned, spot(20, 0)));
  EXPECT_EQ(mirrored(turned, mirror).rings.size(), 1U);
}

}  // namespace
}  // namespace passo
