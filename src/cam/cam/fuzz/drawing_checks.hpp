// Invariants of every drawing, whatever the input bytes were.
#pragma once

#include <cmath>

#include "kit/require.hpp"

#include "passo/cam/drawing.hpp"

namespace passo::test {

inline void check_place(DrawnPoint at) {
  require(std::abs(at.x.count) <= farthest_drawn.count && std::abs(at.y.count) <= farthest_drawn.count, "too far");
}

inline void check_drawing(const Drawing& drawing) {
  std::size_t points = drawing.holes.size();
  for (const DrawnHole& hole : drawing.holes) {
    check_place(hole.at);
    require(hole.diameter.count >= 0 && hole.layer < drawing.layers.size(), "a wrong hole");
  }
  for (const DrawnPath& path : drawing.paths) {
    require(path.points.size() >= 2 && path.layer < drawing.layers.size(), "a wrong path");
    points += path.points.size();
    for (const PathPoint& point : path.points) {
      check_place(point.at);
      require(std::isfinite(point.bulge), "a bulge that is not finite");
    }
  }
  require(points <= most_drawn, "too many points");
}

}  // namespace passo::test
