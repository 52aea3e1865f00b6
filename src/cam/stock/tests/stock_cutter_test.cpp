#include "passo/stock/stock_cutter.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "cut_stock.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::ball_tool;
using test::CutBlock;
using test::field_of;
using test::flat_tool;
using test::point_at;

const StockBlock plate{{0, 0, -10}, {40, 30, 0}};

TEST(StockCutter, a_slot_has_the_volume_of_a_slot) {
  CutBlock stock(plate, 0.1, {.tools = {flat_tool(6)}});
  const double before = stock.field.volume();
  stock.line(point_at(10, 15, -2), point_at(30, 15, -2));
  stock.cutter.finish();
  ASSERT_EQ(stock.cuts.size(), 1U);
  const MoveCut& cut = stock.cuts.front();
  const double expected = 2 * (20 * 6 + std::numbers::pi * 9);
  EXPECT_NEAR(cut.volume, expected, 0.003 * expected);
  EXPECT_NEAR(before - stock.field.volume(), cut.volume, 1e-3);
  EXPECT_NEAR(cut.depth, 2, 1e-6);
  EXPECT_NEAR(cut.area, expected / 2, 0.003 * expected);
  EXPECT_EQ(cut.below, 0);
  EXPECT_DOUBLE_EQ(cut.way, 20);
}

TEST(StockCutter, what_is_gone_is_not_cut_again) {
  CutBlock stock(plate, 0.1, {.tools = {ball_tool(4)}});
  for (int i = 0; i < 2; ++i) stock.line(point_at(5, 5, -1), point_at(33, 21, -4));
  stock.cutter.finish();
  EXPECT_GT(stock.cuts[0].volume, 100);
  EXPECT_EQ(stock.cuts[1].volume, 0);
  EXPECT_EQ(stock.cuts[1].depth, 0);
}

TEST(StockCutter, a_helix_cuts_as_deep_as_it_goes_and_as_wide) {
  CutBlock stock(plate, 0.1, {.tools = {flat_tool(4)}});
  const Point start = point_at(25, 15, 0);
  stock.cutter.cut(Curve::arc(start, point_at(25, 15, -3), Axis::x, Axis::y, 20, 15, 6 * std::numbers::pi), {}, {});
  stock.cutter.cut(
      Curve::arc(point_at(25, 15, -3), point_at(25, 15, -3), Axis::x, Axis::y, 20, 15, 2 * std::numbers::pi), {}, {});
  stock.cutter.finish();
  // A ring with a radius of 3 to 7 mm.
  for (std::size_t row = 0; row < stock.field.rows(); ++row) {
    for (std::size_t column = 0; column < stock.field.columns(); ++column) {
      const double r = std::hypot(stock.field.x_of(column) - 20, stock.field.y_of(row) - 15);
      if (std::abs(r - 3) < 0.02 || std::abs(r - 7) < 0.02) continue;
      EXPECT_NEAR(stock.field.height(column, row), r > 3 && r < 7 ? -3 : 0, 1e-5) << r;
    }
  }
  EXPECT_NEAR(stock.cuts[0].volume + stock.cuts[1].volume, 3 * std::numbers::pi * 40, 2);
}

TEST(StockCutter, does_not_cut_below_the_bottom_and_says_how_far_below_it_was) {
  CutBlock stock(plate, 0.2, {.tools = {flat_tool(4)}});
  stock.line(point_at(10, 15, -10.5), point_at(30, 15, -10.5));
  stock.line(point_at(-20, 15, -12), point_at(-10, 15, -12));  // beside the stock
  stock.cutter.finish();
  EXPECT_NEAR(stock.cuts[0].below, 0.5, 1e-9);
  EXPECT_NEAR(stock.cuts[0].depth, 10, 1e-6);
  EXPECT_EQ(stock.cuts[1].below, 0);
  EXPECT_NEAR(stock.field.height(100, 75), -10, 1e-6);
}

