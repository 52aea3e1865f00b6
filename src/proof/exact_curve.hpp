// ExactCurve: place and derivatives of a curve, from its data alone and by formulas of its own.
//
// In the plane of an arc the place is c + r e^(iφ) with r' = g and φ' = w constant along s, and so
//   p' = (g + i r w) e^(iφ),   p'' = (2 i g w − r w²) e^(iφ),   p''' = −(3 g w² + i r w³) e^(iφ).
#pragma once

#include <complex>

#include "passo/geometry/curve.hpp"

namespace passo::proof {

// Of one axis, by s.
struct Derivatives {
  double first = 0;
  double second = 0;
  double third = 0;
};

class ExactCurve {
 public:
  explicit ExactCurve(const Curve& curve) : curve_(curve), turning_(turning_of_all()), fastest_(fastest_of_all()) {}

  double length() const { return curve_.length().value(); }
  bool is_line() const { return curve_.shape() == Curve::Shape::line; }
  Point place(double s) const;
  Derivatives at(Axis axis, double s) const;
  // By how many radians the direction turns over the whole curve, about; never too little for an arc.
  double turning() const { return turning_; }

  struct Nearest {
    double s = 0;
    double distance = 0;  // over all axes
  };
  // Of the part from..to.
  Nearest nearest(const Point& point, double from, double to) const;
  // No place of that part is nearer than this: a look that costs a tenth of the search.
  double nearest_at_best(const Point& point, double from, double to) const;

 private:
  double turning_of_all() const;
  double fastest_of_all() const;
  bool in_plane(Axis axis) const;
  Nearest nearest_of_bent(const Point& point, double from, double to) const;

  Curve curve_;
  double turning_;
  double fastest_;  // |dP/ds| over all axes is never more
};

double distance(const Point& a, const Point& b);

}  // namespace passo::proof
