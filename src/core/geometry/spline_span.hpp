// SplineSpan: one span of a rational B-spline between two knots, itself one Bézier curve. Private to geometry/.
//
// All functions use the polar form, or blossom (Ramshaw 1987; Goldman, Pyramid Algorithms, ch. 6). It is a function f
// of `degree` arguments, affine in each and symmetric; f(u, …, u) is the curve. de Boor's pyramid computes f. The
// control points of the section from a to b are f(a, …, a, b, …, b), and differences of f are derivatives.
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
  const double* knots = nullptr;          // 2 degree knots: knots[degree - 1] < knots[degree] bound the span

  double low() const { return knots[degree - 1]; }
  double high() const { return knots[degree]; }

  Vector3 at(double u) const;
  Vector3 derivative(double u) const;
  Vector3 second_derivative(double u) const;
  // See ParametricCurve.
  Mm deviation(double from, double to) const;
};

// Returns an upper bound of the distance between any point of the Bézier curve and the line segment between its ends.
// It exceeds the true distance by a few per cent at most.
double distance_from_chord(std::span<const WeightedPoint> control);

}  // namespace passo
