// MonotoneCurve: a smooth curve through points that goes up or down only where the points do.
//
// A torque curve from a data sheet is a handful of points. A cubic spline through them overshoots: it would promise
// torque that nobody measured. Here each piece is a cubic whose slopes at the points are held back so far that it stays
// between its two ends; the curve and its slope are continuous. Outside the points it keeps the first and the last
// value. Plain numbers: what x and y mean, and what a value outside is worth, is the caller's.
//
// Source: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer. Anal. 17 (1980); the
// slopes by F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), known as PCHIP.
#pragma once

#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

struct CurvePoint {
  double x = 0;
  double y = 0;
};

struct CurvePointsError {
  std::string message;
};

class MonotoneCurve {
 public:
  // At least two points with x ascending, all of them finite.
  static Result<MonotoneCurve, CurvePointsError> through(std::vector<CurvePoint> points);

  double at(double x) const;
  const std::vector<CurvePoint>& points() const { return points_; }
  double first() const { return points_.front().x; }
  double last() const { return points_.back().x; }

 private:
  explicit MonotoneCurve(std::vector<CurvePoint> points);

  std::vector<CurvePoint> points_;
  std::vector<double> slopes_;  // dy/dx at each point
};

}  // namespace passo
