#include "passo/stock/field_comparison.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passo {
namespace {

constexpr std::size_t farthest = 32;  // cells; how far a wall is looked for

// The cells at most `around` away, within the field.
struct CellBlock {
  std::size_t first_column;
  std::size_t last_column;
  std::size_t first_row;
  std::size_t last_row;

  CellBlock(const HeightField& field, std::size_t column, std::size_t row, std::size_t around)
      : first_column(column > around ? column - around : 0),
        last_column(std::min(column + around, field.columns() - 1)),
        first_row(row > around ? row - around : 0),
        last_row(std::min(row + around, field.rows() - 1)) {}

  template <class Is>
  bool any(const HeightField& field, const Is& is) const {
    for (std::size_t j = first_row; j <= last_row; ++j) {
      const float* const heights = field.below_top(j);
      if (std::any_of(heights + first_column, heights + last_column + 1, is)) return true;
    }
    return false;
  }
};

// A difference in height, or the way sideways to a cell that is high enough.
double at_wall(double size, double height, const HeightField& field, std::size_t column, std::size_t row) {
  for (std::size_t around = 1; around <= farthest; ++around) {
    const double sideways = static_cast<double>(around) * field.cell();
    if (sideways >= size) return size;
    const auto is_high = [&](float other) { return static_cast<double>(other) >= height; };
    if (CellBlock(field, column, row, around).any(field, is_high)) return sideways;
  }
  return size;
}

}  // namespace

double cell_difference(const HeightField& field, const CutTarget& target, std::size_t column, std::size_t row) {
  if (!target.is_beside.empty() && target.is_beside[row * field.columns() + column]) return 0;
  const CellBlock near(field, column, row, 1);
  float low = target.low.below_top(row)[column];
  float high = target.high.below_top(row)[column];
  for (std::size_t j = near.first_row; j <= near.last_row; ++j) {
    const float* const lows = target.low.below_top(j);
    const float* const highs = target.high.below_top(j);
    for (std::size_t i = near.first_column; i <= near.last_column; ++i) {
      low = std::min(low, lows[i]);
      high = std::max(high, highs[i]);
    }
  }
  const auto here = static_cast<double>(field.below_top(row)[column]);
  if (here > static_cast<double>(high)) {
    return at_wall(here - static_cast<double>(high), here, target.high, column, row);
  }
  double gouge = std::max(0.0, static_cast<double>(low) - here);
  if (target.at_most) {
    if (gouge > 0) gouge = at_wall(gouge, static_cast<double>(low), *target.at_most, column, row);
    const auto wanted = static_cast<double>(target.high.below_top(row)[column]);
    const double below = wanted - static_cast<double>(target.at_most->below_top(row)[column]);
    // A model that was made from cells, or from chords, may be a cell off.
    const double sideways = below > 0 ? at_wall(below, wanted, *target.at_most, column, row) : 0;
    const bool is_wall = sideways < below && sideways <= field.cell();
    if (!is_wall) gouge = std::max(gouge, sideways);
  }
  return -gouge;
}

FieldDifference compare_fields(const HeightField& field, const CutTarget& target, Mm tolerance) {
  assert(field.columns() == target.low.columns() && field.rows() == target.low.rows());
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
