// HeightMap: the heights of a surface at the points of a grid, and the interpolated height anywhere.
//
// Between four points of the grid the height is interpolated bilinearly. Outside the grid it is the height of the
// nearest point on the grid's edge. The height is therefore continuous everywhere.
//
// A height map file has a line x,y,z for each point of the grid, in any order. Its columns and rows may be unevenly
// spaced. Blanks or semicolons may replace the commas, # begins a comment, and the first line may contain column names.
// read_surface() (surface_file.hpp) reads the same files. Errors are diagnostics "surface.height-map".
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
  static constexpr double farthest = 1e5;  // mm: maximum distance of a map's points from the origin

  // At least two columns and two rows, in ascending order. `heights`: row by row, `columns.size()` values per row.
  HeightMap(std::vector<double> columns, std::vector<double> rows, std::vector<double> heights);

  double height(double x, double y) const;
  // Returns the height at a point of the grid.
  double at(std::size_t column, std::size_t row) const { return heights_[row * columns_.size() + column]; }
  const std::vector<double>& columns() const { return columns_; }  // X
  const std::vector<double>& rows() const { return rows_; }        // Y
  double lowest() const;
  double highest() const;
  // Returns the distance of a point from the grid; 0 on the grid.
  double distance_beside(double x, double y) const;
  // Returns the same surface, shifted so that this height becomes zero.
  HeightMap lowered_by(double height) const;

  // The cell of the map that contains a point: height = base + along_x (x − x0) + along_y (y − y0) + twist (x − x0)(y −
  // y0). Outside the grid, the coefficients of the directions in which the height is constant are 0.
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

// Returns nothing, with diagnostics, if the text is not a complete grid.
std::optional<HeightMap> read_height_map(const std::string& name, std::string_view text, Diagnostics& diagnostics);
// Returns the map as a file, from which read_height_map() reads the same map to within 0.1 um.
std::string text_of(const HeightMap& map);

}  // namespace passo
