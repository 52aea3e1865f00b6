// with_arcs: recovers arcs from the chords that offsetting produced. Private to cam/.
//
// A sequence of three or more chords becomes an arc if all its points lie on one circle and it turns in one direction
// by at most a half circle. Each chord must be close to the circle. In the direction in which an offset rounds corners,
// a chord may also deviate from the circle as much as an offset's chords do, provided that the chords have equal length
// (the first and last chord may be shorter, or up to half as long again). The sides of a polygon therefore stay
// straight.
#pragma once

#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

struct ArcFit {
  double off_circle_nm = 300;    // maximum distance of a point from the circle
  double near_chord_nm = 1'000;  // maximum distance of the arc from any chord
  double even_chord_nm = 0;      // maximum distance of the arc from the chords of an offset
  int rounded_turn = 0;          // direction in which the offset rounds corners: 1 left, -1 right
};

// Returns the points joined by lines and arcs. The last point stays the same.
std::vector<PathPoint> with_arcs(const std::vector<DrawnPoint>& points, const ArcFit& fit);

}  // namespace passo
