// The shapes that apertures of a Gerber file have, as rings of chords. Private to cam/.
//
// Rings are counterclockwise. The points of a curve lie on it, and its chords at most `gerber_tolerance` inside.
// Lengths are nanometres; they are doubles where they are not yet rounded.
#pragma once

#include <cstddef>

#include "passo/cam/region.hpp"

namespace passo {

inline constexpr Nanometres gerber_tolerance{500};

struct Offset {  // a place before it is rounded, nm
  double x = 0;
  double y = 0;
};

DrawnPoint rounded(Offset place);
Offset turned(Offset place, double radians);
inline DrawnPoint moved(DrawnPoint point, DrawnPoint by) {
  return {point.x + by.x, point.y + by.y};
}
DrawnRing moved(DrawnRing ring, DrawnPoint by);
// About zero.
DrawnRing turned(DrawnRing ring, double radians);

// How many chords an arc of this radius needs for this angle (radians, any sign); at least 1.
std::size_t chords_of_arc(double radius, double angle);

DrawnRing disc_ring(Offset centre, double diameter);
DrawnRing rectangle_ring(Offset centre, double across, double up);
DrawnRing obround_ring(double across, double up);
// The first corner is at `radians` from the X axis.
DrawnRing regular_ring(Offset centre, double diameter, std::size_t corners, double radians);
// A line with flat ends. Empty: it has no length.
DrawnRing bar_ring(Offset from, Offset to, double width);

// The smallest convex ring around all points.
DrawnRing hull_of(const std::vector<DrawnRing>& rings);
// What a convex ring about zero covers on its way along a line.
DrawnRing convex_swept(const DrawnRing& convex, DrawnPoint from, DrawnPoint to);

// An arc about `centre`, which turns by `sweep` radians, above 0 counterclockwise. If the ends are not at one distance
// from the centre, the distance changes evenly.
struct GerberArc {
  DrawnPoint from = {};
  DrawnPoint to = {};
  Offset centre = {};
  double sweep = 0;
};
// Adds the chords' ends, without the first.
void append_arc(const GerberArc& arc, std::vector<DrawnPoint>& points);

}  // namespace passo
