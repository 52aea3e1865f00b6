#include "passo/stock/field_comparison.hpp"

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

}  // namespace
}  // namespace passo
