// V-carving: the cutter touches the lines on both sides, cuts nothing beyond, and leaves nothing between.
#include "passo/cam/v_carve.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "../stroke_tour.hpp"
#include "closed_lines.hpp"
#include "random_star.hpp"
#include <gmock/gmock.h>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/mill_program.hpp"

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
// The position at this fraction of a line or an arc, mm. It follows from the definition of a bulge: the tangent of a
// quarter of the arc's angle, counterclockwise.
std::pair<double, double> place_on(const MillPoint& from, const MillPoint& to, double share) {
  const double x = to_mm(from.at.x).value();
  const double y = to_mm(from.at.y).value();
  const double dx = to_mm(to.at.x).value() - x;
  const double dy = to_mm(to.at.y).value() - y;
  if (from.bulge == 0) return {x + share * dx, y + share * dy};
  const double turn = 4 * std::atan(from.bulge);
  const double off = 0.5 / std::tan(turn / 2);
  const double cx = x + dx / 2 - dy * off;
  const double cy = y + dy / 2 + dx * off;
  const double c = std::cos(turn * share);
  const double s = std::sin(turn * share);
  return {cx + (x - cx) * c - (y - cy) * s, cy + (x - cx) * s + (y - cy) * c};
}
// What the cutter takes at the face, at many places of its way.
std::vector<VDisc> discs_of(const VCarvePlan& plan, double slope, double tip) {
  std::vector<VDisc> discs;
  for (const MillTool& tool : plan.mill.tools) {
    for (const MillRun& run : tool.runs) {
      for (std::size_t i = 0; i + 1 < run.size(); ++i) {
        const int parts = 1 + static_cast<int>(distance_nm(run[i].at, run[i + 1].at) / 2e4);
        for (int k = 0; k <= parts; ++k) {
          const double s = static_cast<double>(k) / parts;
          const auto [x, y] = place_on(run[i], run[i + 1], s);
          const double z = to_mm(run[i].z).value() * (1 - s) + to_mm(run[i + 1].z).value() * s;
          discs.push_back({x, y, tip / 2 - z * slope});
        }
      }
    }
  }
  return discs;
}

