// MonotoneCurve: a smooth curve through points. It rises or falls only where the points do.
//
// A torque curve from a data sheet has only a few points. A cubic spline through them overshoots, and gives torque that
// was never measured. Here each piece is a cubic whose slopes at the points are limited, so that the piece stays
// between its two ends. The curve and its slope are continuous. Outside the points the curve keeps the first and the
// last value. The numbers are plain doubles: the caller knows the quantities x and y, and how to use values outside the
// points.
//
// Source: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer. Anal. 17 (1980). The
// slopes: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), known as PCHIP.
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
  // Needs at least two points, x ascending, all numbers finite.
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
