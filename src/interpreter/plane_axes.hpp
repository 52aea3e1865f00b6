// The axes of a plane: its own two, in the order in which arcs turn from one to the other, and the one through it.
#pragma once

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

struct PlaneAxes {
  Axis first;
  Axis second;
  Axis normal;
};
constexpr PlaneAxes axes_of(Plane plane) {
  switch (plane) {
    case Plane::xy: return {Axis::x, Axis::y, Axis::z};
    case Plane::zx: return {Axis::z, Axis::x, Axis::y};
    case Plane::yz: return {Axis::y, Axis::z, Axis::x};
  }
  return {Axis::x, Axis::y, Axis::z};
}

}  // namespace passo
