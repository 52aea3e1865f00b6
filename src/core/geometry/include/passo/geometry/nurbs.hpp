// Nurbs: a rational B-spline of degree 1 to 9, as used by drawing programs and G5.2.
//
//     P(u) = sum of N_i(u) w_i control_i / sum of N_i(u) w_i;  N_i is the B-spline basis of the knots (de Boor, Cox)
//
// n control points of degree p need n + p + 1 knots; u runs from knots[p] to knots[n]. Usually the first p + 1 knots
// are equal, and the last p + 1 too ("clamped"): the curve then begins at the first control point and ends at the last.
// Between two knots the curve is one rational Bézier curve; these pieces are cut into chords.
//
// Points and derivatives cost O(p²) and no memory. Bounds on the input keep the error of doubles below a nanometre.
#pragma once

#include <vector>

#include "passo/geometry/parametric_curve.hpp"
#include "passo/geometry/weighted_point.hpp"

namespace passo {

struct SplineSpan;

class Nurbs {
 public:
  static constexpr int most_degree = 9;
  static constexpr double most_weight_ratio = 1e4;  // the largest weight over the smallest

  struct Definition {
    int degree = 3;
    std::vector<Vector3> control = {};
    std::vector<double> weights = {};  // one for each control point, above 0; empty: all are 1
    std::vector<double> knots = {};    // empty: clamped, all spans of length 1
  };

  // Fails with a message if the definition is wrong.
  static Result<Nurbs, CurveError> create(Definition definition);
  // Returns the knots that `create` uses if none are given.
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
  // Returns the span that contains u. A knot belongs to the span that starts there.
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
