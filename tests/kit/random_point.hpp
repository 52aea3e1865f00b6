// A random point. Each coordinate is drawn in a statement of its own: compilers call the functions of one call's
// arguments in orders of their own, and a seed is to give the same point from each of them.
#pragma once

#include "kit/stage_test.hpp"

namespace passo::test {

// Returns a point whose x, y and z are between -most and most.
inline Point random_point(Random& random, double most) {
  Point point;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) point[axis] = random.between(-most, most);
  return point;
}

}  // namespace passo::test
