// EdgeGrid: a spatial index of the edges of rings, to find those near a point or a line. Private to cam/.
//
// The index is a grid of square cells; each lists the edges that pass through or next to it.
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
    std::uint32_t owner;  // the value passed to add()
  };
  struct Near {
    std::uint32_t edge = 0;
    double distance_nm = 0;
    DrawnPoint at = {};  // the nearest point on the edge
  };

  // `cell`: the side of a cell, about the typical search distance. A grid that would exceed 16 million cells gets
  // larger cells.
  EdgeGrid(const DrawnBox& box, Nanometres cell);
  // The finished index of these rings.
  EdgeGrid(const DrawnBox& box, Nanometres cell, const std::vector<DrawnRing>& rings);

  void add(const DrawnRing& ring, std::uint32_t owner);
  void add_line(const DrawnRing& line, std::uint32_t owner);  // open
  // Must be called once, after the last add().
  void finish();

  const Edge& edge(std::uint32_t index) const { return edges_[index]; }

  // Calls `visit(edge index)` for all edges within `reach` of the bounding box of a and b; may visit an edge more than
  // once.
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

  // Returns the nearest edge within `reach`.
  std::optional<Near> nearest(DrawnPoint point, double reach) const;
  // Returns whether the line from a to b crosses an edge.
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
  std::vector<std::uint32_t> starts_;   // for each cell: index of its first entry
  std::vector<std::uint32_t> entries_;  // edge indices
};

}  // namespace passo
