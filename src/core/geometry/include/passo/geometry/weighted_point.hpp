// WeightedPoint: a control point of a rational curve in homogeneous coordinates: the weight, and x, y and z in mm times
// the weight. In these coordinates a rational curve is computed like any other; the division by the weight is the last
// step.
#pragma once

#include "passo/geometry/vector3.hpp"

namespace passo {

struct WeightedPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  double weight = 1;

  static WeightedPoint of(const Vector3& place, double weight) {
    return {place.x * weight, place.y * weight, place.z * weight, weight};
  }
  Vector3 weighted() const { return {x, y, z}; }
  Vector3 place() const { return weighted() / weight; }
};

}  // namespace passo
