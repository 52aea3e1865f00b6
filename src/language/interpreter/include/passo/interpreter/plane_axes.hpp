// PlaneAxes: the two axes of a plane, and the axis normal to it. A counterclockwise rotation by 90 degrees turns the
// first axis into the second.
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
    case Plane::uv: return {Axis::u, Axis::v, Axis::w};
    case Plane::wu: return {Axis::w, Axis::u, Axis::v};
    case Plane::vw: return {Axis::v, Axis::w, Axis::u};
  }
  return {Axis::x, Axis::y, Axis::z};
}
// Returns whether this is a plane of U V W, which only cycles support.
constexpr bool is_of_uvw(Plane plane) {
  return plane == Plane::uv || plane == Plane::wu || plane == Plane::vw;
}

}  // namespace passo
