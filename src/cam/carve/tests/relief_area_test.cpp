// The area and the rows in which a relief is cut: below the top, within curves, in one direction, at an angle, closer
// on slopes.
#include <algorithm>
#include <cmath>
#include <random>

#include "carved_moves.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

using namespace test;

double feeds_of(const std::string& program) {
  double way = 0;
  for (const ReadMove& move : moves_of(program)) {
    if (!move.is_rapid) way += std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1]);
  }
  return way;
}

// Cuts a program out of its stock. Expects no rapid through stock.
OracleStock cut_out(const std::string& program, const OracleCutter& cutter, double width, double length, double fine) {
  OracleStock stock(width, length, fine);
  for (const ReadMove& move : moves_of(program)) {
    const double way = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(way / (fine * 2)));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      if (move.is_rapid) {
        EXPECT_LE(stock.depth_of(cutter, at(0), at(1), at(2), 0.99), 0.01) << "a rapid, line " << move.line;
      } else {
        stock.cut(cutter, at(0), at(1), at(2));
      }
    }
  }
  return stock;
}

// A pit of 4 x 5 mm in a plate of 40 x 8 mm.
HeightGrid plate_with_a_pit() {
  HeightGrid grid{.columns = 201, .rows = 41, .pitch_x = Mm(0.2), .pitch_y = Mm(0.2)};
  for (int i = 0; i < 201 * 41; ++i) {
    const double x = (i % 201) * 0.2;
    const double y = (i / 201) * 0.2;
    const bool is_pit = x > 30 && x < 34 && y > 2 && y < 7;
    grid.heights.push_back(is_pit ? -1.0F : 0.0F);
  }
  return grid;
}

TEST(ReliefArea, at_the_top_of_the_stock_is_not_cut) {
  const HeightGrid grid = plate_with_a_pit();
  for (const FinishStrategy way : {FinishStrategy::rows, FinishStrategy::columns, FinishStrategy::both,
                                   FinishStrategy::spiral, FinishStrategy::contours}) {
    ReliefProgramOptions options = options_of("flat:2.3");
    options.way = way;
    const Written program = written(grid, options, true);
    // All rows of the pit, in both directions, and some travel for the entry: not the 450 mm of the plate.
    EXPECT_LT(feeds_of(program.text), 200) << static_cast<int>(way);
    EXPECT_GT(feeds_of(program.text), 5);
    expect_no_gouge(grid, program.text, {oracle_of("flat:2.3")}, 3, 50);
    const auto at = [&](std::size_t column, std::size_t row) {
      return program.report.carved.heights[row * grid.columns + column];
    };
    EXPECT_NEAR(at(160, 17), -1, 0.03) << "in the pit";
    EXPECT_EQ(at(20, 20), 0);
  }
}

TEST(ReliefArea, without_anything_below_the_top_has_no_move) {
  HeightGrid grid = plate_with_a_pit();
  grid.heights.assign(grid.heights.size(), 0.0F);
  EXPECT_EQ(written(grid, options_of("ball:3")).report.parts[0].moves, 0U);
}

TEST(ReliefArea, within_a_curve_keeps_the_tip_inside) {
  const HeightGrid grid = hills(61, 51, 0.1);
  // A square with a hole, in program coordinates.
  const auto square = [](double low, double high) {
    return std::vector<ReliefPoint>{{Mm(low), Mm(low)}, {Mm(high), Mm(low)}, {Mm(high), Mm(high)}, {Mm(low), Mm(high)}};
  };
  for (const FinishStrategy way :
       {FinishStrategy::rows, FinishStrategy::columns, FinishStrategy::both, FinishStrategy::contours}) {
    ReliefProgramOptions options = three_tools();
    options.way = way;
    options.x0 = Mm(10);
    options.y0 = Mm(10);
    options.area.within = {square(10.55, 14.45), square(12.05, 12.95)};
    // The same at an angle.
    if (way == FinishStrategy::both) {
      options.way = FinishStrategy::rows;
      options.rows.angle = {0.4};
    }
    const Written program = written(grid, options);
    std::size_t low = 0;
    for (const ReadMove& move : moves_of(program.text)) {
      if (move.is_rapid || move.to[2] > -0.05) continue;
      ++low;
      const double x = move.to[0] - 12.5;
      const double y = move.to[1] - 12.5;
      // Roughing and contours may leave the area by one point of the path before the cutter is lifted.
      EXPECT_LE(std::max(std::abs(x), std::abs(y)), 1.95 + 0.11) << program.text.substr(0, 40) << move.line;
      EXPECT_GE(std::max(std::abs(x), std::abs(y)), 0.45 - 0.11) << move.line;
    }
    EXPECT_GT(low, 50U) << static_cast<int>(way);
  }
}

