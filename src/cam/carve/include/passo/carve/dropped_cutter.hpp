// DroppedCutter: computes the lowest gouge-free height of a cutter's tip at each node of a grid.
//
// This is a greyscale dilation: the tip's height is the maximum of (height of a node - table at the node's distance).
// The table does not sample the cutter's shape: its bilinear patches lie on or below the shape everywhere
// (CutterTable). Therefore the bilinear patches through the tip heights are gouge-free at every position between nodes,
// too, against every point of the bilinear surface, and so is each straight move along a row or a column of nodes. The
// proof is in docs/decisions/0097-a-table-below-the-cutter.md. Over a flat area the tip height is exact, elsewhere it
// is too high by about pitch^2 / 4 / radius.
//
// All height arithmetic is exact in floats, so results are the same on every computer. Cost: for a cutter with a radius
// of n nodes, at most n^2 vector steps for 4 nodes; maxima of blocks allow skipping the parts of the cutter that cannot
// touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "passo/carve/height_grid.hpp"
#include "passo/geometry/cutter.hpp"

namespace passo {

// A quadrant of the cutter's shape at the nodes around its axis; the other quadrants are mirror images.
class CutterTable {
 public:
  // The maximum rounding error of a position in the program, in each direction. The table allows for it.
  static constexpr Mm rounding{1e-4};
  static constexpr float outside = std::numeric_limits<float>::infinity();

  // `below`: patches on or below the shape. `sampled`: the shape at the nodes, to compute what a cutter has cut.
  enum class Kind : std::uint8_t { below, sampled };
  CutterTable(const Cutter& cutter, Mm pitch_x, Mm pitch_y, Kind kind = Kind::below);

  // The extent of the table from the axis, in nodes.
  std::size_t reach_x() const { return columns_ - 1; }
  std::size_t reach_y() const { return rows_ - 1; }
  // Returns the height above the tip at `column` and `row` nodes from the axis, or `outside`.
  float at(std::size_t column, std::size_t row) const { return heights_[row * columns_ + column]; }
  std::span<const float> row(std::size_t away) const { return {&heights_[away * columns_], widths_[away]}; }
  // The minimum of a row, and of each 16 columns of the row.
  float least_of_row(std::size_t row) const { return least_[row * blocks_]; }
  float least_of_block(std::size_t row, std::size_t index) const { return least_[row * blocks_ + 1 + index]; }

  static constexpr std::size_t block = 16;

 private:
  void put_planes(const Cutter& cutter, double px, double py);
  void put_samples(const Cutter& cutter, double px, double py);
  void count();

  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::size_t blocks_ = 0;
  std::vector<float> heights_;
  std::vector<std::size_t> widths_;  // for each row: number of columns that are not outside
  std::vector<float> least_;
};

// The surface beyond the edge of the grid: nothing; or a continuation, which is level or, where the surface falls
// towards the edge, keeps falling with the same slope down to the floor.
enum class BesideGrid : std::uint8_t { nothing, goes_on };

class DroppedCutter {
 public:
  static constexpr float nothing = -std::numeric_limits<float>::infinity();

  // `grid` must outlive this object. `floor`: the minimum height of the tip.
  DroppedCutter(const HeightGrid& grid, const Cutter& cutter, float floor,
                CutterTable::Kind kind = CutterTable::Kind::below, BesideGrid beside = BesideGrid::nothing);

  const HeightGrid& grid() const { return grid_; }
  const CutterTable& table() const { return table_; }

  // Working memory of one thread.
  struct Scratch {
    std::vector<float> heights;
    std::vector<float> tops;
  };
  // Computes the tip heights at the nodes of a row, starting at `column`. Columns and rows may lie outside the grid.
  void heights(std::ptrdiff_t row, std::ptrdiff_t column, std::span<float> out, Scratch& scratch) const;

 private:
  void drop(std::ptrdiff_t row, std::ptrdiff_t column, float* out, Scratch& scratch) const;
  float beside(std::ptrdiff_t column, std::ptrdiff_t row) const;
  void keep_frame();
  void raise(std::ptrdiff_t row, std::ptrdiff_t begin, std::ptrdiff_t end, float* heights) const;
  bool combine(std::ptrdiff_t row, std::ptrdiff_t column, std::size_t away, float least, Scratch& scratch) const;

  const HeightGrid& grid_;
  CutterTable table_;
  float floor_;
  bool goes_on_;
  std::size_t blocks_ = 0;   // number of blocks in a row of the grid
  std::vector<float> tops_;  // the maximum height of each 32 columns of each row
  // The heights that the cutter needs most often beside the grid. They cost more to compute than to read.
  std::ptrdiff_t frame_x_ = 0;  // width of the frame, in nodes
  std::ptrdiff_t frame_y_ = 0;
  std::vector<float> frame_rows_;   // those below the grid, then those above it, with their corners
  std::vector<float> frame_sides_;  // of each row of the grid those to its left, then those to its right
};

// A rectangle of nodes with a height for each; it may extend beyond the grid by `margin` nodes on each side.
struct TipMap {
  std::ptrdiff_t margin_x = 0;
  std::ptrdiff_t margin_y = 0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> heights = {};

  float at(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return heights[static_cast<std::size_t>(row + margin_y) * columns + static_cast<std::size_t>(column + margin_x)];
  }
};

// Computes all nodes of the grid and of a margin around it. `threads`: at least 1; the result does not depend on it.
TipMap drop_everywhere(const DroppedCutter& cutter, std::size_t margin_x, std::size_t margin_y, unsigned threads);

}  // namespace passo
