// Contours, offsets, arcs and held removal of reliefs' programs, read again move by move.
#include <map>
#include <random>
#include <set>

#include "carved_moves.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using namespace test;
using testing::HasSubstr;

ReliefProgramOptions new_ways(bool has_arcs) {
  ReliefProgramOptions options = three_tools();
  options.way = FinishStrategy::contours;
  options.roughing->way = RoughStrategy::offsets;
  options.arcs = has_arcs;
  return options;
}

TEST(ReliefWays, of_contours_and_offsets_never_cut_into_a_random_surface) {
  std::mt19937_64 random(seed());
  std::size_t i = 0;
  for (const OracleCutter& cutter : oracle_cutters()) {
    const HeightGrid grid = random_surface(random, 26, 22, Mm(0.2), Mm(0.25));
    ReliefProgramOptions options = options_of(cutter.text);
    options.way = FinishStrategy::contours;
    options.roughing = ReliefRoughing{.tool = {.cutter = options.finish.cutter, .step_over = Mm(0.9)},
                                      .way = RoughStrategy::offsets,
                                      .step_down = Mm(1.5),
                                      .stock = Mm(0.1)};
    options.ramps = i++ % 3 != 2;
    expect_no_gouge(grid, written(grid, options).text, {cutter, cutter}, 13);
  }
}

TEST(ReliefWays, with_arcs_never_cut_into_a_smooth_surface) {
  const HeightGrid grid = hills(61, 51, 0.1);
  const Written program = written(grid, new_ways(true));
  for (const ReliefPart& part : program.report.parts) EXPECT_GT(part.arcs, 5U) << part.what;
  EXPECT_THAT(program.text, HasSubstr("G17 G"));
  EXPECT_THAT(program.text, HasSubstr("G18 G"));
  expect_no_gouge(grid, program.text, {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")}, 17);
}

// What a program does to the stock: each tool's deepest cut, and what is left.
struct Cutting {
  OracleStock stock{6, 5};
  double deepest[3] = {0, 0, 0};
};
Cutting cut_by(const std::string& program, const std::vector<OracleCutter>& tools) {
  Cutting cutting;
  for (const ReadMove& move : moves_of(program)) {
    const std::size_t tool = move.tool == 0 ? 0 : move.tool - 1;
    const OracleCutter& cutter = tools[tool];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(length / 0.15));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      const double depth = cutting.stock.depth_of(cutter, at(0), at(1), at(2), 0.7);
      if (move.is_rapid) {
        EXPECT_LE(cutting.stock.depth_of(cutter, at(0), at(1), at(2)), 1e-3) << "a rapid, line " << move.line;
      } else {
        cutting.deepest[tool] = std::max(cutting.deepest[tool], depth);
        cutting.stock.cut(cutter, at(0), at(1), at(2));
      }
    }
  }
  return cutting;
}

