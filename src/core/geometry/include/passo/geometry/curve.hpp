// Curve: one geometric piece of a path. Its parameter is the length s to which the feed rate applies.
//
// s runs from 0 to length(). s is the travel of X Y Z in millimetres if any of them moves, otherwise that of U V W,
// otherwise that of A B C in degrees (RS274/NGC 2.1.2.5, "feed rate"). The other axes move in proportion. If an axis
// turns a cylinder of known radius, the travel of the surface counts like X, Y and Z (SurfaceScale).
//
// - A line moves every axis in proportion to s.
// - An arc rotates two axes of a plane about a centre and moves all others in proportion (helix). If the
//   radius at its end differs from the radius at its start (programs round their numbers), the radius changes in
//   proportion too, so that the arc meets both ends exactly.
// - A cubic is a piece of a smoothed path: every axis is a polynomial of s. Its parameter is nearly its length: |dP/ds|
//   falls below 1 in corners, and rises to 1.1 at most where the cubic smooths noise.
#pragma once

#include <array>

#include "passo/geometry/axes.hpp"
#include "passo/geometry/surface_scale.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Box {  // the range of each axis on a curve
  Point low;
  Point high;
};

class Curve {
 public:
  enum class Shape : std::uint8_t { line, arc, cubic };
  struct ArcData {
    Axis first = Axis::x;  // the plane's axes, in the order that makes counterclockwise positive
    Axis second = Axis::y;
    double first_center = 0;
    double second_center = 0;
    double start_radius = 0;
    double end_radius = 0;
    double start_angle = 0;  // in radians
    double sweep = 0;        // in radians, counterclockwise positive, including full turns
  };

  static Curve line(const Point& start, const Point& end, const SurfaceScale& surface = {});
  // Returns a cubic from `start` to `end` with the given dP/ds at its ends (Hermite). `length` is the range of the
  // parameter, above 0.
  static Curve cubic(const Point& start, const Point& start_tangent, const Point& end, const Point& end_tangent,
                     Mm length);
  // `sweep` is in radians and not zero.
  static Curve arc(const Point& start, const Point& end, Axis first, Axis second, double first_center,
                   double second_center, double sweep);
  // The same, with precomputed radii and start angle.
  static Curve arc(const Point& start, const Point& end, const ArcData& arc, const SurfaceScale& surface = {});

  // Returns the piece between two values of s as a separate curve, with the same points, tangents and second
  // derivatives. Its ends are bit-identical to at(from) and at(to).
  Curve part(Mm from, Mm to) const;
  // Returns the curve rotated about Z at the origin, by the angle with this cosine and sine. The plane of an arc must
  // be XY, or contain neither X nor Y.
  Curve turned(double cosine, double sine) const;
  // Returns the curve with the values of A, B and C multiplied by `by`. The parameter stays as it is.
  Curve with_turns_scaled(double by) const;

  Shape shape() const { return shape_; }
  const ArcData& arc_data() const { return arc_; }
  // The coefficients of a cubic: P = start + first s + second s² + third s³.
  struct CubicData {
    const Point& first;
    const Point& second;
    const Point& third;
  };
  CubicData cubic_data() const { return {slope_, square_, cube_}; }
  const Point& start() const { return start_; }
  const Point& end() const { return end_; }
  Mm length() const { return Mm(length_); }
  // Whether an axis moves by more than 1e-12 mm or degrees. A shorter curve is left by rounding: a motor does not
  // notice it, and no motion can be planned on it.
  bool has_length() const;

  Point at(Mm s) const;
  // dP/ds. If X, Y or Z moves, its part in X Y Z has length 1 (for a cubic: nearly 1).
  Point tangent(Mm s) const;
  // d²P/ds².
  Point second_derivative(Mm s) const;
  Point third_derivative(Mm s) const;
  // The largest |dP/ds| of each axis anywhere on the curve.
  Point steepest() const;
  // An upper bound of steepest(), computed without the trigonometry of an arc. Equal to it for a line.
  Point steepest_bound() const;
  // Whether the axis moves on the curve: its steepest() is above 0.
  bool moves(Axis axis) const { return slope_[axis] != 0 || (shape_ != Shape::line && bends(axis)); }
  // An upper bound of |d²P/ds²|. For an arc only its plane counts: 1/r times the square of the fraction of s in the
  // plane. For a cubic all axes count. 0 for a line.
  double curvature() const;
  // An upper bound of the total angle in radians by which the direction turns. If an axis that does not count for the
  // feed travels farther than s, the change of its slope counts, relative to its steepest slope. A cubic turns by a few
  // dozen radians at most.
  double turning() const { return turning(steepest()); }
  double turning(const Point& steepest) const;
  Box extents() const;
  // A box that contains extents(), computed without the trigonometry of an arc: from the full circle. Equal to it for a
  // line.
  Box bounds() const;
  // Returns the values of s between a cubic's ends where the axis reverses: at most two. A negative value means none.
  std::array<Mm, 2> turning_points(Axis axis) const;

 private:
  bool bends(Axis axis) const;
  Point steepest_of_cubic() const;
  Box extents_of_ends() const;
  void widen_by_turning_points(Box& box) const;

  Shape shape_ = Shape::line;
  Point start_;
  Point end_;
  Point slope_;  // (end − start) / length; for a cubic dP/ds at its start
  double length_ = 0;
  ArcData arc_;
  Point square_;  // a cubic's coefficients: P = start + slope s + square s² + cube s³
  Point cube_;
};

}  // namespace passo
