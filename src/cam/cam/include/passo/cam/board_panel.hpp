// PanelGrid: copies of a board in columns and rows, for one blank.
//
// All copies have the same orientation. The first one is where the board was drawn; the others are to the right of it
// and above it. Trim all layers to the board's box first; otherwise copies overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct PanelGrid {
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  Nanometres gap{5'000'000};  // between the boxes of two neighbours

  std::size_t copies() const { return std::size_t{columns} * rows; }
};

inline constexpr std::uint32_t most_panel_columns = 100;  // and rows

// Returns the offset of each copy from the first one, row by row; the first offset is 0. `board`: the box of one board.
std::vector<DrawnPoint> offsets_of(const PanelGrid& grid, const DrawnBox& board);

Region repeated(const Region& region, const std::vector<DrawnPoint>& offsets);
Drawing repeated(const Drawing& drawing, const std::vector<DrawnPoint>& offsets);
// Nets of different copies have different names: "GND of copy 2".
BoardLayer repeated(const BoardLayer& layer, const std::vector<DrawnPoint>& offsets);

// Removes all objects outside the box. Lines that are partly inside are kept whole.
void trim_to(const DrawnBox& box, BoardLayer& layer);
// Removes the holes and slots outside the box, and returns their number.
std::size_t trim_to(const DrawnBox& box, Drawing& drills);

}  // namespace passo
