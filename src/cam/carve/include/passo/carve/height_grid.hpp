// HeightGrid: the surface that is carved: heights at the nodes of a grid, and between four nodes the bilinear patch
// through them.
//
// Node (0, 0) is the lower left. Z is 0 at the top of the stock, and negative below. Each height is a whole number of
// 1/65536 mm, and lies within 250 mm of zero: so differences of two heights are exact in a float. Beside the grid there
// is nothing.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

inline constexpr Mm deepest_relief{250};
inline constexpr std::size_t most_nodes = std::size_t{64} * 1024 * 1024;

struct HeightGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  Mm pitch_x{};  // between two columns
  Mm pitch_y{};
  std::vector<float> heights = {};  // mm; row by row, upwards

  float at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
  Mm width() const { return pitch_x * static_cast<double>(columns - 1); }
  Mm length() const { return pitch_y * static_cast<double>(rows - 1); }

  // Rows become columns.
  HeightGrid transposed() const;
  // The same surface with `parts` times as many nodes each way.
  HeightGrid refined(std::size_t parts) const;
  // With a rim of the height `level` around it, so many nodes wide.
  HeightGrid with_rim(std::size_t wide_x, std::size_t wide_y, float level) const;
};

// The nearest height that a grid may hold.
inline float grid_height(Mm height) {
  constexpr double steps = 65536;
  return static_cast<float>(std::nearbyint(height.value() * steps) / steps);
}

}  // namespace passo
