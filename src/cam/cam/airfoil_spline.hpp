// airfoil_spline: a smooth curve through the points of an airfoil, as chords. Private to cam/.
//
// A cubic spline with continuous curvature from the first point to the last (the trailing edge is a corner), with
// centripetal parameters, which prevent oscillations between unevenly spaced points.
//
// Source: E. T. Y. Lee, Choosing nodes in parametric curve interpolation (1989).
#pragma once

#include <cstddef>
#include <vector>

namespace passo {

struct AirfoilPoint {
  double x = 0;
  double y = 0;
};

// Returns the given points with others between them, so that the chords are within the tolerance of the curve.
// `points`: at least three, of which no two neighbours are equal. There are at most 64 chords between two given points.
std::vector<AirfoilPoint> airfoil_spline(const std::vector<AirfoilPoint>& points, double tolerance);

}  // namespace passo
