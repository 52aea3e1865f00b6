// EdgeGrid: the edges of rings by place, to find those near a point or a line. Private to cam/.
//
// A grid of square cells, each with the edges that pass through it or beside it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

class EdgeGrid {
 public:
  struct Edge {
    DrawnPoint from;
    DrawnPoint to;
    std::uint32_t owner;  // what add() was told
  };
  struct Near {
    std::uint32_t edge = 0;
    double distance_nm = 0;
    DrawnPoint at = {};  // the place on the edge
  };

  // `cell`: the side of a cell, about the distances that are asked for. Grids of more than 16 million cells have wider
  // ones.
  EdgeGrid(const DrawnBox& box, Nanometres cell);

  void add(const DrawnRing& ring, std::uint32_t owner);
  // Call it once, after the last add().
  void finish();

  const Edge& edge(std::uint32_t index) const { return edges_[index]; }

  // Calls `visit(edge index)` for all edges within `reach` of the box of the points, some of them more than once.
  template <class Visit>
  void for_near(DrawnPoint a, DrawnPoint b, double reach, const Visit& visit) const {
    const Cells cells =
        cells_of({{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}}, reach);
    for (std::int64_t row = cells.low_row; row <= cells.high_row; ++row) {
      for (std::int64_t column = cells.low_column; column <= cells.high_column; ++column) {
        const auto cell = static_cast<std::size_t>(row * columns_ + column);
        for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) visit(entries_[i]);
      }
    }
  }

  // The nearest edge within `reach`.
  std::optional<Near> nearest(DrawnPoint point, double reach) const;
  // Whether the line from a to b meets an edge.
  bool is_crossed(DrawnPoint a, DrawnPoint b) const;

  static Near to_edge(DrawnPoint point, const Edge& edge);

 private:
  struct Cells {
    std::int64_t low_column;
    std::int64_t high_column;
    std::int64_t low_row;
    std::int64_t high_row;
  };
  Cells cells_of(const DrawnBox& box, double reach) const;
  template <class Visit>
  void for_cells(const Edge& edge, const Visit& visit) const;

  DrawnBox box_;
  double cell_;
  std::int64_t columns_;
  std::int64_t rows_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> starts_;   // of each cell, in entries_
  std::vector<std::uint32_t> entries_;  // edges
};

}  // namespace passo
