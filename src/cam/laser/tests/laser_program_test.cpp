// Cuts along drawings, and the test grid, read by beam_reader.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "beam_reader.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/laser/laser_grid.hpp"
#include "passo/laser/laser_lines.hpp"
#include "passo/laser/laser_raster.hpp"

namespace passo {
namespace {

using test::BeamMove;
using test::BeamProgram;

using Path = std::vector<PathPoint>;

DrawnPoint at_mm(double x, double y) {
  return {{std::llround(x * 1e6)}, {std::llround(y * 1e6)}};
}

// A polygon about a centre.
Path polygon(double x, double y, double radius, int corners, double turn) {
  Path path;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    path.push_back({at_mm(x + radius * std::cos(angle), y + radius * std::sin(angle)), 0});
  }
  return path;
}

BeamProgram burned(const EdgeLoops& loops, const LaserLinesOptions& options, const LaserPasses& passes,
                   LaserProgramOptions program_options = {}, LaserLines* plan = nullptr) {
  Diagnostics findings;
  LaserProgram program(std::move(program_options));
  const LaserLines lines = plan_laser_lines(loops, options, findings);
  EXPECT_TRUE(findings.all().empty()) << findings.all().front().message;
  burn_lines(program, lines, passes);
  if (plan != nullptr) *plan = lines;
  return test::read_beam(program.finish());
}

double to_segment(double x, double y, const PathPoint& a, const PathPoint& b) {
  const double ax = to_mm(a.at.x).value();
  const double ay = to_mm(a.at.y).value();
  const double dx = to_mm(b.at.x).value() - ax;
  const double dy = to_mm(b.at.y).value() - ay;
  const double share = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - ax - share * dx, y - ay - share * dy);
}

double to_contour(double x, double y, const Path& path) {
  double nearest = 1e9;
  for (std::size_t i = 0; i < path.size(); ++i) {
    nearest = std::min(nearest, to_segment(x, y, path[i], path[(i + 1) % path.size()]));
  }
  return nearest;
}

bool is_inside(double x, double y, const Path& path) {
  bool inside = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double ax = to_mm(path[i].at.x).value();
    const double ay = to_mm(path[i].at.y).value();
    const double bx = to_mm(path[(i + 1) % path.size()].at.x).value();
    const double by = to_mm(path[(i + 1) % path.size()].at.y).value();
    if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

// Points on a burned move, also on an arc.
std::vector<std::pair<double, double>> points_on(const BeamMove& move) {
  std::vector<std::pair<double, double>> points;
  constexpr int count = 16;
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    if (move.motion == 1) {
      points.emplace_back(move.x0 + share * (move.x - move.x0), move.y0 + share * (move.y - move.y0));
      continue;
    }
    const double cx = move.x0 + move.i;
    const double cy = move.y0 + move.j;
    const double start = std::atan2(-move.j, -move.i);
    double sweep = std::atan2(move.y - cy, move.x - cx) - start;
    if (move.motion == 3 && sweep <= 0) sweep += 2 * std::numbers::pi;
    if (move.motion == 2 && sweep >= 0) sweep -= 2 * std::numbers::pi;
    const double radius = std::hypot(move.i, move.j);
    points.emplace_back(cx + radius * std::cos(start + share * sweep), cy + radius * std::sin(start + share * sweep));
  }
  return points;
}

