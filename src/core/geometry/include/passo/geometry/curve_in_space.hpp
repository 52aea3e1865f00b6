// CurveInSpace: a line, arc or helix of Curve as a ParametricCurve in X Y Z. u is Curve's own s, the length in mm.
//
// For the other axes, use curve().at(u).
//
// Deviation of an arc or helix of radius r from a chord over the angle 2d, exactly: the sagitta r (1 - cos d), which is
// r - sqrt(r² - L²/4) for the chord's length L in the plane. On a helix it is the same, whatever the pitch. Measured
// from the chord's middle, the difference between curve and chord at the same angle f is
//
//     r (cos f - cos d, sin f - f sin d / d, 0),
//
// The pitch cancels, and this vector is longest at f = 0 for every d up to a half turn. Where the radius grows by g mm
// per radian (programs round their numbers), the part g f (cos f, sin f) adds at most g d² sqrt(4 + d²) / 2, which is
// h²/8 times the greatest second derivative.
#pragma once

#include "passo/geometry/curve.hpp"
#include "passo/geometry/parametric_curve.hpp"

namespace passo {

class CurveInSpace {
 public:
  // Fails for an arc whose plane is outside X Y Z, and for coordinates beyond the limit.
  static Result<CurveInSpace, CurveError> of(const Curve& curve);

  const Curve& curve() const { return curve_; }
  ParameterRange range() const { return {0, curve_.length().value()}; }
  Vector3 at(double u) const { return Vector3::of(curve_.at(Mm(u))); }
  Vector3 derivative(double u) const { return Vector3::of(curve_.tangent(Mm(u))); }
  Vector3 second_derivative(double u) const;
  double next_break(double /*u*/) const { return curve_.length().value(); }
  Mm deviation(double from, double to) const;
  bool is_even() const;

 private:
  explicit CurveInSpace(const Curve& curve) : curve_(curve) {}

  Curve curve_;
};

static_assert(ParametricCurve<CurveInSpace>);

}  // namespace passo
