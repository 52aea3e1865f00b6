// Programs of reliefs, read again move by move: no move cuts into the surface, no rapid into the stock.
#include "passo/carve/relief_program.hpp"

#include <map>
#include <random>
#include <string>

#include "carved_moves.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

TEST(ReliefProgram, never_cuts_into_a_random_surface) {
  std::mt19937_64 random(seed());
  const FinishStrategy ways[] = {FinishStrategy::contours, FinishStrategy::rows, FinishStrategy::columns,
                                 FinishStrategy::both, FinishStrategy::spiral};
  std::size_t i = 0;
  for (const OracleCutter& cutter : oracle_cutters()) {
    const HeightGrid grid = random_surface(random, 40, 30, Mm(0.2), Mm(0.25));
    ReliefProgramOptions options = options_of(cutter.text);
    options.way = ways[i % 5];
    options.ramps = i % 2 == 0;
    ++i;
    expect_no_gouge(grid, written(grid, options).text, {cutter}, 3);
  }
}

TEST(ReliefProgram, with_three_tools_never_cuts_into_the_surface) {
  const HeightGrid grid = hills(45, 40, 0.2);
  const Written program = written(grid, three_tools());
  EXPECT_THAT(program.text, HasSubstr("T3 M6"));
  expect_no_gouge(grid, program.text, {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")}, 4);
  ASSERT_EQ(program.report.parts.size(), 3U);
  for (const ReliefPart& part : program.report.parts) EXPECT_GT(part.moves, 10U) << part.what;
}

TEST(ReliefProgram, has_no_rapid_through_the_stock_and_leaves_little) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);  // its valleys are wider than the smallest tip
  const Written program = written(grid, three_tools(), true);
  const std::vector<OracleCutter> tools = {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")};
  OracleStock stock(6, 5);
  double deepest = 0;
  for (const ReadMove& move : moves_of(program.text)) {
    const OracleCutter& cutter = tools[move.tool - 1];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(length / 0.15));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      if (move.tool == 1) {
        // Where it goes from row to row, its rim may meet slivers that the rows have left.
        deepest = std::max(deepest, stock.depth_of(cutter, at(0), at(1), at(2), 0.7));
      }
      if (move.is_rapid) {
        ASSERT_LE(stock.depth_of(cutter, at(0), at(1), at(2)), 1e-3)
            << at(0) << ", " << at(1) << ", " << at(2) << " tool " << move.tool;
      } else {
        stock.cut(cutter, at(0), at(1), at(2));
      }
    }
  }
  EXPECT_LE(deepest, 1.05) << "the roughing cutter goes no deeper than a level";
  // On the nodes, those of edges and corners included. The step at X5 is a cell wide.
  for (double y = 0; y <= 5; y += 0.1) {
    for (double x = 0; x <= 6; x += 0.1) {
      if (std::abs(x - 5) < 0.7) continue;
      const double left = stock.at(x + 1e-9, y + 1e-9) - surface_at(grid, x, y);
      EXPECT_GE(left, -0.02) << x << ", " << y;
      EXPECT_LE(left, 0.2) << x << ", " << y;
      // The view that the program draws of it is the same.
      const auto node = static_cast<std::size_t>(std::lround(y / 0.1)) * grid.columns +
                        static_cast<std::size_t>(std::lround(x / 0.1));
      EXPECT_NEAR(program.report.carved.heights[node], stock.at(x + 1e-9, y + 1e-9), 0.05) << x << ", " << y;
    }
  }
}

