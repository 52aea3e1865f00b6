// The axes of a machine, and positions.
//
// X Y Z and U V W are lengths in millimetres. A B C are angles in degrees: if a name ends in `_mm` or `_mm_per_s`, a
// value of A, B or C is in degrees or degrees per second.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "passo/library/version.hpp"

namespace passo::v1 {

enum class Axis : std::uint8_t { x, y, z, a, b, c, u, v, w };
inline constexpr std::size_t axis_count = 9;
inline constexpr std::array<Axis, axis_count> all_axes = {Axis::x, Axis::y, Axis::z, Axis::a, Axis::b,
                                                          Axis::c, Axis::u, Axis::v, Axis::w};

// Returns 'X', 'Y' and so on.
constexpr char letter_of(Axis axis) {
  return "XYZABCUVW"[static_cast<std::size_t>(axis)];
}

// A value for each axis: a position, a velocity or an acceleration.
struct Position {
  double x = 0;
  double y = 0;
  double z = 0;
  double a = 0;
  double b = 0;
  double c = 0;
  double u = 0;
  double v = 0;
  double w = 0;

  constexpr double& operator[](Axis axis) { return const_cast<double&>(value_of(*this, axis)); }
  constexpr double operator[](Axis axis) const { return value_of(*this, axis); }
  friend constexpr bool operator==(const Position& p, const Position& q) {
    for (const Axis axis : all_axes) {
      if (p[axis] != q[axis]) return false;
    }
    return true;
  }
  friend constexpr bool operator!=(const Position& p, const Position& q) { return !(p == q); }

 private:
  static constexpr const double& value_of(const Position& position, Axis axis) {
    switch (axis) {
      case Axis::x: return position.x;
      case Axis::y: return position.y;
      case Axis::z: return position.z;
      case Axis::a: return position.a;
      case Axis::b: return position.b;
      case Axis::c: return position.c;
      case Axis::u: return position.u;
      case Axis::v: return position.v;
      case Axis::w: break;
    }
    return position.w;
  }
};

// The planes of arcs. The turn from the first axis to the second is counterclockwise.
enum class ArcPlane : std::uint8_t { xy, zx, yz };

}  // namespace passo::v1