TEST(StockCutter, a_rapid_up_the_wall_that_was_just_cut_takes_nothing) {
  std::mt19937_64 random(test::seed());
  std::uniform_real_distribution<double> place(3, 27);
  CutBlock stock(plate, 0.1, {.tools = {flat_tool(6), ball_tool(3)}});
  Point here = point_at(3, 3, 5);
  for (int i = 0; i < 300; ++i) {
    const auto tool = static_cast<std::size_t>(i % 2);
    // Half of the places are the middles of cells, where whole rows of cells are exactly a radius away.
    const double x = i % 4 < 2 ? place(random) : std::round(place(random) * 10) / 10 + 0.05;
    const Point deep = point_at(x, place(random), -1 - i * 0.02);
    const Point end = point_at(deep[Axis::x] + 5, deep[Axis::y] + (i % 3), -1 - i * 0.02);
    stock.line(point_at(deep[Axis::x], deep[Axis::y], 5), deep, {.tool = tool});
    stock.line(deep, end, {.tool = tool});
    here = point_at(end[Axis::x], end[Axis::y], 5);
    stock.line(end, here, {.tool = tool, .rapid = true});
  }
  stock.cutter.finish();
  for (const MoveCut& cut : stock.cuts) {
    EXPECT_TRUE(!cut.move.rapid || cut.depth < 0.005) << cut.depth;
  }
}

TEST(StockCutter, tells_where_a_rapid_goes_through_the_stock) {
  CutBlock stock(plate, 0.1, {.tools = {flat_tool(6)}});
  stock.line(point_at(-10, 15, -3), point_at(50, 15, -3), {.line = 7, .rapid = true});
  stock.cutter.finish();
  EXPECT_EQ(stock.cuts[0].move.line, 7U);
  EXPECT_NEAR(stock.cuts[0].depth, 3, 1e-5);
  EXPECT_NEAR(stock.cuts[0].place.y, 15, 3);
  EXPECT_NEAR(stock.cuts[0].place.z, 0, 1e-6);
}

TEST(StockCutter, tells_how_deep_the_holder_is_in_the_stock_that_is_left) {
  ToolShape tool = flat_tool(4);
  tool.holder_radius = Mm(10);
  tool.holder_from = Mm(6);
  CutBlock stock(plate, 0.1, {.tools = {tool}});
  stock.line(point_at(20, 15, 0), point_at(20, 15, -5));
  stock.line(point_at(20, 15, -5), point_at(20, 15, -8));
  stock.cutter.finish();
  EXPECT_EQ(stock.cuts[0].holder, 0);
  EXPECT_NEAR(stock.cuts[1].holder, 2, 1e-5);
  EXPECT_NEAR(std::hypot(stock.cuts[1].holder_place.x - 20, stock.cuts[1].holder_place.y - 15), 6, 4.1);
}

TEST(StockCutter, tells_how_deep_the_tool_is_in_a_clamp) {
  CutBlock stock(plate, 0.1, {.tools = {flat_tool(4)}, .clamps = {{{38, 10, -10}, {60, 20, 8}}}});
  stock.line(point_at(10, 15, 5), point_at(35, 15, 5), {.rapid = true});
  stock.line(point_at(35, 15, 5), point_at(50, 15, 5), {.rapid = true});
  stock.cutter.finish();
  EXPECT_EQ(stock.cuts[0].clamp, 0);
  EXPECT_NEAR(stock.cuts[1].clamp, 3, 1e-5);
  EXPECT_GE(stock.cuts[1].clamp_place.x, 38);
}

struct Cutting {
  HeightField field;
  std::vector<MoveCut> cuts;
};

Cutting random_cutting(unsigned threads, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> x(-2, 42);
  std::uniform_real_distribution<double> z(-9, 3);
  const ToolShape v{.cutter = Cutter::vee(Mm(6), {std::numbers::pi / 3}, Mm(0.2))};
  ToolShape bull{.cutter = Cutter::bull_nose(Mm(4), Mm(0.5))};
  bull.holder_radius = Mm(8);
  bull.holder_from = Mm(5);
  CutBlock stock(
      plate, 0.1,
      {.tools = {flat_tool(5), ball_tool(2), v, bull}, .clamps = {{{0, 0, 0}, {5, 5, 5}}}, .threads = threads});
  Point here = point_at(0, 0, 3);
  for (std::uint32_t i = 0; i < 120; ++i) {
    const Point next = point_at(x(random), x(random), z(random));
    const StockMove move{.line = i, .tool = i / 7 % 4, .rapid = i % 11 == 0, .time = Seconds(1)};
    if (i % 3 == 0) {
      stock.cutter.cut(Curve::arc(here, next, Axis::x, Axis::y, (here[Axis::x] + next[Axis::x]) / 2,
                                  (here[Axis::y] + next[Axis::y]) / 2, std::numbers::pi),
                       {}, move);
    } else {
      stock.line(here, next, move);
    }
    here = next;
  }
  stock.cutter.finish();
  return {std::move(stock.field), std::move(stock.cuts)};
}

