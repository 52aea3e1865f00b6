// Ellipse: an arc of an ellipse, or one or more full turns of an ellipse, anywhere in space and in either sense.
//
//     P = centre + major cos t + minor sin t,       t = start + u sweep,  u from 0 to 1
//
// `major` and `minor` are the perpendicular semi-axes. t is the eccentric angle, not the polar angle: the ellipse is
// the projection of a circle, and t is the angle on that circle.
//
// Deviation from the chord over t = m - d … m + d: arc and chord are projections of a circle's arc and chord. The chord
// lies parallel to the tangent at m, and the farthest point is P(m), at |major| |minor| / |dP/dt (m)| times (1 - cos
// d). This is exact unless the arc extends beyond an end of the chord; then that extent is included (ellipse.cpp).
#pragma once

#include "passo/geometry/parametric_curve.hpp"

namespace passo {

class Ellipse {
 public:
  struct Shape {
    Vector3 centre;
    Vector3 major = {1, 0, 0};
    Vector3 minor = {0, 1, 0};
    Radians start = {0};
    Radians sweep = {0};  // not zero; positive turns from major to minor
  };

  static Result<Ellipse, CurveError> create(const Shape& shape);
  // Returns an ellipse in a plane of constant Z. Its first semi-axis is rotated from X by `rotation`; positive angles
  // are counterclockwise.
  static Result<Ellipse, CurveError> flat(const Vector3& centre, Mm first_radius, Mm second_radius, Radians rotation,
                                          Radians start, Radians sweep);

  const Shape& shape() const { return shape_; }
  ParameterRange range() const { return {}; }
  Vector3 at(double u) const;
  Vector3 derivative(double u) const;
  Vector3 second_derivative(double u) const;
  double next_break(double /*u*/) const { return 1; }
  Mm deviation(double from, double to) const;
  bool is_even() const { return is_circle_; }

 private:
  explicit Ellipse(const Shape& shape);

  Shape shape_;
  bool is_circle_ = false;
};

static_assert(ParametricCurve<Ellipse>);

}  // namespace passo