// One-way, at any angle, on the model only, with slopes: no gouges, and no rapids through stock.
TEST(ReliefArea, rows_of_all_kinds_never_cut_into_a_random_surface) {
  std::mt19937_64 random(seed());
  std::size_t i = 0;
  for (const OracleCutter& cutter : oracle_cutters()) {
    const HeightGrid grid = random_surface(random, 30, 24, Mm(0.2), Mm(0.25));
    ReliefProgramOptions options = options_of(cutter.text);
    const double angles[] = {0.3, 0, 2.2, -0.7, 1.5708, 0};
    options.rows.angle = {angles[i % 6]};
    options.rows.direction = i % 3 == 0   ? RowDirection::there_and_back
                             : i % 3 == 1 ? RowDirection::climb
                                          : RowDirection::conventional;
    options.rows.has_even_scallops = options.rows.angle.value == 0;
    options.ramps = i % 2 == 0;
    ++i;
    expect_no_gouge(grid, written(grid, options).text, {cutter}, 5);
  }
}

TEST(ReliefArea, rows_at_an_angle_go_that_way_and_leave_as_little) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);
  ReliefProgramOptions options = options_of("ball:3");
  options.rows.angle = {0.5};
  const Written program = written(grid, options, true);
  const OracleStock stock = cut_out(program.text, oracle_of("ball:3"), 6, 5, 0.1);
  options.rows.angle = {0};
  const OracleStock by_rows = cut_out(written(grid, options).text, oracle_of("ball:3"), 6, 5, 0.1);
  double along = 0;
  double across = 0;
  for (const ReadMove& move : moves_of(program.text)) {
    if (move.is_rapid) continue;
    const double x = move.to[0] - move.from[0];
    const double y = move.to[1] - move.from[1];
    along += std::abs(x * std::cos(0.5) + y * std::sin(0.5));
    across += std::abs(y * std::cos(0.5) - x * std::sin(0.5));
  }
  EXPECT_GT(along, 6 * across);
  for (double y = 0.1; y <= 4.9; y += 0.1) {
    for (double x = 0.1; x <= 5.9; x += 0.1) {
      if (std::abs(x - 5) < 0.9) continue;  // the step
      EXPECT_LE(stock.at(x + 1e-9, y + 1e-9), by_rows.at(x + 1e-9, y + 1e-9) + 0.2) << x << ", " << y;
    }
  }
}

TEST(ReliefArea, rows_in_one_direction_have_the_stock_on_one_side) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);
  for (const FinishStrategy way : {FinishStrategy::rows, FinishStrategy::columns}) {
    for (const RowDirection direction : {RowDirection::climb, RowDirection::conventional}) {
      ReliefProgramOptions options = options_of("ball:3");
      options.way = way;
      options.rows.direction = direction;
      options.ramps = false;
      const Written program = written(grid, options);
      // Rows follow each other towards higher Y, columns towards higher X, so the stock is on that side.
      const int axis = way == FinishStrategy::rows ? 0 : 1;
      const double wanted = (direction == RowDirection::climb ? -1 : 1) * (way == FinishStrategy::rows ? 1 : -1);
      double forth = 0;
      double back = 0;
      for (const ReadMove& move : moves_of(program.text)) {
        if (move.is_rapid) continue;
        const double way_along = (move.to[axis] - move.from[axis]) * wanted;
        (way_along > 0 ? forth : back) += std::abs(way_along);
      }
      EXPECT_GT(forth, 50);
      EXPECT_LT(back, 0.01 * forth);
      cut_out(program.text, oracle_of("ball:3"), 6, 5, 0.1);
    }
  }
}

