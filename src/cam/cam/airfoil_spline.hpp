// airfoil_spline: a smooth curve through the points of an airfoil, as chords. Private to cam/.
//
// A cubic spline with continuous curvature from the first point to the last (the trailing edge is a corner), with
// centripetal parameters, which keep it from swinging between points that are unevenly spaced.
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

// Returns the given points and others between them, so that chords are within the tolerance of the curve. `points`: at
// least three, no two successive ones equal. At most 64 chords replace one.
std::vector<AirfoilPoint> airfoil_spline(const std::vector<AirfoilPoint>& points, double tolerance);

}  // namespace passo
