// Whether a curve moves only A, B or C. Its length is then in degrees, never in millimetres.
#pragma once

#include "passo/geometry/curve.hpp"

namespace passo {

inline bool only_turns(const Curve& curve) {
  if (curve.shape() == Curve::Shape::arc) return false;
  for (const Axis axis : all_axes) {
    if (!is_rotary(axis) && curve.moves(axis)) return false;
  }
  return true;
}

}  // namespace passo
