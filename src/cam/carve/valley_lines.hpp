// valley_lines: traces the inner edges of a relief, for pencil passes. Private to carve/.
//
// Where a cutter touches two faces at once, the map of its tip heights has a valley: seen along a line across it, the
// slope rises abruptly, by at least `least_bend`. A node belongs to a valley if this bend is larger there than at the
// nodes on both sides. Such nodes are joined to lines. Each point of a line is then moved across the valley to the
// place where the map, seen along the bisector of both slopes, is lowest; and away from a wall, so that the line does
// not climb it between two points.
//
// The idea of keeping the maxima across a line is that of J. Canny, A computational approach to edge detection (1986).
#pragma once

#include <functional>
#include <vector>

#include "level_lines.hpp"

namespace passo {

struct ValleySearch {
  Radians least_bend{0.35};  // 20 degrees: two faces that meet at 160 degrees or less
  double least_length = 0;   // mm; shorter lines are dropped
  // Whether the cutter has work at a place.
  std::function<bool(const FlatPlace&)> wants = {};
};

// `surface`: the gouge-free tip heights. The direction of a line has no meaning.
std::vector<LevelLine> valley_lines(const TipSurface& surface, const ValleySearch& search);

}  // namespace passo
