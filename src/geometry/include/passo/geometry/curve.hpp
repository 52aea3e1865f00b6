// Curve: one geometric piece of a path, parametrised by the length s that the feed counts.
//
// s runs from 0 to length(). It is millimetres of X Y Z travel where any of those move, else of U V W, else degrees
// of A B C (RS274/NGC 2.1.2.5, "feed rate"); the other axes move along in proportion.
//
// A line moves every axis in proportion to s. An arc turns two axes of a plane about a centre and moves all others in
// proportion (helix); where the radius at its end differs from that at its start (programs round their numbers) the
// radius grows in proportion too, so that both ends are met exactly.
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
  enum class Shape : std::uint8_t { line, arc };
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
  // `sweep` in radians, not zero.
  static Curve arc(const Point& start, const Point& end, Axis first, Axis second, double first_center,
                   double second_center, double sweep);

  Shape shape() const { return shape_; }
  const ArcData& arc_data() const { return arc_; }
  const Point& start() const { return start_; }
  const Point& end() const { return end_; }
  Mm length() const { return Mm(length_); }
  bool has_length() const { return length_ > 0; }

  Point at(Mm s) const;
  // dP/ds: a unit vector in X Y Z where those move.
  Point tangent(Mm s) const;
  // The largest |dP/ds| of each axis anywhere on the curve.
  Point steepest() const;
  // 1/r of the projection on the arc's plane, per mm of s squared: |d²P/ds²| in the plane; 0 for a line.
  double curvature() const;
  Box extents() const;

 private:
  Shape shape_ = Shape::line;
  Point start_;
  Point end_;
  Point slope_;  // (end − start) / length
  double length_ = 0;
  ArcData arc_;
};

}  // namespace passo
