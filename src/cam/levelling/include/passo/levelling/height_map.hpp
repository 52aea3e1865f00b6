// HeightMap: the heights of a surface at the points of a grid, and so its height anywhere.
//
// Between four points of the grid the height is bilinear: along X and along Y it changes in proportion. Beside the grid
// it is that of the nearest place on the grid's edge. So the height has no jump anywhere.
//
// A file of a height map has a line x,y,z for each point of the grid, in any order. Its columns and rows may be
// unevenly spaced. Blanks or semicolons may stand for the commas, # begins a comment, and one line of names may come
// first. read_surface() (surface_file.hpp) reads the same files. Errors are diagnostics "surface.height-map".
//
// All lengths are millimetres. Cost of height(): a binary search for the column and one for the row.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class HeightMap {
 public:
  static constexpr double farthest = 1e5;  // mm: no place of a map is farther from its zero

  // Two columns and two rows at least, in ascending order. The heights row by row: `columns.size()` of them a row.
  HeightMap(std::vector<double> columns, std::vector<double> rows, std::vector<double> heights);

  double height(double x, double y) const;
  // The height at a point of the grid.
  double at(std::size_t column, std::size_t row) const { return heights_[row * columns_.size() + column]; }
  const std::vector<double>& columns() const { return columns_; }  // X
  const std::vector<double>& rows() const { return rows_; }        // Y
  double lowest() const;
  double highest() const;
  // How far a place is beside the grid; 0 on it.
  double distance_beside(double x, double y) const;
  // The same surface, with its zero where it has this height.
  HeightMap lowered_by(double height) const;

  // The part of the map in which a place lies: height = base + along_x (x − x0) + along_y (y − y0) + twist (x − x0)(y −
  // y0). Beside the grid, what does not change is 0.
  struct Cell {
    double x0 = 0;
    double y0 = 0;
    double base = 0;
    double along_x = 0;
    double along_y = 0;
    double twist = 0;
  };
  Cell cell_at(double x, double y) const;

 private:
  std::vector<double> columns_;
  std::vector<double> rows_;
  std::vector<double> heights_;
};

// Nothing, with diagnostics: the text is no whole grid.
std::optional<HeightMap> read_height_map(const std::string& name, std::string_view text, Diagnostics& diagnostics);
// A file of the map: read_height_map() reads the same map from it, to a tenth of a micrometre.
std::string text_of(const HeightMap& map);

}  // namespace passo
