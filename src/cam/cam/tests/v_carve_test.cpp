// V-carving: the cutter touches the lines on both sides, cuts nothing beyond, and leaves nothing between.
#include "passo/cam/v_carve.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "closed_lines.hpp"
#include "random_star.hpp"
#include <gmock/gmock.h>

#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

using test::corner;
using test::PathPoints;

struct Carved {
  VCarvePlan plan;
  Diagnostics findings;
};
Carved carved(const Region& area, const VCarveOptions& options) {
  Carved result;
  result.plan = plan_v_carve(area, options, result.findings);
  return result;
}

// Straight from what the words mean: the distance to the nearest edge of the region, mm.
double to_edge_mm(const Region& region, double x, double y) {
  double least = 1e9;
  for (const DrawnRing& ring : region.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double ax = to_mm(ring[i].x).value();
      const double ay = to_mm(ring[i].y).value();
      const double dx = to_mm(ring[(i + 1) % ring.size()].x).value() - ax;
      const double dy = to_mm(ring[(i + 1) % ring.size()].y).value() - ay;
      const double share = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      least = std::min(least, std::hypot(ax + share * dx - x, ay + share * dy - y));
    }
  }
  return least;
}

struct VDisc {
  double x;
  double y;
  double radius;  // at the face
};
// What the cutter takes at the face, at many places of its way.
std::vector<VDisc> discs_of(const VCarvePlan& plan, double slope, double tip) {
  std::vector<VDisc> discs;
  for (const MillTool& tool : plan.mill.tools) {
    for (const MillRun& run : tool.runs) {
      for (std::size_t i = 0; i + 1 < run.size(); ++i) {
        const int parts = 1 + static_cast<int>(distance_nm(run[i].at, run[i + 1].at) / 2e4);
        for (int k = 0; k <= parts; ++k) {
          const double s = static_cast<double>(k) / parts;
          const auto mix = [&](Nanometres a, Nanometres b) {
            return to_mm(a).value() * (1 - s) + to_mm(b).value() * s;
          };
          discs.push_back({mix(run[i].at.x, run[i + 1].at.x), mix(run[i].at.y, run[i + 1].at.y),
                           tip / 2 - mix(run[i].z, run[i + 1].z) * slope});
        }
      }
    }
  }
  return discs;
}

void expect_carved(const Region& area, const VCarvePlan& plan, double slope, double tip, double left) {
  const std::vector<VDisc> discs = discs_of(plan, slope, tip);
  ASSERT_FALSE(discs.empty());
  for (std::size_t i = 0; i < discs.size(); i += 7) {
    ASSERT_LE(discs[i].radius, to_edge_mm(area, discs[i].x, discs[i].y) + 0.006) << discs[i].x << ", " << discs[i].y;
  }
  std::mt19937_64 random(5);
  const DrawnBox box = *bounds(area);
  std::uniform_real_distribution<double> across(to_mm(box.least.x).value(), to_mm(box.most.x).value());
  std::uniform_real_distribution<double> up(to_mm(box.least.y).value(), to_mm(box.most.y).value());
  for (int trial = 0; trial < 300; ++trial) {
    const double x = across(random);
    const double y = up(random);
    const DrawnPoint at{to_nanometres(Mm(x)), to_nanometres(Mm(y))};
    if (!contains(area, at) || contains(plan.floor, at) || to_edge_mm(area, x, y) < left) continue;
    double nearest = 1e9;
    for (const VDisc& disc : discs) nearest = std::min(nearest, std::hypot(disc.x - x, disc.y - y) - disc.radius);
    EXPECT_LE(nearest, 0.006) << x << ", " << y;
  }
}

TEST(VCarve, a_box_has_its_ridge_and_sharp_corners) {
  const Region box = enclosed_by({{corner(0, 0), corner(20, 0), corner(20, 4), corner(0, 4)}});
  const Carved result = carved(box, {.angle_degrees = 90, .widest = to_nanometres(Mm(10))});
  EXPECT_TRUE(result.findings.all().empty());
  EXPECT_NEAR(to_mm(result.plan.deepest).value(), -2, 1e-5);
  EXPECT_TRUE(result.plan.floor.empty());
  double least_x = 20;
  for (const MillRun& run : result.plan.mill.tools.at(0).runs) {
    for (const MillPoint& point : run) {
      least_x = std::min(least_x, to_mm(point.at.x).value());
      const bool is_corner = point.at.x.count == 0;
      EXPECT_TRUE(!is_corner || point.z.count == 0) << "in a corner the cutter comes up to the face";
    }
  }
  EXPECT_EQ(least_x, 0);
  expect_carved(box, result.plan, 1, 0, 0);
}

TEST(VCarve, of_random_shapes_touches_both_sides_and_leaves_nothing) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 6; ++trial) {
    const PathPoints points = test::random_star(
        {.corners = 4 + trial, .nearest = 3, .farthest = 8, .bulge = trial % 2 == 0 ? 0 : 0.3}, random);
    const Region area = enclosed_by({points, {corner(0.7, 0, 1), corner(-0.7, 0, 1)}});
    VCarveOptions options{.angle_degrees = 60, .widest = to_nanometres(Mm(20))};
    if (trial >= 4) options.deepest = to_nanometres(Mm(-2));
    const Carved result = carved(area, options);
    EXPECT_EQ(!result.plan.floor.empty(), trial >= 4) << trial;
    EXPECT_GE(result.plan.deepest, trial >= 4 ? to_nanometres(Mm(-2)) : to_nanometres(Mm(-20)));
    expect_carved(area, result.plan, std::tan(M_PI / 6), 0, 0);
  }
}

