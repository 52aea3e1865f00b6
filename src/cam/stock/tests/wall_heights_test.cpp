#include "passo/stock/wall_heights.hpp"

#include <cmath>

#include "cut_stock.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::field_of;
using test::point_at;

constexpr StockBlock wall_block{{0, 0, -5}, {30, 20, 0}};

// A slot with round ends, of a flat tool of 4 mm, across the grid.
const Vector3 slot_from{5.013, 6.07, -3};
const Vector3 slot_to{23.41, 12.33, -3};
constexpr double slot_radius = 2;

double slot_height(double x, double y) {
  const Vector3 place{x, y, -3};
  return length(nearest_of(slot_from, slot_to, place) - place) <= slot_radius ? -3 : 0;
}

void cut_slot(StockCutter& cutter) {
  const auto place = [](const Vector3& v) { return point_at(v.x, v.y, v.z); };
  cutter.cut(Curve::line(place({5.013, 6.07, 5}), place(slot_from)), {}, {});
  cutter.cut(Curve::line(place(slot_from), place(slot_to)), {}, {});
  cutter.finish();
}

WallHeights cut_walls_of_slot(HeightField& field, std::size_t step, unsigned threads) {
  const StockCutterOptions options{.tools = {test::flat_tool(2 * slot_radius)}, .threads = threads};
  StockCutter cutter(field, options, {});
  cut_slot(cutter);
  WallHeights walls = WallHeights::at_walls_of(field, step);
  StockCutter again(field, walls, options);
  cut_slot(again);
  return walls;
}

TEST(WallHeights, are_those_of_the_cut_between_the_centres) {
  for (const std::size_t step : {1U, 3U}) {
    HeightField field = field_of(wall_block, 0.2);
    WallHeights walls = cut_walls_of_slot(field, step, 1);
    std::size_t points = 0;
    std::size_t wrong = 0;
    for (const WallHeights::Patch& patch : walls.patches()) {
      for (std::size_t row = 0; row < patch.heights.rows(); ++row) {
        for (std::size_t column = 0; column < patch.heights.columns(); ++column) {
          const double x = patch.heights.x_of(column);
          const double y = patch.heights.y_of(row);
          ++points;
          if (std::abs(patch.heights.height(column, row) - slot_height(x, y)) > 1e-6) ++wrong;
        }
      }
    }
    EXPECT_GT(points, 10'000U / step);
    EXPECT_LE(wrong, points / 10'000);  // on the wall itself
  }
}

TEST(WallHeights, are_wherever_neighbours_jump_and_meet_the_field_at_its_centres) {
  HeightField field = field_of(wall_block, 0.2);
  const WallHeights walls = cut_walls_of_slot(field, 1, 1);
  std::size_t crossed = 0;
  for (std::size_t row = 0; row + 1 < field.rows(); ++row) {
    for (std::size_t column = 0; column + 1 < field.columns(); ++column) {
      const double here = field.height(column, row);
      const bool is_even = here == field.height(column + 1, row) && here == field.height(column, row + 1) &&
                           here == field.height(column + 1, row + 1);
      ASSERT_EQ(walls.crosses(column, row), !is_even) << column << " " << row;
      if (is_even) continue;
      ++crossed;
      EXPECT_EQ(walls.height(column, row, 0, 0), here);
      EXPECT_EQ(walls.height(column, row, WallHeights::parts, WallHeights::parts), field.height(column + 1, row + 1));
    }
  }
  EXPECT_GT(crossed, 200U);
}

TEST(WallHeights, have_the_same_bytes_for_any_number_of_threads) {
  HeightField field = field_of(wall_block, 0.1);
  HeightField other = field_of(wall_block, 0.1);
  WallHeights one = cut_walls_of_slot(field, 1, 1);
  WallHeights three = cut_walls_of_slot(other, 1, 3);
  ASSERT_EQ(one.patches().size(), three.patches().size());
  for (std::size_t i = 0; i < one.patches().size(); ++i) {
    const HeightField& a = one.patches()[i].heights;
    const HeightField& b = three.patches()[i].heights;
    for (std::size_t row = 0; row < a.rows(); ++row) {
      for (std::size_t column = 0; column < a.columns(); ++column) {
        ASSERT_EQ(a.height(column, row), b.height(column, row));
      }
    }
  }
}

TEST(WallHeights, slopes_and_ridges_have_none) {
  HeightField field = field_of(wall_block, 0.2);
  for (std::size_t row = 0; row < field.rows(); ++row) {
    for (std::size_t column = 0; column < field.columns(); ++column) {
      field.set_height(column, row, -std::abs(field.x_of(column) - 15) * 1.7 * (row % 2 == 0 ? 1 : 0.99));
    }
  }
  EXPECT_FALSE(WallHeights::at_walls_of(field, 1).any());
}

// Posts everywhere: more walls than there is memory for, then a few that are higher.
TEST(WallHeights, are_bounded_and_then_the_highest_are_taken) {
  HeightField field = field_of({{0, 0, -50}, {100, 100, 0}}, 0.2);
  for (std::size_t row = 0; row < field.rows(); ++row) {
    for (std::size_t column = 0; column < field.columns(); ++column) {
      if (column % 4 < 2 && row % 4 < 2) field.set_height(column, row, column < 4 ? -20 : -0.5);
    }
  }
  WallHeights walls = WallHeights::at_walls_of(field, 1);
  EXPECT_TRUE(walls.any());
  EXPECT_LE(walls.patches().size(), 64 + field.columns() * field.rows() / 200);
  EXPECT_TRUE(walls.crosses(1, 1));
  EXPECT_FALSE(walls.crosses(41, 41));
}

TEST(WallHeights, stay_within_the_smallest_fields) {
  for (const double size : {0.2, 0.4, 0.6}) {
    HeightField field = field_of({{0, 0, -5}, {size, 0.2, 0}}, 0.2);
    field.set_height(0, 0, -3);
    for (const std::size_t step : {1U, 2U, 100U}) EXPECT_FALSE(WallHeights::at_walls_of(field, step).any());
  }
}

}  // namespace
}  // namespace passo