// A scallop on a slope of 60 degrees across the rows is four times as high, unless rows are added there.
TEST(ReliefArea, even_scallops_are_even_on_slopes) {
  HeightGrid grid{.columns = 11, .rows = 161, .pitch_x = Mm(0.05), .pitch_y = Mm(0.05)};
  for (int i = 0; i < 11 * 161; ++i) {
    const double y = (i / 11) * 0.05;
    grid.heights.push_back(grid_height(Mm(y < 3   ? -1
                                          : y < 5 ? -1 - (y - 3) * std::tan(M_PI / 3)
                                                  : -1 - 2 * std::tan(M_PI / 3))));
  }
  ReliefProgramOptions options = options_of("ball:3");
  options.scallop = Mm(0.03);
  options.finish.step_over = Mm(0);
  options.tolerance = Mm(0.001);
  options.overrun = Mm(0.2);
  options.ramps = false;
  const auto highest_ridge = [&](double low, double high) {
    const Written program = written(grid, options);
    const OracleStock stock = cut_out(program.text, oracle_of("ball:3"), 0.5, 8, 0.05);
    double most = 0;
    for (double y = low; y <= high; y += 0.05) {
      const double slope = y > 3 && y < 5 ? std::tan(M_PI / 3) : 0;
      const double above = stock.at(0.25 + 1e-9, y + 1e-9) - surface_at(grid, 0.25, std::round(y / 0.05) * 0.05);
      most = std::max(most, above / std::sqrt(1 + slope * slope));
    }
    return most;
  };
  const double uneven = highest_ridge(3.6, 4.2);
  EXPECT_GT(uneven, 0.07);
  const double fewer = feeds_of(written(grid, options).text);
  options.rows.has_even_scallops = true;
  EXPECT_LT(highest_ridge(3.6, 4.2), 0.05);
  EXPECT_LT(highest_ridge(0.5, 2.0), 0.04);
  EXPECT_LT(feeds_of(written(grid, options).text), 2.5 * fewer) << "rows are added only where it is steep";
}

// Contours without roughing leave slivers between them and at the edge of their reach; no rapid may go through these.
TEST(ReliefArea, contours_have_no_rapid_through_a_sliver) {
  std::mt19937_64 random(seed());
  std::uniform_real_distribution<double> share(0, 1);
  for (const char* text : {"ball:3", "flat:2.3"}) {
    HeightGrid grid{.columns = 51, .rows = 41, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
    std::vector<double> bumps;
    for (int i = 0; i < 17 * 13; ++i) bumps.push_back(share(random));
    for (int i = 0; i < 51 * 41; ++i) {
      const double x = (i % 51) * 0.1;
      const double y = (i / 51) * 0.1;
      const auto column = static_cast<std::size_t>(x / 0.5);
      const auto row = static_cast<std::size_t>(y / 0.5);
      const double u = x / 0.5 - static_cast<double>(column);
      const double v = y / 0.5 - static_cast<double>(row);
      const auto bump = [&](std::size_t i, std::size_t j) {
        return bumps[std::min<std::size_t>(j, 12) * 17 + std::min<std::size_t>(i, 16)];
      };
      const double height = (bump(column, row) * (1 - u) + bump(column + 1, row) * u) * (1 - v) +
                            (bump(column, row + 1) * (1 - u) + bump(column + 1, row + 1) * u) * v;
      grid.heights.push_back(grid_height(Mm(-4 + 2 * std::sin(x * 1.1) * std::cos(y) + 1.2 * height)));
    }
    ReliefProgramOptions options = options_of(text);
    options.way = FinishStrategy::contours;
    cut_out(written(grid, options).text, oracle_of(text), 5, 4, 0.06);
  }
}

LevelPicture ramp_picture() {
  LevelPicture picture{.columns = 101, .rows = 11};
  for (int i = 0; i < 101 * 11; ++i) picture.levels.push_back(static_cast<std::uint16_t>((i % 101) / 4 * 4 * 655));
  return picture;
}

TEST(ReliefArea, of_a_picture_is_smoothed_cut_off_and_without_background) {
  Diagnostics diagnostics;
  const ReliefShape plain{.width = Mm(10), .depth = Mm(4)};
  const HeightGrid steps = relief_of(ramp_picture(), plain, "it", diagnostics);
  ReliefShape shape = plain;
  shape.smooth = Mm(0.4);
  const HeightGrid smooth = relief_of(ramp_picture(), shape, "it", diagnostics);
  float largest = 0;
  for (std::size_t x = 20; x < 80; ++x) {
    largest = std::max(largest, smooth.at(x + 1, 5) - smooth.at(x, 5));
    EXPECT_NEAR(smooth.at(x, 5), steps.at(x, 5), 0.1);
  }
  EXPECT_LT(largest, 0.08) << "a step of 0.16 mm is gone";
  shape = plain;
  shape.background = 0.3;
  const HeightGrid figure = relief_of(ramp_picture(), shape, "it", diagnostics);
  for (std::size_t x = 0; x <= 100; ++x) {
    EXPECT_EQ(figure.at(x, 5), steps.at(x, 5) < -2.8F ? 0.0F : steps.at(x, 5)) << x;
  }
  shape = plain;
  shape.lowest = Mm(1.5);
  const HeightGrid flat = relief_of(ramp_picture(), shape, "it", diagnostics);
  for (std::size_t x = 0; x <= 100; ++x) EXPECT_EQ(flat.at(x, 5), std::max(-1.5F, steps.at(x, 5))) << x;
  EXPECT_FALSE(diagnostics.any_error());
}

}  // namespace
}  // namespace passo
