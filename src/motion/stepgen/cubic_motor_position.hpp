// CubicMotorPosition: the position of one motor on a cubic as a polynomial of s, and its inverse: the s at which the
// motor is at a position.
//
// Between the roots of its derivative the polynomial is monotone. There it has the form of motion at constant jerk,
// with s instead of the time, and is inverted as such (units/constant_jerk.hpp): by Newton's method, starting from an
// extrapolation of the last event, inside the bracket between the turning points. One or two iterations find a crossing
// to 0.01 position units; this takes about 30 ns, and 5 ns if several near crossings are found at once.
#pragma once

#include <limits>

#include "lanes.hpp"
#include "place.hpp"

#include "passo/geometry/curve.hpp"
#include "passo/units/constant_jerk.hpp"

namespace passo {

// a + b s + c s²
struct Parabola {
  double a = 0;
  double b = 0;
  double c = 0;

  double at(double s) const { return a + s * (b + s * c); }
  // Returns the first s >= from at which the parabola is or becomes positive. Infinity if there is none.
  double above_zero(double from) const;
};

class CubicMotorPosition {
 public:
  CubicMotorPosition() = default;
  // Valid for 0 <= s <= `end`.
  CubicMotorPosition(const Curve& curve, const MotorRow& motor, double end);

  double at(double s) const { return base_ + s * (first_ + s * (second_ + s * third_)); }
  double slope(double s) const { return first_ + s * (2 * second_ + s * 3 * third_); }
  // The slope as a polynomial.
  Parabola slope() const { return {first_, 2 * second_, 3 * third_}; }
  // Whether the position rises just after `s`, even at a turning point.
  bool rises(double s) const { return at(next_end(s)) > at(s); }

  // As in MotorPath.
  double crossing(double target, double from) const;
  std::size_t look_ahead(double target, double step, double from, Lanes& s) const;
  double turning_point(double from) const { return next_turn(from) + behind_turn_; }
  double travel(double distance, double from) const;

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double next_turn(double from) const {
    return first_turn_ > from ? first_turn_ : second_turn_ > from ? second_turn_ : infinity;
  }
  double next_end(double from) const { return std::min(next_turn(from), end_); }

  // position = base + first s + second s² + third s³.
  double base_ = 0;
  double first_ = 0;
  double second_ = 0;
  double third_ = 0;
  double end_ = 0;
  // The points between 0 and the end where the slope is 0. Infinity if there is none.
  double first_turn_ = infinity;
  double second_turn_ = infinity;
  double behind_turn_ = 0;  // at this distance after a turning point, s is certainly past it, and the position has
                            // hardly changed
};

}  // namespace passo