TEST(LaserLines, burn_half_a_kerf_outside_parts_and_inside_openings) {
  const std::uint64_t seed = test::seed();
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    std::mt19937_64 random(seed + trial);
    const auto draw = [&](double least, double most) {
      return least + (most - least) * static_cast<double>(random() % 10'001) / 10'000;
    };
    const Path part = polygon(40, 30, draw(12, 25), 3 + static_cast<int>(random() % 6), draw(0, 6));
    const Path opening = polygon(40, 30, draw(2, 4), 3 + static_cast<int>(random() % 6), draw(0, 6));
    const double kerf = draw(0.05, 0.6);
    EdgeLoops loops;
    loops.loops = {part, opening};
    loops.open = {{{at_mm(0, 0), 0}, {at_mm(10, 5), 0}}};
    LaserLines plan;
    const BeamProgram program = burned(loops, {.kerf = {std::llround(kerf * 1e6)}}, {.beam = {500}}, {}, &plan);
    ASSERT_TRUE(program.faults.empty()) << program.faults.front();
    EXPECT_EQ(plan.closed, 2U);
    EXPECT_EQ(plan.open, 1U);
    bool is_first = true;
    bool has_cut_part = false;
    double around_part = 0;
    for (const BeamMove& move : program.moves) {
      if (move.s == 0) continue;
      if (std::exchange(is_first, false)) {
        EXPECT_LT(to_segment(move.x, move.y, loops.open[0][0], loops.open[0][1]), 1e-4) << "the open line comes first";
        continue;
      }
      for (const auto& [x, y] : points_on(move)) {
        const double to_part = to_contour(x, y, part);
        const double to_opening = to_contour(x, y, opening);
        ASSERT_NEAR(std::min(to_part, to_opening), kerf / 2, 0.004) << "trial " << trial;
        const bool is_beside_part = to_part < to_opening;
        ASSERT_EQ(is_inside(x, y, is_beside_part ? part : opening), !is_beside_part) << "on the wrong side";
        ASSERT_TRUE(is_beside_part || !has_cut_part) << "the opening is cut when the part is loose";
        has_cut_part |= is_beside_part;
      }
      if (has_cut_part) around_part += std::hypot(move.x - move.x0, move.y - move.y0);
    }
    double perimeter = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      perimeter += distance_nm(part[i].at, part[(i + 1) % part.size()].at) / 1e6;
    }
    EXPECT_GT(around_part, perimeter) << "not cut all around";
    EXPECT_LT(around_part, perimeter + 4 * kerf);
  }
}

TEST(LaserLines, burn_each_line_once_in_each_pass) {
  EdgeLoops loops;
  loops.loops = {polygon(20, 20, 10, 4, 0.3), polygon(20, 20, 3, 5, 0)};
  loops.open = {{{at_mm(0, 0), 0.5}, {at_mm(10, 0), 0}, {at_mm(10, 7), 0}}};
  const double circle = 2 * std::atan(0.5) * 2 * 10 / 2 / std::sin(2 * std::atan(0.5));  // length of the arc
  const double length =
      circle + 7 + 4 * 2 * 10 * std::sin(std::numbers::pi / 4) + 5 * 2 * 3 * std::sin(std::numbers::pi / 5);
  for (const std::uint32_t passes : {1U, 2U, 5U}) {
    const BeamProgram program = burned(loops, {.side = ProfileSide::on},
                                       {.beam = {300, {600'000'000}}, .passes = passes}, {.beam = BeamMode::constant});
    ASSERT_TRUE(program.faults.empty()) << program.faults.front();
    EXPECT_EQ(program.start, 3);
    double energy = 0;
    for (const BeamMove& move : program.moves) {
      const double chord = std::hypot(move.x - move.x0, move.y - move.y0);
      energy += move.s * (move.motion < 2 ? chord : circle);
      if (move.s > 0) EXPECT_EQ(move.f, 600);
    }
    EXPECT_NEAR(energy / 300, passes * length, passes * 0.01);
  }
}

