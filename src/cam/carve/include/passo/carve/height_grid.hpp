// HeightGrid: the surface to be carved, given by heights at the nodes of a grid; between four nodes it is the bilinear
// patch through them.
//
// Node (0, 0) is the lower left. Z is 0 at the top of the stock, and negative below. Each height is a multiple of
// 1/65536 mm, within 250 mm of zero, so differences of two heights are exact in a float. Outside the grid there is no
// surface.
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
  Mm pitch_x{};  // distance between two columns
  Mm pitch_y{};
  std::vector<float> heights = {};  // mm; row by row, bottom to top

  float at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
  Mm width() const { return pitch_x * static_cast<double>(columns - 1); }
  Mm length() const { return pitch_y * static_cast<double>(rows - 1); }

  // Returns the grid with rows and columns swapped.
  HeightGrid transposed() const;
  // Returns the same surface with `parts` times as many nodes in each direction.
  HeightGrid refined(std::size_t parts) const;
  // Returns the grid with a border of the height `level`, `wide_x` and `wide_y` nodes wide.
  HeightGrid with_rim(std::size_t wide_x, std::size_t wide_y, float level) const;
};

// Rounds a height to the nearest value that a grid can store.
inline float grid_height(Mm height) {
  constexpr double steps = 65536;
  return static_cast<float>(std::nearbyint(height.value() * steps) / steps);
}

}  // namespace passo
