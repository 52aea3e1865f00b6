// LevelLines: the lines on which a map of heights has a given height, as a contour map has them. Private to carve/.
//
// Between four nodes the map is the bilinear patch through them. Its lines of equal height are hyperbolas. Each becomes
// one chord, or two tangents where the chord would lie above the height: so no point of a line lies higher than
// `slack` above it.
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

// What is higher lies to the right of the way.
struct LevelLine {
  std::vector<FlatPlace> points = {};
  bool is_closed = false;  // the last point is the first one; else both ends lie on the map's edge
};

// The map as a surface in mm.
class TipSurface {
 public:
  // `map` outlives this.
  TipSurface(const TipMap& map, Mm pitch_x, Mm pitch_y)
      : map_(map), pitch_x_(pitch_x.value()), pitch_y_(pitch_y.value()) {}

  const TipMap& map() const { return map_; }
  double pitch_x() const { return pitch_x_; }
  double pitch_y() const { return pitch_y_; }
  // Places beside the map have the height of its edge.
  double at(const FlatPlace& place) const;
  // The greatest height of a straight way.
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

  // `map` outlives this, and stays as it is.
  LevelLines(const TipMap& map, Mm pitch_x, Mm pitch_y);

  // Calls act(line) for each line, always in the same order.
  void trace(float height, const std::function<void(LevelLine&&)>& act);

 private:
  struct Place {
    std::size_t column = 0;  // of a cell
    std::size_t row = 0;
    int edge = 0;  // 0: low, 1: right, 2: high, 3: left
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
  std::size_t blocks_ = 0;                  // in a row of cells
  std::vector<float> lowest_;
  std::vector<float> highest_;
  std::vector<bool> seen_;  // edges whose crossing is on a line
};

}  // namespace passo
