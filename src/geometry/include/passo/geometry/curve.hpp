// Curve: one geometric piece of a path, parametrised by the length s that the feed counts.
//
// s runs from 0 to length(). It is millimetres of X Y Z travel where any of those move, else of U V W, else degrees
// of A B C (RS274/NGC 2.1.2.5, "feed rate"); the other axes move along in proportion.
//
// A line moves every axis in proportion to s. An arc turns two axes of a plane about a centre and moves all others in
// proportion (helix); where the radius at its end differs from that at its start (programs round their numbers) the
// radius grows in proportion too, so that both ends are met exactly. A cubic is a piece of a smoothed path: every axis
// a polynomial of s, whose parameter is nearly its length: |dP/ds| falls below 1 in corners, and rises to
// 1.1 at most where it smooths noise.
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Box {  // what a curve covers, an axis at a time
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
    double start_angle = 0;  // radians
    double sweep = 0;        // radians, counterclockwise positive, whole turns included
  };

  static Curve line(const Point& start, const Point& end);
  // From `start` to `end` with the given dP/ds there (Hermite); `length` of the parameter, above 0.
  static Curve cubic(const Point& start, const Point& start_tangent, const Point& end, const Point& end_tangent,
                     Mm length);
  // `sweep` in radians, not zero.
  static Curve arc(const Point& start, const Point& end, Axis first, Axis second, double first_center,
                   double second_center, double sweep);

  // The piece from one s to another, as a curve of its own: the same places, tangents and second derivatives. Its
  // ends are at(from) and at(to), bit for bit.
  Curve part(Mm from, Mm to) const;

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
  bool has_length() const { return length_ > 0; }

  Point at(Mm s) const;
  // dP/ds: a unit vector in X Y Z where those move.
  Point tangent(Mm s) const;
  // d²P/ds².
  Point second_derivative(Mm s) const;
  Point third_derivative(Mm s) const;
  // The largest |dP/ds| of each axis anywhere on the curve.
  Point steepest() const;
  // 1/r of the projection on the arc's plane, per mm of s squared: |d²P/ds²| in the plane, at most; 0 for a
  // line, and for a cubic the largest |d²P/ds²| over all axes.
  double curvature() const;
  // By how many radians the direction turns, all turns counted: at most, and of an axis that goes farther than the feed
  // counts, the change of its slope as a part of the steepest. Of a cubic never more than some dozens.
  double turning() const { return turning(steepest()); }
  double turning(const Point& steepest) const;
  Box extents() const;

 private:
  Point steepest_of_cubic() const;
  void widen_by_turning_points(Box& box) const;

  Shape shape_ = Shape::line;
  Point start_;
  Point end_;
  Point slope_;  // (end − start) / length; of a cubic dP/ds at its start
  double length_ = 0;
  ArcData arc_;
  Point square_;  // of a cubic: P = start + slope s + square s² + cube s³
  Point cube_;
};

}  // namespace passo
