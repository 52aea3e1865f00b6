// Vector3: a position or displacement in X Y Z, in millimetres, for curves in space.
//
// A Point has all nine axes, for positions of the machine. Most of geometry needs only three.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/geometry/axes.hpp"

namespace passo {

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  static constexpr Vector3 of(const Point& point) { return {point[Axis::x], point[Axis::y], point[Axis::z]}; }

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vector3 operator*(const Vector3& a, double k) { return {a.x * k, a.y * k, a.z * k}; }
  friend constexpr Vector3 operator/(const Vector3& a, double k) { return {a.x / k, a.y / k, a.z / k}; }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

constexpr double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& a) {
  return std::hypot(a.x, a.y, a.z);
}
// Returns the point nearest to `place` on the line segment from `a` to `b`.
constexpr Vector3 nearest_of(const Vector3& a, const Vector3& b, const Vector3& place) {
  const Vector3 way = b - a;
  const double square = dot(way, way);
  return square > 0 ? a + way * std::clamp(dot(place - a, way) / square, 0.0, 1.0) : a;
}
inline bool is_finite(const Vector3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace passo
