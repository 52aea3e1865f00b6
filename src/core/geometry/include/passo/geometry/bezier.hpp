// Bezier: a Bézier curve of degree 2 or 3. A parabola is one of degree 2.
//
//     P(u) = sum of B_i(u) control_i,  u from 0 to 1;  B_i are Bernstein's polynomials
//
// The curve begins at the first control point and ends at the last. At each end its tangent points along the line to
// the neighbouring control point. Control points may coincide.
//
// Deviation from a chord: a section of the curve lies in the convex hull of its control points, so no point of the
// section is farther from the chord than the farthest control point. Halving the section brings its control points
// close to the curve.
#pragma once

#include <array>

#include "passo/geometry/parametric_curve.hpp"

namespace passo {

template <std::size_t degree>
class Bezier {
 public:
  using Control = std::array<Vector3, degree + 1>;
  static Result<Bezier, CurveError> create(const Control& control);

  const Control& control() const { return control_; }
  ParameterRange range() const { return {}; }
  Vector3 at(double u) const;
  Vector3 derivative(double u) const;
  Vector3 second_derivative(double u) const;
  double next_break(double /*u*/) const { return 1; }
  Mm deviation(double from, double to) const;
  bool is_even() const { return false; }

 private:
  explicit Bezier(const Control& control) : control_(control) {}

  Control control_;
};

using QuadraticBezier = Bezier<2>;
using CubicBezier = Bezier<3>;
extern template class Bezier<2>;
extern template class Bezier<3>;

static_assert(ParametricCurve<QuadraticBezier> && ParametricCurve<CubicBezier>);

// Returns an arc of a parabola in the XY plane, at the vertex's Z, defined by vertex and focus. The arcs of parabolas
// are exactly the quadratic Bézier curves; the middle control point is the intersection of the end tangents. `from` and
// `to` are the distances of the ends to the right of the axis, seen from the vertex to the focus. At distance d from
// the axis and with the focal length f the parabola is d² / (4 f) above the vertex.
Result<QuadraticBezier, CurveError> parabola(const Vector3& vertex, const Vector3& focus, Mm from, Mm to);

}  // namespace passo
