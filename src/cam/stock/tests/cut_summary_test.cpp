#include "passo/stock/cut_summary.hpp"

#include "cut_stock.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::CutBlock;
using test::flat_tool;
using test::point_at;

MoveCut feed(std::uint32_t line, double way, double volume, double area, double depth) {
  MoveCut cut;
  cut.move = {.line = line, .time = Seconds(way / 10)};
  cut.way = way;
  cut.way_level = way;
  cut.volume = volume;
  cut.area = area;
  cut.depth = depth;
  return cut;
}

TEST(CutSummary, a_slot_is_cut_with_the_whole_tool_and_its_second_pass_with_half) {
  CutBlock stock({{0, 0, -10}, {60, 40, 0}}, 0.1, {.tools = {flat_tool(6)}});
  stock.line(point_at(10, 10, 5), point_at(10, 10, -2), {.line = 1, .time = Seconds(1)});
  stock.line(point_at(10, 10, -2), point_at(50, 10, -2), {.line = 2, .time = Seconds(4)});
  stock.line(point_at(50, 10, -2), point_at(50, 13, -2), {.line = 3, .time = Seconds(1)});
  stock.line(point_at(50, 13, -2), point_at(10, 13, -2), {.line = 4, .time = Seconds(2)});
  stock.cutter.finish();
  CutSummary summary({flat_tool(6)});
  for (const MoveCut& cut : stock.cuts) summary.add(cut);
  EXPECT_EQ(summary.moves(), 4U);
  EXPECT_EQ(summary.cutting_moves(), 4U);
  EXPECT_NEAR(summary.engagement().value, 1, 0.01);
  EXPECT_EQ(summary.engagement().line, 2U);
  // The slot, and line 3, which leaves it sideways with most of the tool in the stock.
  EXPECT_NEAR(summary.heavy_way(), 43, 0.01);
  EXPECT_EQ(summary.depth().line, 1U);
  EXPECT_NEAR(summary.depth().value, 2, 1e-5);
  // Line 2 takes 40 x 6 x 2 mm³ in 4 s, and line 4 half of that in 2 s.
  EXPECT_NEAR(summary.rate().value, 120, 2);
  EXPECT_NEAR(summary.mean_rate(), summary.volume() / 8, 1e-9);
  EXPECT_TRUE(summary.troubles().empty());
}

TEST(CutSummary, short_moves_count_together_over_a_way_of_the_tools_radius) {
  CutSummary summary({flat_tool(6)});
  for (std::uint32_t i = 0; i < 30; ++i) {
    // A hundredth of a millimetre now and then takes a whole row of cells at once.
    summary.add(feed(i, 0.1, i == 7 ? 3 : 0.05, i == 7 ? 6 : 0, 1));
  }
  EXPECT_NEAR(summary.rate().value, (3 + 29 * 0.05) / 0.3, 1e-9);
  EXPECT_EQ(summary.rate().line, 7U);
  EXPECT_NEAR(summary.engagement().value, 6 / 3.0 / 6, 1e-9);
}

TEST(CutSummary, a_descent_is_no_heavy_cut) {
  CutSummary summary({flat_tool(6)});
  MoveCut ramp = feed(1, 10, 30, 60, 1);
  ramp.way_level = 9.96;
  summary.add(ramp);
  EXPECT_NEAR(summary.engagement().value, 1, 1e-9);
  EXPECT_EQ(summary.heavy_way(), 0);
  summary.add(feed(2, 10, 60, 60, 1));
  EXPECT_EQ(summary.heavy_way(), 10);
}

TEST(CutSummary, rapids_one_after_another_are_one_trouble_with_the_greatest_depth) {
  CutSummary summary({flat_tool(6)});
  const auto rapid = [&](std::uint32_t line, double depth) {
    MoveCut cut = feed(line, 10, depth * 10, 10, depth);
    cut.move.rapid = true;
    summary.add(cut);
  };
  rapid(1, 0);
  rapid(2, 1);
  rapid(3, 2.5);
  rapid(4, 0);
  rapid(5, 0.5);
  EXPECT_EQ(summary.count(CutTrouble::Kind::rapid), 2U);
  ASSERT_EQ(summary.troubles().size(), 2U);
  EXPECT_EQ(summary.troubles()[0].line, 3U);
  EXPECT_EQ(summary.troubles()[0].depth, 2.5);
  EXPECT_EQ(summary.troubles()[1].line, 5U);
}

TEST(CutSummary, a_cut_deeper_than_the_flutes_is_a_trouble) {
  ToolShape tool = flat_tool(3);
  tool.flute_length = Mm(8);
  CutSummary summary({tool});
  summary.add(feed(1, 10, 10, 10, 7.9));
  EXPECT_TRUE(summary.troubles().empty());
  summary.add(feed(2, 10, 10, 10, 8.5));
  ASSERT_EQ(summary.troubles().size(), 1U);
  EXPECT_EQ(summary.troubles()[0].kind, CutTrouble::Kind::flutes);
  EXPECT_NEAR(summary.troubles()[0].depth, 0.5, 1e-9);
}

TEST(CutSummary, keeps_ten_troubles_of_a_kind_and_counts_all) {
  CutSummary summary({flat_tool(6)});
  for (std::uint32_t i = 0; i < 50; ++i) {
    MoveCut cut = feed(i, 10, 1, 1, 1);
    cut.holder = i % 2 == 0 ? 1 : 0;
    summary.add(cut);
  }
  EXPECT_EQ(summary.troubles().size(), CutSummary::most_kept);
  EXPECT_EQ(summary.count(CutTrouble::Kind::holder), 25U);
}

}  // namespace
}  // namespace passo
