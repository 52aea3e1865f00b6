// SplineSpan: one span of a rational B-spline between two knots, which is one Bézier curve. Private to geometry/.
//
// Everything is said by the polar form, or blossom (Ramshaw 1987; Goldman, Pyramid Algorithms, ch. 6): a function f of
// `degree` arguments, affine in each and the same in any order, with f(u, …, u) the curve. de Boor's pyramid works
// it out. f(a, …, a, b, …, b) are the control points of the stretch from a to b, and differences of f are derivatives.
//
// Points are homogeneous: x, y and z times the weight, and the weight.
#pragma once

#include <span>

#include "passo/geometry/weighted_point.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr int most_spline_degree = 9;

struct SplineSpan {
  int degree = 1;
  const WeightedPoint* points = nullptr;  // degree + 1
  const double* knots = nullptr;          // 2 degree: knots[degree - 1] < knots[degree] bound the span

  double low() const { return knots[degree - 1]; }
  double high() const { return knots[degree]; }

  Vector3 at(double u) const;
  Vector3 derivative(double u) const;
  Vector3 second_derivative(double u) const;
  // See ParametricCurve.
  Mm deviation(double from, double to) const;
};

// Never less than the distance of any point of the Bézier curve from the straight piece between its ends, and, to a few
// in a hundred, not more either.
double distance_from_chord(std::span<const WeightedPoint> control);

}  // namespace passo
