// level_line, level_arc: a move as it is on a surface that is not flat: the height of the surface is added to the
// height of the move, everywhere.
//
// A move is divided where it must be, and only there: at each place of the result its height differs by no more than
// `tolerance` from the height that was meant, the move's own and the surface's below it. An arc stays an arc about the
// same centre, and a straight move stays straight, seen from above.
//
//   z(t) = move(t) + map.height(x(t), y(t)),  t from 0 to 1 along the move
//
// Within a cell of the map z(t) of a straight move is a parabola, and that of an arc has a bound of its curvature. So
// the division needs no samples. Pieces are then joined again as long as the tolerance allows it: half of it is for
// either.
//
// Cost: linear in the number of cells that the move passes, and of pieces.
#pragma once

#include <vector>

#include "passo/levelling/height_map.hpp"

namespace passo {

struct LevelPlace {
  double x = 0;  // mm, in the coordinates of the map
  double y = 0;
  double z = 0;
};

// The end of a piece. All other axes of the move have come by `part` of their way there.
struct LevelledPiece {
  LevelPlace end;
  double part = 1;  // above 0; 1 at the end of the move
};

// `from` and `to` are the ends as the program means them. Returns one piece at least, in order; the last one ends above
// `to`. A move that goes straight up or down is one piece. `tolerance`: above 0.
std::vector<LevelledPiece> level_line(const HeightMap& map, const LevelPlace& from, const LevelPlace& to,
                                      double tolerance);

// An arc in X and Y about (`center_x`, `center_y`), with Z in proportion (a helix). `sweep`: radians, counterclockwise
// positive, whole turns included, not 0. Each piece is an arc about the same centre.
std::vector<LevelledPiece> level_arc(const HeightMap& map, const LevelPlace& from, const LevelPlace& to,
                                     double center_x, double center_y, double sweep, double tolerance);

}  // namespace passo