TEST(StockCutter, gives_the_same_bytes_for_any_number_of_threads) {
  const std::uint64_t seed = test::seed();
  const Cutting one = random_cutting(1, seed);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Cutting many = random_cutting(threads, seed);
    for (std::size_t row = 0; row < one.field.rows(); ++row) {
      ASSERT_TRUE(std::equal(one.field.below_top(row), one.field.below_top(row) + one.field.columns(),
                             many.field.below_top(row)))
          << threads << " threads, row " << row;
    }
    ASSERT_EQ(one.cuts.size(), many.cuts.size());
    for (std::size_t i = 0; i < one.cuts.size(); ++i) {
      const MoveCut& a = one.cuts[i];
      const MoveCut& b = many.cuts[i];
      EXPECT_EQ(a.volume, b.volume) << i;
      EXPECT_EQ(a.area, b.area) << i;
      EXPECT_EQ(a.depth, b.depth) << i;
      EXPECT_EQ(a.place, b.place) << i;
      EXPECT_EQ(a.holder, b.holder) << i;
      EXPECT_EQ(a.holder_place, b.holder_place) << i;
      EXPECT_EQ(a.clamp, b.clamp) << i;
      EXPECT_EQ(a.below, b.below) << i;
    }
  }
}

TEST(StockCutter, the_volumes_of_the_moves_are_what_the_field_has_lost) {
  const Cutting done = random_cutting(2, 5);
  double sum = 0;
  for (const MoveCut& cut : done.cuts) sum += cut.volume;
  const double whole = field_of(plate, 0.1).volume();
  EXPECT_NEAR(sum, whole - done.field.volume(), 1e-5 * whole);
}

// Its cells are 5 mm wide, and the tool 2 mm: it would pass between their centres.
TEST(StockCutter, sees_a_clamp_on_a_huge_stock) {
  const StockBlock table{{0, 0, -10}, {6000, 3000, 0}};
  CutBlock stock(table, HeightField::usual_cell(table).value(),
                 {.tools = {flat_tool(2)}, .clamps = {{{1000, 1000, -10}, {1020, 1020, 8}}}});
  ASSERT_GE(stock.field.cell(), 2);
  stock.line(point_at(1000.5, 500, 5), point_at(1000.5, 1500, 5), {.rapid = true});
  stock.cutter.finish();
  ASSERT_EQ(stock.cuts.size(), 1U);
  EXPECT_NEAR(stock.cuts[0].clamp, 3, 1e-5);
}

TEST(HeightField, refuses_what_is_too_large_with_a_reason) {
  const auto refused = HeightField::create({{0, 0, -1}, {5000, 5000, 0}}, Mm(0.1));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(
      refused.error().message,
      "a stock of 5000 x 5000 mm has 2500000000 cells of 0.1 mm: expected at most 100000000; give a larger --cell");
  EXPECT_FALSE(HeightField::create({{0, 0, 0}, {0, 5, 1}}, Mm(0.1)).has_value());
  EXPECT_FALSE(HeightField::create({{0, 0, 0}, {5, 5, 1}}, Mm(0)).has_value());
  EXPECT_FALSE(HeightField::create({{0, 0, 0}, {5, NAN, 1}}, Mm(0.1)).has_value());
}

TEST(HeightField, chooses_a_tenth_of_a_millimetre_for_a_hundred) {
  EXPECT_EQ(HeightField::usual_cell({{0, 0, -1}, {100, 100, 0}}), Mm(0.1));
  EXPECT_EQ(HeightField::usual_cell({{0, 0, -1}, {1000, 1000, 0}}), Mm(1));
  EXPECT_EQ(HeightField::usual_cell({{0, 0, -1}, {20, 10, 0}}), Mm(0.01));
}

}  // namespace
}  // namespace passo
