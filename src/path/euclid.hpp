// Length and product over all nine axes, millimetres and degrees alike: the tube around a path is measured so.
#pragma once

#include <cmath>

#include "passo/geometry/axes.hpp"

namespace passo {

inline double dot(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < axis_count; ++i) sum += a.values[i] * b.values[i];
  return sum;
}
inline double length_of(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline double distance(const Point& a, const Point& b) {
  return length_of(a - b);
}

}  // namespace passo
