// Bezier: a Bézier curve of degree 2 or 3; and the parabola, which is one of degree 2.
//
//     P(u) = sum of B_i(u) control_i,  u from 0 to 1;  B_i Bernstein's polynomials
//
// It begins at the first control point and ends at the last, and its ends point towards and from the others. Control
// points may coincide.
//
// Deviation from a chord: no point of a curve is farther from the chord than the farthest control point of that stretch
// (the curve lies in their hull), and halving the stretch brings the control points close to the curve.
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

// An arc of a parabola, in X Y at the vertex's Z. Every arc of a parabola is a quadratic Bézier and every quadratic
// Bézier one of a parabola, the middle control point being where the tangents at both ends meet; so this is another way
// to make one, by what a drawing or an optician tells: vertex and focus. Ends are given by how far they lie to the
// right of the axis, looking from the vertex to the focus: with d for that and f for the focal length, d² / (4 f) above
// the vertex.
Result<QuadraticBezier, CurveError> parabola(const Vector3& vertex, const Vector3& focus, Mm from, Mm to);

}  // namespace passo
