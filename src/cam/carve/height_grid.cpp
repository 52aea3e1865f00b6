#include "passo/carve/height_grid.hpp"

#include <algorithm>

namespace passo {

HeightGrid HeightGrid::transposed() const {
  HeightGrid turned{.columns = rows, .rows = columns, .pitch_x = pitch_y, .pitch_y = pitch_x};
  turned.heights.resize(heights.size());
  constexpr std::size_t tile = 32;  // both sides of a tile stay in the cache
  for (std::size_t y = 0; y < rows; y += tile) {
    for (std::size_t x = 0; x < columns; x += tile) {
      for (std::size_t i = x; i < std::min(x + tile, columns); ++i) {
        for (std::size_t j = y; j < std::min(y + tile, rows); ++j) turned.heights[i * rows + j] = at(i, j);
      }
    }
  }
  return turned;
}

HeightGrid HeightGrid::refined(std::size_t parts) const {
  if (parts < 2) return *this;
  const auto divided = static_cast<double>(parts);
  HeightGrid fine{.columns = (columns - 1) * parts + 1,
                  .rows = (rows - 1) * parts + 1,
                  .pitch_x = pitch_x / divided,
                  .pitch_y = pitch_y / divided};
  fine.heights.reserve(fine.columns * fine.rows);
  for (std::size_t y = 0; y < fine.rows; ++y) {
    const std::size_t row = y / parts;
    const double up = static_cast<double>(y % parts) / divided;
    const std::size_t next_row = std::min(row + 1, rows - 1);
    for (std::size_t x = 0; x < fine.columns; ++x) {
      const std::size_t column = x / parts;
      const double along = static_cast<double>(x % parts) / divided;
      const std::size_t next = std::min(column + 1, columns - 1);
      const double low = at(column, row) * (1 - along) + at(next, row) * along;
      const double high = at(column, next_row) * (1 - along) + at(next, next_row) * along;
      fine.heights.push_back(grid_height(Mm(low * (1 - up) + high * up)));
    }
  }
  return fine;
}

HeightGrid HeightGrid::with_rim(std::size_t wide_x, std::size_t wide_y, float level) const {
  HeightGrid wide{.columns = columns + 2 * wide_x, .rows = rows + 2 * wide_y, .pitch_x = pitch_x, .pitch_y = pitch_y};
  wide.heights.assign(wide.columns * wide.rows, level);
  for (std::size_t y = 0; y < rows; ++y) {
    std::copy_n(&heights[y * columns], columns, &wide.heights[(y + wide_y) * wide.columns + wide_x]);
  }
  return wide;
}

}  // namespace passo
