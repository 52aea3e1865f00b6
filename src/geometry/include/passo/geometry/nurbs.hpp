// Nurbs: a rational B-spline, the curve of drawing programs and of G5.2. Degree 1 to 9.
//
//     P(u) = sum of N_i(u) w_i control_i / sum of N_i(u) w_i;  N_i the B-spline basis of the knots (de Boor, Cox)
//
// n control points of degree p need n + p + 1 knots; u runs from knots[p] to knots[n]. Most often the first and the
// last p + 1 knots are equal ("clamped"): the curve then begins at the first control point and ends at the last.
// Between two knots it is one rational Bézier curve; these are the pieces that are cut.
//
// Points and derivatives cost O(p²) and no memory; bounds on the input keep a double good for the nanometre.
#pragma once

#include <vector>

#include "passo/geometry/parametric_curve.hpp"
#include "passo/geometry/weighted_point.hpp"

namespace passo {

struct SplineSpan;

class Nurbs {
 public:
  static constexpr int most_degree = 9;
  static constexpr double most_weight_ratio = 1e4;  // of the largest to the smallest

  struct Definition {
    int degree = 3;
    std::vector<Vector3> control = {};
    std::vector<double> weights = {};  // one a control point, above 0; none: all 1
    std::vector<double> knots = {};    // none: clamped, all spans 1 long
  };

  // Says what is wrong with a definition.
  static Result<Nurbs, CurveError> create(Definition definition);
  // What `create` fills in where there are no knots.
  static std::vector<double> clamped_knots(int degree, std::size_t control_points);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  ParameterRange range() const { return range_; }
  Vector3 at(double u) const;
  Vector3 derivative(double u) const;
  Vector3 second_derivative(double u) const;
  double next_break(double u) const;
  Mm deviation(double from, double to) const;
  bool is_even() const { return false; }

 private:
  Nurbs(const Definition& definition, std::vector<double> knots);
  // The span that holds u; a knot belongs to the span that it begins.
  SplineSpan span_of(double u) const;

  int degree_;
  std::vector<double> knots_;
  std::vector<WeightedPoint> points_;
  ParameterRange range_;
  Vector3 start_;
  Vector3 end_;
};

static_assert(ParametricCurve<Nurbs>);

}  // namespace passo