void expect_carved(const Region& area, const VCarvePlan& plan, double slope, double tip, double left) {
  const std::vector<VDisc> discs = discs_of(plan, slope, tip);
  ASSERT_FALSE(discs.empty());
  for (std::size_t i = 0; i < discs.size(); i += 3) {
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

double milled_mm(const VCarvePlan& plan) {
  return lengths_of(plan.mill.tools.at(0), {}).milled_nm / nanometres_per_mm;
}

// Teeth with two corners each: a branch into every corner. If lifts are expensive, the cutter plunges only once.
TEST(VCarve, stays_down_in_all_that_hangs_together) {
  PathPoints comb = {corner(0, 0)};
  for (int tooth = 0; tooth < 5; ++tooth) {
    for (const PathPoint& point :
         {corner(4 * tooth + 3, 0), corner(4 * tooth + 3, 6 + tooth % 2), corner(4 * tooth + 4, 6)}) {
      comb.push_back(point);
    }
    comb.push_back(corner(4 * tooth + 4, 0));
  }
  comb.insert(comb.end(), {corner(23, 0), corner(23, -3), corner(0, -3)});
  const Region area = enclosed_by({comb, test::box(30, 0, 4, 4)});
  VCarveOptions options{.angle_degrees = 60, .widest = to_nanometres(Mm(20)), .longest_return = to_nanometres(Mm(100))};
  const Carved down = carved(area, options);
  EXPECT_EQ(down.plan.mill.tools.at(0).runs.size(), 2U);  // two areas
  expect_carved(area, down.plan, std::tan(M_PI / 6), 0, 0);
  options.longest_return = {1};
  const Carved up = carved(area, options);
  EXPECT_GT(up.plan.mill.tools.at(0).runs.size(), 8U);
  expect_carved(area, up.plan, std::tan(M_PI / 6), 0, 0);
  EXPECT_GT(milled_mm(down.plan), milled_mm(up.plan));
  EXPECT_LT(milled_mm(down.plan), 2 * milled_mm(up.plan));
  // Branches into the corners of a floor begin where the cutter goes around it.
  options = {.angle_degrees = 60, .widest = to_nanometres(Mm(20)), .deepest = to_nanometres(Mm(-0.7))};
  const Carved flat = carved(area, options);
  EXPECT_FALSE(flat.plan.floor.empty());
  EXPECT_LE(flat.plan.mill.tools.at(0).runs.size(), flat.plan.floor.rings.size() + 1);
  expect_carved(area, flat.plan, std::tan(M_PI / 6), 0, 0);
}

TEST(VCarve, curves_become_arcs_and_helices) {
  const Region crescent = enclosed_by({{corner(10, 0, 1), corner(-10, 0, -0.6)}});
  const Carved result = carved(crescent, {.angle_degrees = 60, .widest = to_nanometres(Mm(20))});
  std::size_t helices = 0;
  std::size_t moves = 0;
  for (const MillRun& run : result.plan.mill.tools.at(0).runs) {
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      ++moves;
      if (run[i].bulge != 0 && run[i].z != run[i + 1].z) ++helices;
    }
  }
  EXPECT_GT(helices, 3U);
  EXPECT_LT(moves, 60U);
  expect_carved(crescent, result.plan, std::tan(M_PI / 6), 0, 0);
}

// Four legs of 10 mm: the second pair is reached by two returns, or by a lift if that is shorter.
TEST(VCarve, returns_and_lifts_are_as_short_as_possible) {
  std::vector<CutterStroke> legs;
  for (int i = 0; i < 4; ++i) {
    const auto [x, y] = std::pair{std::lround(10 * std::cos(i * M_PI / 2)), std::lround(10 * std::sin(i * M_PI / 2))};
    legs.push_back({0, static_cast<std::size_t>(i) + 1, {{corner(0, 0).at}, {corner(double(x), double(y)).at}}});
  }
  const auto tour = [&](double lift_mm) {
    const std::vector<MillRun> runs = tour_strokes(legs, 5, {.lift_nm = lift_mm * nanometres_per_mm});
    return std::pair{runs.size(), std::lround(lengths_of({.runs = runs}, {}).milled_nm / nanometres_per_mm)};
  };
  EXPECT_EQ(tour(21), (std::pair{std::size_t{1}, 60L}));
  EXPECT_EQ(tour(19), (std::pair{std::size_t{2}, 40L}));
}

TEST(VCarve, descends_along_the_way_no_faster_than_it_plunges) {
  const Region area = enclosed_by({test::box(0, 0, 10, 4)});
  const Carved result = carved(area, {.angle_degrees = 30, .widest = to_nanometres(Mm(10))});
  const std::string program =
      write_mill_program(result.plan.mill, {.feed = {300'000'000}, .plunge_feed = {70'000'000}});
  double at[3] = {0, 0, 0};
  double feed = 0;
  int descents = 0;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("F")) feed = std::stod(line.substr(1));
    if (!line.starts_with("G1 ") && !line.starts_with("G0 ")) continue;
    double to[3] = {at[0], at[1], at[2]};
    std::istringstream words(line.substr(2));
    for (std::string word; words >> word;) {
      const double value = std::stod(word.substr(1));
      if (word[0] == 'F') feed = value;
      if (word[0] >= 'X') to[word[0] - 'X'] = value;
    }
    const double length = std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]);
    const double down = feed * (at[2] - to[2]) / length;
    std::ranges::copy(to, at);
    if (line.starts_with("G0") || length == 0) continue;
    EXPECT_LE(down, 70.1) << line;
    EXPECT_TRUE(down > 68 || feed == 300 || down <= 0) << line;
    descents += down > 68 ? 1 : 0;
  }
  EXPECT_GT(descents, 2);
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
