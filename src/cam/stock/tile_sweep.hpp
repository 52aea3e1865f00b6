// TileSweep: a single straight sweep of a tool over one tile of a field. Private to stock/.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/geometry/cutter.hpp"
#include "passo/geometry/vector3.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

// A straight path of a tool's tip, its ends ordered by height.
struct Sweep {
  Vector3 high;
  Vector3 low;
};
Sweep sweep_between(const Vector3& a, const Vector3& b);

inline constexpr std::size_t tile_size = 64;  // cells on each side

struct Tile {
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t columns = 0;  // at most tile_size
  std::size_t rows = 0;
};

// The effect of one sweep on one tile.
struct TileCut {
  double drop = 0;  // removed height, summed over all cells, mm
  std::uint32_t cells = 0;
  float deepest = 0;
  std::uint32_t column = 0;  // cell of the field
  std::uint32_t row = 0;
  float before = 0;  // height before the cut, relative to the stock's top
};

// Cuts the field. `rim`: the radius within which the tool removes material: its own radius or slightly less.
TileCut cut_tile(HeightField& field, const Tile& tile, const Sweep& sweep, const Cutter& cutter, double rim);
// Returns how deep the tool would be in the field; does not change the field.
TileCut probe_tile(const HeightField& field, const Tile& tile, const Sweep& sweep, const Cutter& cutter, double rim);

}  // namespace passo
