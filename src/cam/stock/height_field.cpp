#include "passo/stock/height_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double largest_stock = 1e4;   // mm
constexpr double deepest_stock = 1000;  // mm
constexpr double usual_cells = 3e6;
// Rows begin at a multiple of this, so that two tiles never share a line of the cache.
constexpr std::size_t row_step = 16;

// Cells that cover a length. A rest of a millionth of a cell is rounding.
double cells_along(double length, double cell) {
  return std::max(1.0, std::ceil(length / cell - 1e-6));
}

}  // namespace

HeightField::HeightField(const StockBlock& block, double cell, std::size_t columns, std::size_t rows)
    : block_(block),
      cell_(cell),
      columns_(columns),
      rows_(rows),
      stride_((columns + row_step - 1) / row_step * row_step),
      heights_(stride_ * rows) {}

Result<HeightField, FieldRefusal> HeightField::create(const StockBlock& block, Mm cell) {
  const Vector3 size = block.high - block.low;
  if (!(size.x > 0 && size.y > 0 && size.z > 0) || !is_finite(size)) {
    return Failure{
        FieldRefusal{fmt::format("a stock of {:g} x {:g} x {:g} mm: expected sizes above 0", size.x, size.y, size.z)}};
  }
  if (std::max(size.x, size.y) > largest_stock || size.z > deepest_stock) {
    return Failure{FieldRefusal{fmt::format("a stock of {:g} x {:g} x {:g} mm: expected at most {:g} x {:g} x {:g} mm",
                                            size.x, size.y, size.z, largest_stock, largest_stock, deepest_stock)}};
  }
  if (!(cell.value() >= 1e-3 && cell.value() <= 10)) {
    return Failure{FieldRefusal{fmt::format("a cell of {:g} mm: expected 0.001 to 10 mm", cell.value())}};
  }
  const double columns = cells_along(size.x, cell.value());
  const double rows = cells_along(size.y, cell.value());
  if (columns * rows > static_cast<double>(most_cells)) {
    return Failure{FieldRefusal{
        fmt::format("a stock of {:g} x {:g} mm has {:.0f} cells of {:g} mm: expected at most {}; give a larger --cell",
                    size.x, size.y, columns * rows, cell.value(), most_cells)}};
  }
  return HeightField(block, cell.value(), static_cast<std::size_t>(columns), static_cast<std::size_t>(rows));
}

Mm HeightField::usual_cell(const StockBlock& block) {
  const Vector3 size = block.high - block.low;
  for (const double cell : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
    if (cells_along(size.x, cell) * cells_along(size.y, cell) <= usual_cells) return Mm(cell);
  }
  return Mm(10);
}

void HeightField::set_height(std::size_t column, std::size_t row, double z) {
  below_top(row)[column] = static_cast<float>(std::clamp(z, bottom(), top()) - top());
}

double HeightField::volume() const {
  double sum = 0;
  for (std::size_t row = 0; row < rows_; ++row) {
    const float* heights = below_top(row);
    double of_row = 0;
    for (std::size_t column = 0; column < columns_; ++column) of_row += static_cast<double>(heights[column]);
    sum += of_row;
  }
  const double cells = static_cast<double>(columns_ * rows_);
  return (cells * (top() - bottom()) + sum) * cell_ * cell_;
}

}  // namespace passo
