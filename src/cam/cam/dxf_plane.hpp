// seen_from_above: entities of a DXF file that lie in a plane of their own. Private to cam/.
//
// Source: Autodesk, DXF Reference, "Arbitrary Axis Algorithm".
#pragma once

#include <cmath>
#include <optional>

#include "dxf_transform.hpp"

#include "passo/geometry/vector3.hpp"

namespace passo {

// Returns the vector normalized to length 1; (0, 0, 1) if it is zero.
inline Vector3 dxf_direction(const Vector3& v) {
  const double size = length(v);
  return size > 1e-9 && std::isfinite(size) ? v / size : Vector3{0, 0, 1};
}

// Maps the coordinates of a plane with this normal (the extrusion direction), `z` above the origin, to X and Y of the
// drawing. Empty if both are the same.
inline std::optional<DxfTransform> seen_from_above(const Vector3& normal, double z) {
  const Vector3 n = dxf_direction(normal);
  if (n.x == 0 && n.y == 0 && n.z > 0) return std::nullopt;
  constexpr double near = 1.0 / 64;
  const bool is_steep = std::abs(n.x) < near && std::abs(n.y) < near;
  const Vector3 x = dxf_direction(is_steep ? cross({0, 1, 0}, n) : cross({0, 0, 1}, n));
  const Vector3 y = cross(n, x);
  return DxfTransform{.xx = x.x, .xy = y.x, .yx = x.y, .yy = y.y, .dx = n.x * z, .dy = n.y * z};
}

// Returns the minor semi-axis of an ELLIPSE, from its major semi-axis.
inline Vector3 minor_axis(const Vector3& normal, const Vector3& major, double ratio) {
  return cross(dxf_direction(normal), major) * ratio;
}

}  // namespace passo
