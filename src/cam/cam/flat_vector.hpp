// FlatVector: a vector in the plane, in nanometres. Private to cam/.
#pragma once

#include <cmath>

#include "passo/cam/drawing.hpp"

namespace passo {

struct FlatVector {
  double x = 0;
  double y = 0;
};

inline FlatVector from_to(DrawnPoint from, DrawnPoint to) {
  return {static_cast<double>(to.x.count - from.x.count), static_cast<double>(to.y.count - from.y.count)};
}
inline DrawnPoint shifted(DrawnPoint from, FlatVector by) {
  return {{from.x.count + std::llround(by.x)}, {from.y.count + std::llround(by.y)}};
}
inline double cross(FlatVector a, FlatVector b) {
  return a.x * b.y - a.y * b.x;
}
inline double dot(FlatVector a, FlatVector b) {
  return a.x * b.x + a.y * b.y;
}

}  // namespace passo
