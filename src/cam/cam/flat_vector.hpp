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
// The centre of the circle through the origin, a and b, which are not on one line.
inline FlatVector centre_of_circle(FlatVector a, FlatVector b) {
  const double twice = 2 * cross(a, b);
  const double of_a = dot(a, a);
  const double of_b = dot(b, b);
  return {(b.y * of_a - a.y * of_b) / twice, (a.x * of_b - b.x * of_a) / twice};
}

}  // namespace passo
