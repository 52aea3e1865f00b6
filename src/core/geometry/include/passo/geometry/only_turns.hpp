// Whether the length of a curve is in degrees: the curve moves only A, B or C, and none of them rotates a surface whose
// motion counts as a length.
#pragma once

#include "passo/geometry/curve.hpp"

namespace passo {

inline bool only_turns(const Curve& curve, const SurfaceScale& surface = {}) {
  if (curve.shape() == Curve::Shape::arc) return false;
  for (const Axis axis : all_axes) {
    if (!is_rotary(axis) && curve.moves(axis)) return false;
  }
  return !(surface.square_of(curve.steepest_bound()) > 0);
}

}  // namespace passo
