// random_star: a closed contour whose corners are evenly spaced in angle about the origin, each at a random distance.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "passo/cam/bulge.hpp"
#include "passo/cam/drawing.hpp"

namespace passo::test {

struct StarShape {
  int corners = 5;
  double nearest = 5;  // mm
  double farthest = 25;
  double bulge = 0;  // maximum bulge of an edge
};

inline std::vector<PathPoint> random_star(const StarShape& shape, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<PathPoint> points;
  for (int i = 0; i < shape.corners; ++i) {
    const double angle = 2 * M_PI * i / shape.corners;
    const double far = shape.nearest + (shape.farthest - shape.nearest) * share(random);
    const double bulge = shape.bulge > 0 ? shape.bulge * share(random) : 0;
    points.push_back({{to_nanometres(Mm(far * std::cos(angle))), to_nanometres(Mm(far * std::sin(angle)))}, bulge});
  }
  return points;
}

}  // namespace passo::test
