#include "passo/levelling/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

// The number of the first of the two grid lines between which a value is. The value is within the grid.
std::size_t interval_of(const std::vector<double>& lines, double value) {
  const auto next = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
  return static_cast<std::size_t>(next - lines.begin()) - 1;
}

}  // namespace

HeightMap::HeightMap(std::vector<double> columns, std::vector<double> rows, std::vector<double> heights)
    : columns_(std::move(columns)), rows_(std::move(rows)), heights_(std::move(heights)) {}

HeightMap::Cell HeightMap::cell_at(double x, double y) const {
  const double on_x = std::clamp(x, columns_.front(), columns_.back());
  const double on_y = std::clamp(y, rows_.front(), rows_.back());
  const std::size_t column = interval_of(columns_, on_x);
  const std::size_t row = interval_of(rows_, on_y);
  const double width = columns_[column + 1] - columns_[column];
  const double depth = rows_[row + 1] - rows_[row];
  const double base = at(column, row);
  Cell cell{.x0 = columns_[column], .y0 = rows_[row], .base = base};
  cell.along_x = (at(column + 1, row) - base) / width;
  cell.along_y = (at(column, row + 1) - base) / depth;
  cell.twist = (at(column + 1, row + 1) - at(column, row + 1) - at(column + 1, row) + base) / (width * depth);
  if (on_x != x) {
    cell.base += cell.along_x * (on_x - cell.x0);
    cell.along_y += cell.twist * (on_x - cell.x0);
    cell.along_x = cell.twist = 0;
  }
  if (on_y != y) {
    cell.base += cell.along_y * (on_y - cell.y0);
    cell.along_x += cell.twist * (on_y - cell.y0);
    cell.along_y = cell.twist = 0;
  }
  return cell;
}

double HeightMap::height(double x, double y) const {
  const Cell cell = cell_at(x, y);
  const double dx = x - cell.x0;
  const double dy = y - cell.y0;
  return cell.base + cell.along_x * dx + cell.along_y * dy + cell.twist * dx * dy;
}

double HeightMap::lowest() const {
  return *std::ranges::min_element(heights_);
}

double HeightMap::highest() const {
  return *std::ranges::max_element(heights_);
}

double HeightMap::distance_beside(double x, double y) const {
  return std::hypot(x - std::clamp(x, columns_.front(), columns_.back()),
                    y - std::clamp(y, rows_.front(), rows_.back()));
}

HeightMap HeightMap::lowered_by(double height) const {
  HeightMap lowered = *this;
  for (double& each : lowered.heights_) each -= height;
  return lowered;
}

std::string text_of(const HeightMap& map) {
  std::string text = "x,y,z\n";
  for (std::size_t row = 0; row < map.rows().size(); ++row) {
    for (std::size_t column = 0; column < map.columns().size(); ++column) {
      text += fmt::format("{:.4f},{:.4f},{:.4f}\n", map.columns()[column], map.rows()[row], map.at(column, row));
    }
  }
  return text;
}

}  // namespace passo
