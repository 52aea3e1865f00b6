// fit_level_path: approximates a toolpath at constant height by few lines and arcs, free of gouges. Private to carve/.
//
// The points of the toolpath lie on the boundary of the free area, where a chord between two points would cut a convex
// wall. Therefore the toolpath is first moved by half of the tolerance to the free side, which is the left one. Lines
// and arcs then stay within half of the tolerance of its points; along walls, whose position a map knows to one of its
// cells only, within a cell. Each line and arc, as rounded for the program, is checked against the map of gouge-free
// tip heights; if even the shortest one gouges, the tool is lifted over it.
#pragma once

#include <vector>

#include "level_lines.hpp"
#include "move_writer.hpp"
#include "node_run.hpp"

namespace passo {

struct LevelPathFit {
  double tolerance = 0.01;  // mm
  bool has_arcs = true;
  // Whether the points lie on the boundary of the free area, so that they must be moved.
  bool is_on_edge = true;
  bool looks_for_gouges = true;
  // Of a path that follows the surface: how many places of each cell it is measured at.
  double places_of_cell = 2;
};

// Consecutive cuts. If the toolpath is closed, the last one ends where the first one begins.
struct LevelPath {
  std::vector<CarvedCut> cuts = {};
  bool is_closed = false;

  double length() const;  // mm
};

// `height`: of the toolpath. `surface`: the gouge-free tip heights.
LevelPath fit_level_path(const LevelLine& line, double height, const TipSurface& surface, const NodeLattice& lattice,
                         const LevelPathFit& fit);

// Fits lines along a toolpath that follows the surface wherever the surface is higher than `least`: nowhere below the
// surface, and at most `fit.tolerance` above its maximum within a part of a cell (`places_of_cell`) of each point.
LevelPath fit_following_path(const LevelLine& line, double least, const TipSurface& surface, const NodeLattice& lattice,
                             const LevelPathFit& fit);

// Returns the parts of a line whose points are all wanted, bridging gaps of up to `gap` mm. Drops open parts shorter
// than `least` mm. A line that is wanted all around stays closed.
std::vector<LevelLine> parts_of(const LevelLine& line, const std::function<bool(const FlatPlace&)>& wants, double gap,
                                double least);

// Rotates the points of a closed line so that it begins at the one nearest to `place`.
void begin_near(LevelLine& line, const FlatPlace& place);

inline double distance_between(const FlatPlace& a, const FlatPlace& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace passo
