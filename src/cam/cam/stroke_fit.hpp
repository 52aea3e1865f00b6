// fit_strokes: joins the pieces of strokes that meet end to end, and replaces their points by lines and arcs within a
// tolerance. Private to cam/.
//
// An arc may be a helix: its height changes linearly along it. The ends of the joined strokes stay where they are.
#pragma once

#include <cstddef>
#include <vector>

#include "stroke_walk.hpp"

namespace passo {

struct StrokeFit {
  double tolerance_nm = 0;  // maximum distance in XY, plus `slope` times the distance in Z
  double slope = 0;         // of a V-bit: half of its width for its depth
};

// The points of the strokes are joined by lines. `nodes`: number of nodes; all node indices are smaller.
std::vector<CutterStroke> fit_strokes(std::vector<CutterStroke> strokes, std::size_t nodes, const StrokeFit& fit);

}  // namespace passo
