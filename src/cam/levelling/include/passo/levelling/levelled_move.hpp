// level_line, level_arc: apply a height map to a move: the height of the surface is added to the height of the move at
// every point.
//
// A move is divided only where necessary: at each point of the result, the height differs by at most `tolerance` from
// the intended height, which is the sum of the move's own height and the surface's. An arc stays an arc about the same
// centre, and a straight move stays straight in the XY plane.
//
//   z(t) = move(t) + map.height(x(t), y(t)),  t from 0 to 1 along the move
//
// Within a cell of the map, z(t) of a straight move is a parabola, and that of an arc has a bounded curvature, so the
// division needs no samples. Pieces are then merged as far as the tolerance allows: each of the two steps uses half of
// it.
//
// Cost: linear in the number of cells that the move passes, and of pieces.
#pragma once

#include <vector>

#include "passo/levelling/height_map.hpp"

namespace passo {

struct LevelPoint {
  double x = 0;  // mm, in the coordinates of the map
  double y = 0;
  double z = 0;
};

// The end of a piece. All other axes of the move have completed the fraction `part` of their travel.
struct LevelledPiece {
  LevelPoint end;
  double part = 1;  // above 0; 1 at the end of the move
};

// `from` and `to` are the programmed ends. Returns at least one piece, in order; the last one ends above `to`. A
// vertical move is one piece. `tolerance`: above 0.
std::vector<LevelledPiece> level_line(const HeightMap& map, const LevelPoint& from, const LevelPoint& to,
                                      double tolerance);

// Levels an arc in X and Y about (`center_x`, `center_y`), with Z in proportion (a helix). `sweep`: radians,
// counterclockwise positive, including full turns, not 0. Each piece is an arc about the same centre.
std::vector<LevelledPiece> level_arc(const HeightMap& map, const LevelPoint& from, const LevelPoint& to,
                                     double center_x, double center_y, double sweep, double tolerance);

}  // namespace passo