TEST(VCarve, a_tip_comes_no_deeper_than_its_flanks_touch) {
  const Region box = enclosed_by({{corner(0, 0), corner(20, 0), corner(20, 4), corner(0, 4)},
                                  {corner(30, 0), corner(40, 0), corner(40, 0.3), corner(30, 0.3)}});
  const Carved result =
      carved(box, {.angle_degrees = 90, .tip = to_nanometres(Mm(0.6)), .widest = to_nanometres(Mm(10))});
  EXPECT_NEAR(to_mm(result.plan.deepest).value(), -1.7, 1e-5);
  EXPECT_TRUE(contains(result.plan.unreached, corner(35, 0.15).at));
  EXPECT_FALSE(contains(result.plan.unreached, corner(10, 2).at));
  expect_carved(enclosed_by({{corner(0, 0), corner(20, 0), corner(20, 4), corner(0, 4)}}), result.plan, 1, 0.6, 0.31);
}

// Chords of a curve are no corners: a ring has one way around, and no branches.
TEST(VCarve, curves_have_no_branches) {
  const Region ring = enclosed_by({{corner(10, 0, 1), corner(-10, 0, 1)}, {corner(8, 0, 1), corner(-8, 0, 1)}});
  const Carved result = carved(ring, {.angle_degrees = 60});
  ASSERT_EQ(result.plan.mill.tools.at(0).runs.size(), 1U);
  for (const MillPoint& point : result.plan.mill.tools.at(0).runs[0]) {
    EXPECT_NEAR(std::hypot(to_mm(point.at.x).value(), to_mm(point.at.y).value()), 9, 1e-3);
    EXPECT_NEAR(to_mm(point.z).value(), -std::sqrt(3), 2e-3);
  }
  EXPECT_EQ(carved({}, {}).findings.all().at(0).code, "engrave.no-area");
}

// The walls of a plug go on above its lines: at each place of the way the cutter touches them where they lie.
TEST(VCarve, a_plug_fits_the_pocket_of_the_same_lines) {
  const auto box = [](std::int64_t least, std::int64_t most) {
    return filled({rectangle({{{least * 1'000'000}, {least * 1'000'000}}, {{most * 1'000'000}, {most * 1'000'000}}})});
  };
  const Region plug = box(0, 20);
  VCarveOptions options{.angle_degrees = 90, .widest = {12'000'000}, .deepest = {-4'000'000}};
  Diagnostics findings;
  const VCarvePlan pocket = plan_v_carve(plug, options, findings);
  options.start = {-3'500'000};
  options.deepest = {-1'000'000};
  const VCarvePlan around = plan_v_carve(subtracted(box(-8, 28), plug), options, findings);
  EXPECT_FALSE(findings.any_error());
  EXPECT_EQ(pocket.floor_z.count, -4'000'000);
  EXPECT_EQ(around.floor_z.count, -4'500'000);
  // On floors the cutter keeps as far from the lines as it is deeper than they are.
  const auto off = [&](const Region& floor) { return 20.0 - to_mm(bounds(floor)->most.x).value(); };
  EXPECT_NEAR(off(pocket.floor), 4, 0.01);
  double nearest = 1e9;
  for (const DrawnRing& ring : around.floor.rings) {
    for (const DrawnPoint& at : ring) {
      const double x = std::max({-to_mm(at.x).value(), to_mm(at.x).value() - 20, 0.0});
      const double y = std::max({-to_mm(at.y).value(), to_mm(at.y).value() - 20, 0.0});
      nearest = std::min(nearest, std::hypot(x, y));
    }
  }
  EXPECT_NEAR(nearest, 1, 0.01);
  options.widest = {6'000'000};
  EXPECT_TRUE(plan_v_carve(plug, options, findings).mill.tools.empty());
  EXPECT_THAT(render(findings, false), testing::HasSubstr("[engrave.narrow-cutter]"));
}

TEST(VCarve, in_layers_takes_no_more_than_a_step_and_leaves_nothing) {
  std::mt19937_64 random(23);
  for (int trial = 0; trial < 4; ++trial) {
    const PathPoints points = test::random_star(
        {.corners = 4 + trial, .nearest = 3, .farthest = 8, .bulge = trial % 2 == 0 ? 0 : 0.3}, random);
    const Region area = enclosed_by({points, {corner(0.7, 0, 1), corner(-0.7, 0, 1)}});
    VCarveOptions options{.angle_degrees = 60, .widest = to_nanometres(Mm(20)), .step = to_nanometres(Mm(0.7))};
    if (trial == 3) options.deepest = to_nanometres(Mm(-2));
    const Carved result = carved(area, options);
    const double deepest = -to_mm(result.plan.deepest).value();
    EXPECT_EQ(result.plan.layers, static_cast<std::size_t>(std::ceil(deepest / 0.7)));
    double before = 0;  // of the runs so far
    for (const MillRun& run : result.plan.mill.tools.at(0).runs) {
      double least = 100;
      double most = 0;
      for (const MillPoint& point : run) {
        least = std::min(least, -to_mm(point.z).value());
        most = std::max(most, -to_mm(point.z).value());
      }
      // A run lies within its layer, and layers come one after another.
      EXPECT_LE(most - least, 0.7 + 1e-6);
      EXPECT_LE(most, before + 0.7 + 1e-6);
      before = std::max(before, most);
    }
    expect_carved(area, result.plan, std::tan(M_PI / 6), 0, 0);
  }
}

}  // namespace
}  // namespace passo
