// LevelLines: extracts the contour lines of a height map at a given height. Private to carve/.
//
// Between four nodes the map is the bilinear patch through them. Its contour lines are hyperbolas. Each becomes one
// chord, or two tangents if the chord would lie above the height, so that no point of a line is more than `slack` above
// it.
//
// Sources: W. E. Lorensen, H. E. Cline, Marching cubes (1987), in the plane; G. M. Nielson, B. Hamann, The asymptotic
// decider (1991), for cells with four crossings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "passo/carve/dropped_cutter.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct FlatPlace {
  double x = 0;  // mm from node (0, 0) of the surface
  double y = 0;
};

// A contour line. The higher side is on its right.
struct LevelLine {
  std::vector<FlatPlace> points = {};
  bool is_closed = false;  // the last point equals the first; otherwise both ends lie on the edge of the map
};

// The map as a surface in mm.
class TipSurface {
 public:
  // `map` must outlive this object.
  TipSurface(const TipMap& map, Mm pitch_x, Mm pitch_y)
      : map_(map), pitch_x_(pitch_x.value()), pitch_y_(pitch_y.value()) {}

  const TipMap& map() const { return map_; }
  double pitch_x() const { return pitch_x_; }
  double pitch_y() const { return pitch_y_; }
  // Returns the height. Outside the map it is the height of the nearest edge.
  double at(const FlatPlace& place) const;
  // Returns the maximum height along a straight line.
  double highest(const FlatPlace& from, const FlatPlace& to) const;

 private:
  struct Cell {
    double low_left = 0;
    double low_right = 0;
    double high_left = 0;
    double high_right = 0;
  };
  Cell cell(std::size_t column, std::size_t row) const;

  const TipMap& map_;
  double pitch_x_;
  double pitch_y_;
};

class LevelLines {
 public:
  static constexpr double slack = 1e-5;  // mm

  // `map` must outlive this object, and must not change.
  LevelLines(const TipMap& map, Mm pitch_x, Mm pitch_y);

  // Calls act(line) for each line, always in the same order.
  void trace(float height, const std::function<void(LevelLine&&)>& act);

 private:
  struct Place {
    std::size_t column = 0;  // column of a cell
    std::size_t row = 0;
    int edge = 0;  // 0: bottom, 1: right, 2: top, 3: left
  };
  using Corners = std::array<float, 4>;  // counterclockwise from the lower left

  Corners corners(std::size_t column, std::size_t row) const;
  bool is_entry(const Place& place) const;
  int exit_of(const Place& entry) const;
  bool step(Place& place) const;
  FlatPlace crossing(const Place& place) const;
  void add_tangents(const Place& entry, int exit, LevelLine& line) const;
  std::size_t number_of(const Place& place) const;
  void follow(Place entry, const std::function<void(LevelLine&&)>& act);
  bool has_line(std::size_t block, std::size_t row) const;

  const TipMap& map_;
  double pitch_x_;
  double pitch_y_;
  float height_ = 0;
  static constexpr std::size_t block = 64;  // cells
  std::size_t blocks_ = 0;                  // number of blocks in a row of cells
  std::vector<float> lowest_;
  std::vector<float> highest_;
  std::vector<bool> seen_;  // edges whose crossing belongs to a traced line
};

}  // namespace passo
