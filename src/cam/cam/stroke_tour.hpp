// tour_strokes: converts lines that meet at nodes to runs of a cutter that stays down where possible: from the end of a
// branch it returns along the groove that it has just carved. Private to cam/.
//
// The branches of the returns are chosen so that all returns and lifts together are as short as possible: on trees
// exactly (by dynamic programming), on rings along their shortest lines only. The tour of the lines and the returns is
// an Euler path that goes straight on where possible.
//
// Source: C. Hierholzer, Über die Möglichkeit, einen Linienzug ohne Wiederholung und ohne Unterbrechung zu umfahren
// (1873); J. Edmonds, E. L. Johnson, Matching, Euler tours and the Chinese postman (1973).
#pragma once

#include <cstddef>
#include <vector>

#include "stroke_walk.hpp"

namespace passo {

struct StrokeTour {
  DrawnPoint park = {};
  double lift_nm = 0;  // length of a return that takes as long as a lift
};

// Returns the runs. Runs of connected strokes follow each other. `nodes`: number of nodes; all node indices are
// smaller.
std::vector<MillRun> tour_strokes(const std::vector<CutterStroke>& strokes, std::size_t nodes, const StrokeTour& tour);

}  // namespace passo
