#include "passo/stock/field_comparison.hpp"

#include <algorithm>
#include <cassert>

namespace passo {

double cell_difference(const HeightField& field, const HeightField& target, std::size_t column, std::size_t row) {
  const std::size_t first_column = column > 0 ? column - 1 : 0;
  const std::size_t last_column = std::min(column + 1, target.columns() - 1);
  const std::size_t first_row = row > 0 ? row - 1 : 0;
  const std::size_t last_row = std::min(row + 1, target.rows() - 1);
  float low = target.below_top(row)[column];
  float high = low;
  for (std::size_t j = first_row; j <= last_row; ++j) {
    const float* const heights = target.below_top(j);
    for (std::size_t i = first_column; i <= last_column; ++i) {
      low = std::min(low, heights[i]);
      high = std::max(high, heights[i]);
    }
  }
  const float here = field.below_top(row)[column];
  if (here > high) return static_cast<double>(here) - static_cast<double>(high);
  return here < low ? static_cast<double>(here) - static_cast<double>(low) : 0;
}

FieldDifference compare_fields(const HeightField& field, const HeightField& target, Mm tolerance) {
  assert(field.columns() == target.columns() && field.rows() == target.rows());
  const double cell_area = field.cell() * field.cell();
  FieldDifference found;
  for (std::size_t row = 0; row < field.rows(); ++row) {
    for (std::size_t column = 0; column < field.columns(); ++column) {
      const double difference = cell_difference(field, target, column, row);
      const double size = difference < 0 ? -difference : difference;
      if (size <= tolerance.value()) continue;
      FieldDifference::Side& side = difference > 0 ? found.left : found.gouge;
      side.volume += size * cell_area;
      ++side.cells;
      if (size <= side.largest) continue;
      side.largest = size;
      side.place = {field.x_of(column), field.y_of(row), field.height(column, row)};
    }
  }
  return found;
}

}  // namespace passo