TEST(ReliefProgram, has_few_lines_within_the_tolerance) {
  HeightGrid grid{.columns = 401, .rows = 41, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  for (int i = 0; i < 401 * 41; ++i) grid.heights.push_back(grid_height(Mm(-2 + std::sin((i % 401) * 0.02))));
  ReliefProgramOptions options = options_of("ball:3");
  options.tolerance = Mm(0.0);
  const std::uint64_t exact = written(grid, options).report.parts[0].moves;
  options.tolerance = Mm(0.01);
  const std::uint64_t few = written(grid, options).report.parts[0].moves;
  EXPECT_LT(few * 4, exact);
  HeightGrid flat = grid;
  flat.heights.assign(flat.heights.size(), -1.0F);
  const Written lines = written(flat, options);
  EXPECT_LT(lines.report.parts[0].moves, 40U) << "a row of a flat is one line";
}

TEST(ReliefProgram, goes_down_no_faster_than_the_plunge_feed) {
  const HeightGrid grid = hills(60, 40, 0.2);
  ReliefProgramOptions options = options_of("ball:3");
  options.finish.feed = Mm(1500);
  options.finish.plunge = Mm(200);
  std::size_t slow = 0;
  double feed = 0;
  double at[3] = {0, 0, 5};
  const std::string text = written(grid, options).text;
  for (std::size_t begin = text.find("\nG1 ") + 1; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    double to[3] = {at[0], at[1], at[2]};
    for (std::size_t i = begin; i < end; ++i) {
      if (text[i] == 'F') feed = std::stod(text.substr(i + 1));
      if (text[i] >= 'X' && text[i] <= 'Z') to[text[i] - 'X'] = std::stod(text.substr(i + 1));
    }
    if (text[begin] == 'G' && text[begin + 1] == '0') break;
    const double length = std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]);
    if (length > 0) {
      EXPECT_LE((at[2] - to[2]) / length * feed, 200.001) << text.substr(begin, end - begin);
    }
    if (feed < 1500) ++slow;
    std::copy_n(to, 3, at);
    begin = end + 1;
  }
  EXPECT_GT(slow, 20U);
}

TEST(ReliefProgram, is_the_same_for_any_number_of_threads) {
  const HeightGrid grid = hills(80, 70, 0.1);
  ReliefProgramOptions options = three_tools();
  const std::string one = written(grid, options).text;
  options.threads = 5;
  EXPECT_EQ(written(grid, options).text, one);
}

// A frame at the top stays even: beside the surface no cutter goes below its edge.
TEST(ReliefProgram, goes_on_level_beside_the_surface_unless_that_is_a_body) {
  HeightGrid grid{.columns = 41, .rows = 31, .pitch_x = Mm(0.2), .pitch_y = Mm(0.2)};
  for (int i = 0; i < 41 * 31; ++i) {
    const bool is_frame = i % 41 < 6 || i % 41 > 34 || i / 41 < 6 || i / 41 > 24;
    grid.heights.push_back(is_frame ? 0.0F : -3.0F);
  }
  const auto lowest_beside = [&](const std::string& program) {
    double lowest = 100;
    for (const ReadMove& move : moves_of(program)) {
      const bool is_beside = move.to[0] < 0 || move.to[0] > 8 || move.to[1] < 0 || move.to[1] > 6;
      if (is_beside) lowest = std::min(lowest, move.to[2]);
    }
    return lowest;
  };
  for (const FinishStrategy way : {FinishStrategy::both, FinishStrategy::spiral}) {
    ReliefProgramOptions options = three_tools();
    options.way = way;
    EXPECT_GE(lowest_beside(written(grid, options).text), -1e-3);
    options.beside = BesideGrid::nothing;
    EXPECT_NEAR(lowest_beside(written(grid, options).text), -3, 1e-3) << "the sides of a body are cut";
  }
}

TEST(ReliefProgram, is_placed_by_its_origin_and_cuts_its_edges) {
  const HeightGrid grid = hills(11, 21, 0.5);
  for (const FinishStrategy way : {FinishStrategy::rows, FinishStrategy::columns, FinishStrategy::spiral}) {
    ReliefProgramOptions options = options_of("ball:3");
    options.way = way;
    options.x0 = Mm(-2.5);
    options.y0 = Mm(100);
    double low[2] = {1e9, 1e9};
    double high[2] = {-1e9, -1e9};
    for (const ReadMove& move : moves_of(written(grid, options).text)) {
      for (int axis = 0; axis < 2 && !move.is_rapid; ++axis) {
        low[axis] = std::min(low[axis], move.to[axis]);
        high[axis] = std::max(high[axis], move.to[axis]);
      }
    }
    EXPECT_DOUBLE_EQ(low[0], -4);
    EXPECT_DOUBLE_EQ(high[0], 4);
    EXPECT_DOUBLE_EQ(low[1], 98.5);
    EXPECT_DOUBLE_EQ(high[1], 111.5);
  }
}

}  // namespace
}  // namespace passo
