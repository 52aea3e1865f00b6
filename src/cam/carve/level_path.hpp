// fit_level_path: few lines and arcs along a way at one height, free of gouges. Private to carve/.
//
// The points of the way lie on the edge of what is free: a chord from one to the other would cut a convex wall. So the
// way is moved by half of the tolerance to the free side first, which is the left one. Lines and arcs then stay within
// half of the tolerance of its points. Whether they are free of gouges is looked up in the map of the tip's heights
// for each of them, as it stands in the program; where one is not, however short, the tool goes over it.
#pragma once

#include <vector>

#include "level_lines.hpp"
#include "move_writer.hpp"
#include "node_run.hpp"

namespace passo {

struct LevelPathFit {
  double tolerance = 0.01;  // mm
  bool has_arcs = true;
  // Whether the points lie on the edge of what is free, and must be moved.
  bool is_on_edge = true;
  bool looks_for_gouges = true;
};

// Cuts that follow each other. Where the way is closed, the last one ends where the first one begins.
struct LevelPath {
  std::vector<CarvedCut> cuts = {};
  bool is_closed = false;

  double length() const;  // mm
};

// `height`: of the way. `surface`: the tip's heights that are free of gouges.
LevelPath fit_level_path(const LevelLine& line, double height, const TipSurface& surface, const NodeLattice& lattice,
                         const LevelPathFit& fit);

// Lines along a way that follows the surface where that is higher than `least`: nowhere below it, and at most
// `fit.tolerance` above what half a cell around each place asks for.
LevelPath fit_following_path(const LevelLine& line, double least, const TipSurface& surface, const NodeLattice& lattice,
                             const LevelPathFit& fit);

// The parts of a line all of whose points are wanted, but for gaps up to `gap` mm long. Parts shorter than `least` mm
// are left out, closed lines apart. A line that is wanted all around stays closed.
std::vector<LevelLine> parts_of(const LevelLine& line, const std::function<bool(const FlatPlace&)>& wants, double gap,
                                double least);

// The closed line from its point that is nearest to a place.
void begin_near(LevelLine& line, const FlatPlace& place);

inline double distance_between(const FlatPlace& a, const FlatPlace& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace passo
