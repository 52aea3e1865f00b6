// ExactCurve: position and derivatives of a curve, computed only from its data and by independent formulas.
//
// In the plane of an arc the position is c + r e^(iφ), where r' = g and φ' = w are constant along s. So
//   p' = (g + i r w) e^(iφ),   p'' = (2 i g w − r w²) e^(iφ),   p''' = −(3 g w² + i r w³) e^(iφ).
#pragma once

#include <array>
#include <complex>
#include <span>

#include "passo/geometry/curve.hpp"

namespace passo::proof {

// Derivatives of one axis by s.
struct Derivatives {
  double first = 0;
  double second = 0;
  double third = 0;
};

class ExactCurve {
 public:
  explicit ExactCurve(const Curve& curve)
      : curve_(curve), turning_(turning_of_all()), fastest_(fastest_of_all()), circles_(is_circle()) {}

  double length() const { return curve_.length().value(); }
  bool is_line() const { return curve_.shape() == Curve::Shape::line; }
  bool is_cubic() const { return curve_.shape() == Curve::Shape::cubic; }
  bool moves(Axis axis) const;
  Point place(double s) const;
  Derivatives at(Axis axis, double s) const;
  // The same for several axes; for an arc cheaper than one by one.
  using AllDerivatives = std::array<Derivatives, axis_count>;
  AllDerivatives at(std::span<const Axis> axes, double s) const;
  bool in_plane(Axis axis) const;  // of an arc
  // The sizes of an arc's derivatives in its plane.
  Derivatives sizes_in_plane(double s) const;
  // Returns approximately the angle by which the direction turns over the whole curve, in radians, and the change of
  // the logarithm of |dP/ds|. For an arc never too small.
  double turning() const { return turning_; }

  // Returns an upper bound of |dP/ds|: 1, or nearly 1, where s is the length to which the feed applies.
  double feed_factor() const;

  struct Nearest {
    double s = 0;
    double distance = 0;  // over all axes
  };
  // Returns the nearest point in the part from..to. A degree of A, B or C counts as `degree` millimetres.
  Nearest nearest(const Point& point, double from, double to, double degree = 1) const;
  // A lower bound of that distance, for a tenth of the search's cost.
  double nearest_at_best(const Point& point, double from, double to, double degree = 1) const;

 private:
  double turning_of_all() const;
  double fastest_of_all() const;
  Point slope(double s) const;  // dP/ds of a cubic
  struct Local {
    Point place;
    AllDerivatives slopes{};  // of all axes
  };
  Local local(double s) const;
  bool is_circle() const;
  Nearest nearest_of_circle(const Point& point, double from, double to, double degree) const;
  Nearest nearest_of_bent(const Point& point, double from, double to, double degree) const;

  Curve curve_;
  double turning_;
  double fastest_;  // an upper bound of |dP/ds| over all axes
  bool circles_;    // an arc of constant radius without motion outside its plane
};

// A degree of A, B or C counts as `degree` millimetres.
double distance(const Point& a, const Point& b, double degree = 1);

}  // namespace passo::proof
