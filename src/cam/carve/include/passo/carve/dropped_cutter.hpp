// DroppedCutter: how deep a cutter's tip may go at each node of a grid, so that the cutter cuts nothing of the surface.
//
// It is a grey dilation: the tip's height is the greatest of (height of a node - table at the node's distance). The
// table is no sample of the cutter's shape. Its bilinear patches lie on or below the shape everywhere (CutterTable),
// and from that follows: the bilinear patches through the tips' heights are free of gouges at every place between nodes
// too, against every point of the bilinear surface. So is each straight move along a row or a column of nodes. The
// proof is in docs/decisions/0097-a-table-below-the-cutter.md. Over a flat the tip is exact, elsewhere it is too high
// by about pitch^2 / 4 / radius.
//
// All arithmetic of heights is exact in floats, so results are the same on every computer. Cost: for a cutter of n
// nodes radius, at most n^2 vector steps for 4 nodes; parts of the cutter that cannot touch are skipped by the maxima
// of blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "passo/carve/height_grid.hpp"
#include "passo/geometry/cutter.hpp"

namespace passo {

// A quarter of the cutter's shape over the nodes around its axis; the other quarters are mirrored.
class CutterTable {
 public:
  // What a program's rounding may move a place by, to each side. The table allows for it.
  static constexpr Mm rounding{1e-4};
  static constexpr float outside = std::numeric_limits<float>::infinity();

  // `below`: patches on or below the shape. `sampled`: the shape at the nodes, to tell what a cutter has cut.
  enum class Kind : std::uint8_t { below, sampled };
  CutterTable(const Cutter& cutter, Mm pitch_x, Mm pitch_y, Kind kind = Kind::below);

  // How many nodes away from the axis the table goes.
  std::size_t reach_x() const { return columns_ - 1; }
  std::size_t reach_y() const { return rows_ - 1; }
  // Height above the tip at `column` and `row` nodes from the axis, or `outside`.
  float at(std::size_t column, std::size_t row) const { return heights_[row * columns_ + column]; }
  std::span<const float> row(std::size_t away) const { return {&heights_[away * columns_], widths_[away]}; }
  // The least of a row, and of each 16 columns of it.
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
  std::vector<std::size_t> widths_;  // of each row: columns that are not outside
  std::vector<float> least_;
};

// What is beside the grid: nothing, or the surface goes on: level, or where it falls towards the edge falling as on its
// other side, down to the floor.
enum class BesideGrid : std::uint8_t { nothing, goes_on };

class DroppedCutter {
 public:
  static constexpr float nothing = -std::numeric_limits<float>::infinity();

  // `grid` outlives this. `floor`: the tip goes nowhere below.
  DroppedCutter(const HeightGrid& grid, const Cutter& cutter, float floor,
                CutterTable::Kind kind = CutterTable::Kind::below, BesideGrid beside = BesideGrid::nothing);

  const HeightGrid& grid() const { return grid_; }
  const CutterTable& table() const { return table_; }

  // Scratch memory of one thread.
  struct Scratch {
    std::vector<float> heights;
    std::vector<float> tops;
  };
  // The tip's heights at the nodes from `column` on of a row. Columns and rows may lie beside the grid.
  void heights(std::ptrdiff_t row, std::ptrdiff_t column, std::span<float> out, Scratch& scratch) const;

 private:
  void drop(std::ptrdiff_t row, std::ptrdiff_t column, float* out, Scratch& scratch) const;
  float beside(std::ptrdiff_t column, std::ptrdiff_t row) const;
  bool combine(std::ptrdiff_t row, std::ptrdiff_t column, std::size_t away, float least, Scratch& scratch) const;

  const HeightGrid& grid_;
  CutterTable table_;
  float floor_;
  bool goes_on_;
  std::size_t blocks_ = 0;   // in a row of the grid
  std::vector<float> tops_;  // the greatest height of each 32 columns of each row
};

// A part of the plane of nodes with a height for each; it may go beyond the grid by `margin` nodes each way.
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

// All nodes of the grid and of a margin around it. `threads`: 1 or more; the result is the same for any number.
TipMap drop_everywhere(const DroppedCutter& cutter, std::size_t margin_x, std::size_t margin_y, unsigned threads);

}  // namespace passo
