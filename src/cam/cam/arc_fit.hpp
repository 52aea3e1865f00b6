// with_arcs: finds the arcs again that offsets have made chords of. Private to cam/.
//
// A row of three chords or more becomes an arc where all its points lie on one circle, and the row turns one way by at
// most a half circle. Each chord must be near to the circle. Where the row turns the way in which an offset rounds
// corners, chords may also be as far from the circle as those of the offset, if they are of one length (the first and
// the last of an offset's chords may be shorter, or half as long again). So a side of a polygon stays straight.
#pragma once

#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

struct ArcFit {
  double off_circle_nm = 300;    // how far a point may be from the circle
  double near_chord_nm = 1'000;  // how far the arc may be from any chord
  double even_chord_nm = 0;      // and from the chords of an offset
  int rounded_turn = 0;          // the way in which the offset rounds corners: 1 left, -1 right
};

// The last point of the answer is the last of the points.
std::vector<PathPoint> with_arcs(const std::vector<DrawnPoint>& points, const ArcFit& fit);

}  // namespace passo
