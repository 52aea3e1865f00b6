// The shapes of Gerber apertures, as rings of chords. Private to cam/.
//
// Rings are counterclockwise. The vertices lie on the curve; chords deviate from it by at most `gerber_tolerance`,
// always inward. Lengths are in nanometres, as doubles until they are rounded.
#pragma once

#include <cstddef>

#include "passo/cam/region.hpp"

namespace passo {

inline constexpr Nanometres gerber_tolerance{500};

struct Offset {  // a point before rounding, nm
  double x = 0;
  double y = 0;
};

inline Offset offset_of(DrawnPoint point) {
  return {static_cast<double>(point.x.count), static_cast<double>(point.y.count)};
}
DrawnPoint rounded(Offset place);
Offset turned(Offset place, double radians);
inline DrawnPoint moved(DrawnPoint point, DrawnPoint by) {
  return {point.x + by.x, point.y + by.y};
}
DrawnRing moved(DrawnRing ring, DrawnPoint by);
// Rotates the ring about the origin.
DrawnRing turned(DrawnRing ring, double radians);

// Returns the number of chords that an arc of this radius and angle (radians, any sign) needs; at least 1.
std::size_t chords_of_arc(double radius, double angle);

DrawnRing disc_ring(Offset centre, double diameter);
DrawnRing rectangle_ring(Offset centre, double across, double up);
DrawnRing obround_ring(double across, double up);
// Returns a regular polygon. The first corner is at `radians` from the X axis.
DrawnRing regular_ring(Offset centre, double diameter, std::size_t corners, double radians);
// Returns a line with flat ends as a ring. Empty if the length is zero.
DrawnRing bar_ring(Offset from, Offset to, double width);

// Returns the convex hull of all points.
DrawnRing hull_of(const std::vector<DrawnRing>& rings);
// Returns the area that a convex ring about the origin sweeps along a line.
DrawnRing convex_swept(const DrawnRing& convex, DrawnPoint from, DrawnPoint to);

// An arc about `centre` that sweeps `sweep` radians; positive is counterclockwise. If the end points differ in their
// distance from the centre, the radius changes linearly.
struct GerberArc {
  DrawnPoint from = {};
  DrawnPoint to = {};
  Offset centre = {};
  double sweep = 0;
};
// Appends the end points of the chords, without the first point.
void append_arc(const GerberArc& arc, std::vector<DrawnPoint>& points);

}  // namespace passo
