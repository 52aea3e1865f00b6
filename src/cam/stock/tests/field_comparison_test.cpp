#include "passo/stock/field_comparison.hpp"

#include <vector>

#include "cut_stock.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::field_of;

const StockBlock small_plate{{0, 0, -5}, {10, 8, 0}};

TEST(FieldComparison, equal_fields_do_not_differ) {
  const HeightField field = field_of(small_plate, 0.1);
  const FieldDifference found = compare_fields(field, target_of(field), Mm(0));
  EXPECT_EQ(found.left.cells, 0U);
  EXPECT_EQ(found.gouge.cells, 0U);
}

TEST(FieldComparison, finds_what_is_left_and_what_is_gouged_with_volume_and_place) {
  HeightField target = field_of(small_plate, 0.1);
  HeightField field = target;
  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 100; ++column) target.set_height(column, row, -2);
  }
  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      const bool hill = column >= 20 && column < 30 && row >= 20 && row < 30;
      field.set_height(column, row, hill ? -1.5 : column == 70 && row == 40 ? -3 : -2);
    }
  }
  const FieldDifference found = compare_fields(field, target_of(target), Mm(0.02));
  EXPECT_NEAR(found.left.volume, 0.5, 1e-6);
  EXPECT_EQ(found.left.cells, 100U);
  EXPECT_NEAR(found.left.largest, 0.5, 1e-6);
  EXPECT_NEAR(found.gouge.volume, 0.01, 1e-6);
  EXPECT_NEAR(found.gouge.largest, 1, 1e-6);
  EXPECT_NEAR(found.gouge.place.x, 7.05, 1e-9);
  EXPECT_NEAR(found.gouge.place.y, 4.05, 1e-9);
  EXPECT_NEAR(found.gouge.place.z, -3, 1e-6);
}

TEST(FieldComparison, a_wall_may_be_a_cell_farther) {
  HeightField target = field_of(small_plate, 0.1);
  HeightField field = target;
  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 50; ++column) target.set_height(column, row, -4);
    for (std::size_t column = 0; column < 51; ++column) field.set_height(column, row, -4);
  }
  EXPECT_EQ(compare_fields(field, target_of(target), Mm(0.01)).gouge.cells, 0U);
  for (std::size_t row = 0; row < 80; ++row) field.set_height(51, row, -4);
  EXPECT_EQ(compare_fields(field, target_of(target), Mm(0.01)).gouge.cells, 80U);
}

// A rib of a tenth of a cell, between the centres of two columns.
std::vector<SurfaceTriangle> rib() {
  const SurfacePoint a{5.02, 1, 0};
  const SurfacePoint b{5.02, 7, 0};
  const SurfacePoint c{5.03, 1, 0};
  const SurfacePoint d{5.03, 7, 0};
  const SurfacePoint low{0, 0, -4};
  const SurfacePoint right{10, 0, -4};
  const SurfacePoint high{0, 8, -4};
  const SurfacePoint far{10, 8, -4};
  return {{a, c, d}, {a, d, b}, {low, right, far}, {low, far, high}};
}

TEST(FieldComparison, the_highest_point_of_a_cell_counts) {
  const CutTarget target = target_of(rib(), Surface(rib()), field_of(small_plate, 0.1));
  EXPECT_EQ(target.low.height(50, 40), -4);
  EXPECT_EQ(target.high.height(50, 40), 0);
  EXPECT_EQ(target.high.height(49, 40), -4);
  EXPECT_EQ(target.high.height(50, 5), -4) << "before the rib begins";
  HeightField cut = field_of(small_plate, 0.1);
  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 100; ++column) cut.set_height(column, row, -4);
  }
  EXPECT_EQ(compare_fields(cut, target, Mm(0.01)).gouge.cells, 0U) << "the centres alone show nothing";
  CutTarget known = target;
  known.at_most = cut;
  const FieldDifference found = compare_fields(cut, known, Mm(0.01));
  EXPECT_NEAR(static_cast<double>(found.gouge.cells), 60, 2);
  EXPECT_NEAR(found.gouge.largest, 4, 1e-6);
  known.is_beside.assign(8000, true);
  EXPECT_EQ(compare_fields(cut, known, Mm(0.01)).gouge.cells, 0U);
}

TEST(FieldComparison, a_wall_that_is_off_counts_sideways) {
  HeightField wall = field_of(small_plate, 0.1);
  HeightField cut = wall;
  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 50; ++column) wall.set_height(column, row, -4);
    for (std::size_t column = 0; column < 55; ++column) cut.set_height(column, row, -4);
  }
  CutTarget target = target_of(wall);
  target.at_most = cut;
  const FieldDifference found = compare_fields(cut, target, Mm(0.02));
  EXPECT_NEAR(found.gouge.largest, 0.5, 1e-6);
  target = target_of(cut);
  EXPECT_NEAR(compare_fields(wall, target, Mm(0.02)).left.largest, 0.5, 1e-6);
}

// Wherever the thin cutter's axis is within the distance, its shape is within the cutter.
TEST(FieldComparison, a_thin_cutter_stays_within_the_cutter) {
  for (const char* text : {"ball:3", "flat:2", "bull:4:1", "bull:3:1.4", "vee:60:3", "vee:90:4:1", "taper:1:8:4"}) {
    const Cutter cutter = *parse_cutter(text);
    const Mm by{0.2};
    const Cutter thin = thinned(cutter, by);
    const Mm tip = thinned_tip(cutter, by);
    for (Mm away{0}; away <= thin.radius; away += Mm(0.01)) {
      EXPECT_GE((tip + thin.height(away)).value(), cutter.height(std::min(away + by, cutter.radius)).value() - 2e-3)
          << text << " at " << away.value();
    }
    EXPECT_LE((thin.radius + by).value(), cutter.radius.value() + 1e-9) << text;
  }
}

}  // namespace
}  // namespace passo