TEST(ReliefWays, of_contours_and_offsets_leave_little_and_go_down_by_levels) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);
  const ReliefProgramOptions options = new_ways(true);
  const Written program = written(grid, options, true);
  const Cutting cutting = cut_by(program.text, {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")});
  EXPECT_LE(cutting.deepest[0], 1.05) << "the roughing cutter goes no deeper than a level";
  EXPECT_LE(cutting.deepest[1], 1.3) << "the finishing cutter finds what roughing leaves";
  for (double y = 0; y <= 5; y += 0.1) {
    for (double x = 0; x <= 6; x += 0.1) {
      if (std::abs(x - 5) < 0.7) continue;
      const double left = cutting.stock.at(x + 1e-9, y + 1e-9) - surface_at(grid, x, y);
      EXPECT_GE(left, -0.02) << x << ", " << y;
      EXPECT_LE(left, 0.25) << x << ", " << y;
    }
  }
}

// A cone, and a wall around it: contours are circles, and each circle a few arcs.
TEST(ReliefWays, make_circles_of_a_cone) {
  HeightGrid grid{.columns = 101, .rows = 101, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  for (int i = 0; i < 101 * 101; ++i) {
    const double away = std::hypot((i % 101) * 0.1 - 5, (i / 101) * 0.1 - 5);
    grid.heights.push_back(grid_height(Mm(std::max(-6.0, -1.6 * away))));
  }
  ReliefProgramOptions options = options_of("ball:3");
  options.way = FinishStrategy::contours;
  const ReliefPart arcs = written(grid, options).report.parts[0];
  options.arcs = false;
  const ReliefPart lines = written(grid, options).report.parts[0];
  EXPECT_EQ(lines.arcs, 0U);
  EXPECT_GT(arcs.arcs, 30U);
  EXPECT_LT(arcs.moves * 2, lines.moves);
}

// Upright arcs: a row over cylinders is few of them.
TEST(ReliefWays, make_upright_arcs_of_rows_over_cylinders) {
  HeightGrid grid{.columns = 201, .rows = 21, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  for (int i = 0; i < 201 * 21; ++i) {
    const double x = (i % 201) * 0.1;
    const double out = std::fmod(x, 10) - 5;
    const double up = std::sqrt(64 - out * out);
    grid.heights.push_back(grid_height(Mm(x < 10 ? up - 8 : 4.49 - up)));
  }
  ReliefProgramOptions options = options_of("ball:3");
  options.tolerance = Mm(0.01);
  options.finish.plunge = options.finish.feed;  // else an arc that goes down is slower than its lines
  for (const FinishStrategy way : {FinishStrategy::rows, FinishStrategy::columns}) {
    const HeightGrid& surface = way == FinishStrategy::rows ? grid : grid.transposed();
    options.way = way;
    options.arcs = true;
    const Written program = written(surface, options);
    EXPECT_THAT(program.text, HasSubstr(way == FinishStrategy::rows ? "G18 G" : "G19 G"));
    expect_no_gouge(surface, program.text, {oracle_of("ball:3")}, 17);
    options.arcs = false;
    EXPECT_LT(program.report.parts[0].moves * 2, written(surface, options).report.parts[0].moves);
  }
}

TEST(ReliefWays, are_made_of_four_nodes_far_apart) {
  HeightGrid grid{.columns = 2, .rows = 2, .pitch_x = Mm(20), .pitch_y = Mm(20), .heights = {-3, 0, -1, -2}};
  EXPECT_GT(written(grid, new_ways(true)).report.parts[1].moves, 1U);
}

TEST(ReliefWays, hold_what_is_taken_off_a_minute) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);
  ReliefProgramOptions options = options_of("flat:2.3");
  options.finish.step_over = Mm(1);
  options.arcs = false;
  options.finish.feed = Mm(1000);
  options.finish.plunge = Mm(1000);
  const OracleCutter& cutter = oracle_of("flat:2.3");
  // The greatest volume a minute over a way of the cutter's radius, and the time.
  const auto most_of = [&](const std::string& program) {
    OracleStock stock(6, 5);
    double most = 0;
    double way = 0;
    double volume = 0;
    double minutes = 0;
    for (const ReadMove& move : moves_of(program)) {
      if (move.is_rapid) continue;
      const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
      const int parts = std::max(1, static_cast<int>(length / 0.1));
      for (int i = 1; i <= parts; ++i) {
        const double share = static_cast<double>(i) / parts;
        const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
        volume += stock.cut(cutter, at(0), at(1), at(2));
        way += length / parts;
        minutes += length / parts / move.feed;
        if (way < cutter.radius) continue;
        most = std::max(most, volume / minutes);
        way = volume = minutes = 0;
      }
    }
    return most;
  };
  const Written free = written(grid, options);
  options.finish.removal = 1500;
  const Written held = written(grid, options);
  EXPECT_GT(most_of(free.text), 3000);
  EXPECT_LT(most_of(held.text), 1500 * 1.25);
  EXPECT_LE(held.report.parts[0].removal, 1500.1);
  EXPECT_GT(held.report.parts[0].removal, 1000);
  options.finish.fastest = Mm(3000);
  const Written faster = written(grid, options);
  EXPECT_LT(faster.report.parts[0].minutes, held.report.parts[0].minutes);
  EXPECT_LT(most_of(faster.text), 1500 * 1.25);
}

}  // namespace
}  // namespace passo
