// edge_loops: the closed lines of a board's edge drawing, whatever pieces they are drawn in.
//
// Closed paths and circles are loops. Open paths are joined end to end: the two nearest free ends first, no two that
// are farther apart than `join`. Paths that are drawn twice count once.
#pragma once

#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct EdgeLoops {
  std::vector<std::vector<PathPoint>> loops = {};  // the last point leads back to the first
  std::size_t joined = 0;                          // ends that did not meet, and were joined
  Nanometres widest_joined = {};
};

// An end that meets no other is an error "outline.open" in `diagnostics`.
EdgeLoops edge_loops(const Drawing& drawing, Nanometres join, Diagnostics& diagnostics);

// The board inside the loops: a loop in another one is an opening, a loop in an opening is board again.
Region board_within(const EdgeLoops& loops);

// The points of a path on chords within the tolerance; the last of a closed path is not the first.
DrawnRing chords_of_path(const std::vector<PathPoint>& points, bool is_closed, Nanometres tolerance);

}  // namespace passo
