// with_arcs: finds the arcs again that offsets have made chords of. Private to cam/.
//
// A row of three chords or more becomes an arc where all its points lie on one circle, each chord is as near to the
// circle as chords of an offset are, and the row turns one way by at most a half circle. So a polygon stays a polygon.
#pragma once

#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

struct ArcFit {
  double off_circle_nm = 300;    // how far a point may be from the circle
  double off_chord_nm = 10'000;  // how far the arc may be from its chords
};

// The last point of the answer is the last of the points.
std::vector<PathPoint> with_arcs(const std::vector<DrawnPoint>& points, const ArcFit& fit);

}  // namespace passo