TEST(LaserLines, lower_the_head_for_each_pass_with_the_beam_off) {
  EdgeLoops loops;
  loops.loops = {polygon(20, 20, 10, 4, 0.3)};
  loops.open = {{{at_mm(0, 0), 0}, {at_mm(10, 0), 0}}};
  const BeamProgram program = burned(loops, {}, {.beam = {300}, .passes = 3, .step = {500'000}, .focus = {4'000'000}},
                                     {.air = "M8", .focus = Nanometres{4'000'000}});
  EXPECT_TRUE(program.faults.empty()) << program.faults.front();
  EXPECT_EQ(program.start, 4);
  EXPECT_EQ(program.heights, (std::vector<double>{4, 3.5, 3, 4, 3.5, 3, 4}));
}

TEST(LaserLines, lead_in_from_the_scrap) {
  EdgeLoops loops;
  loops.loops = {polygon(20, 20, 10, 4, 0.3)};
  const BeamProgram program = burned(loops, {.kerf = {200'000}, .lead = {1'000'000}}, {.beam = {300}, .passes = 2});
  ASSERT_TRUE(program.faults.empty()) << program.faults.front();
  ASSERT_GT(program.moves.size(), 3U);
  const BeamMove& first = program.moves[1];
  EXPECT_GT(first.motion, 1) << "no arc leads in";
  EXPECT_NEAR(to_contour(first.x0, first.y0, loops.loops[0]), 1.1, 0.01);
  EXPECT_FALSE(is_inside(first.x0, first.y0, loops.loops[0]));
}

TEST(LaserProgram, tells_what_it_burns) {
  LaserProgram program({.name = "a(b)", .files = {"a.svg"}, .most_s = 255});
  program.travel(at_mm(10, 0));
  program.burn(at_mm(-10, 0), 1, {100, {1'200'000'000}});  // the upper half of a circle
  const std::string text = program.finish();
  const LaserTotals& totals = program.totals();
  EXPECT_NEAR(to_mm(totals.burned->most.y).value(), 10, 1e-5);
  EXPECT_NEAR(totals.burned_nm / 1e6, 10 * std::numbers::pi, 1e-3);
  // 31.4 mm at 20 mm/s and its ramps, and two rapids of 10 mm at 100 mm/s, which do not reach that.
  EXPECT_NEAR(totals.seconds, 10 * std::numbers::pi / 20 + 0.02 + 2 * 2 * std::sqrt(10.0 / 1000), 1e-3);
  EXPECT_EQ(text,
            "(a_b_, by passo cam laser)\n(from a.svg)\n(burned: X -10 to 10, Y 0 to 10 mm)\n"
            "(the head moves within X -10 to 10, Y 0 to 10 mm)\n(power: S100 of S255, M4: it follows the speed)\n"
            "(about 2 s, with rapids at 6000 mm/min and 1000 mm/s2)\n(Grbl needs $30=255 and laser mode, $32=1)\n"
            "G17 G21 G40 G80 G90 G94\nM4 S0\nG0 X10 Y0\nG3 X-10 Y0 I-10 J0 F1200 S100\nM5\nG0 X0 Y0 S0\nM2\n");
}

TEST(LaserProgram, rounds_power_to_whole_s_words) {
  EXPECT_EQ(s_of(50, 255), 128U);
  EXPECT_EQ(s_of(0, 1000), 0U);
  EXPECT_EQ(s_of(100, 1000), 1000U);
  EXPECT_EQ(s_of(120, 1000), 1000U);
}

TEST(LaserGrid, has_cells_of_the_power_and_feed_of_their_labels) {
  LaserProgram program({});
  LaserGrid grid{.columns = 4, .rows = 3, .least_percent = 10, .most_percent = 70};
  grid.least_feed = {1'000'000'000};
  grid.most_feed = {3'000'000'000};
  grid.size = {5'000'000};
  grid.line = {250'000};
  grid.label = {77, {1'500'000'000}};
  Diagnostics findings;
  burn_grid(program, grid, findings);
  ASSERT_FALSE(findings.any_error());
  const BeamProgram read = test::read_beam(program.finish());
  ASSERT_TRUE(read.faults.empty()) << read.faults.front();
  std::vector<double> lengths(12);
  double labels = 0;
  double dose = 0;
  for (const BeamMove& move : read.moves) {
    if (move.s == 0) continue;
    const double length = std::hypot(move.x - move.x0, move.y - move.y0);
    const double x = (move.x0 + move.x) / 2;
    const double y = (move.y0 + move.y) / 2;
    if (x < 0 || y < 0 || y > 21) {
      labels += length;
      EXPECT_EQ(move.s, 77);
      EXPECT_EQ(move.f, 1500);
      EXPECT_EQ(dose, 0) << "a label after a cell";
      continue;
    }
    const auto column = static_cast<std::size_t>(x / 8);
    const auto row = static_cast<std::size_t>(y / 8);
    ASSERT_LT(column, 4U);
    ASSERT_LT(row, 3U);
    lengths[row * 4 + column] += length;
    EXPECT_EQ(move.s, 100 + 200 * static_cast<double>(column));
    EXPECT_EQ(move.f, 3000 - 1000 * static_cast<double>(row));
    EXPECT_GE(move.s / move.f, dose) << "a cell with less energy comes later";
    dose = move.s / move.f;
  }
  for (const double length : lengths) EXPECT_NEAR(length, 20 * 5, 1e-6);
  EXPECT_GT(labels, 50);
}

}  // namespace
}  // namespace passo
