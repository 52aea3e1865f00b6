// cubics_through: the smooth curve through given points. Private to cam/.
//
// The curve consists of one cubic for each pair of neighbouring points, with equal first and second derivatives where
// two cubics meet. At an open end it has the given direction, or no curvature (a natural end). Time and memory are
// proportional to the number of points.
//
// Source: de Boor, A Practical Guide to Splines, 2001, ch. IV.
#pragma once

#include <array>
#include <vector>

namespace passo {

struct FitPoint {
  double x = 0;
  double y = 0;
};

struct FitSpline {
  std::vector<FitPoint> points = {};
  bool is_closed = false;
  // The parameter interval of a cubic is its chord length to this power: 1: chord length, 0.5: centripetal, 0: uniform.
  double exponent = 1;
  FitPoint start = {};  // direction at an end; (0, 0): a natural end
  FitPoint end = {};
};

using CubicPiece = std::array<FitPoint, 4>;  // the control points of a Bezier curve

// Returns the cubics; none if there are fewer than two different points. Equal neighbours count as one point.
std::vector<CubicPiece> cubics_through(const FitSpline& spline);

}  // namespace passo
