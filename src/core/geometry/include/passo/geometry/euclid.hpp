// The length and dot product over all nine axes, millimetres and degrees alike, as used for junctions and the tolerance
// tube around a path. Also the length over the axes that define the path length.
#pragma once

#include <cmath>
#include <cstdint>

#include "passo/geometry/axes.hpp"
#include "passo/geometry/surface_scale.hpp"

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

// The group of axes whose travel is the length s: X Y Z and surfaces that count, else U V W, else A B C (Curve).
enum class CountedGroup : std::uint8_t { xyz, uvw, abc };
inline double square_in(const Point& travel, CountedGroup group, const SurfaceScale& surface = {}) {
  const std::size_t first = group == CountedGroup::xyz ? 0 : group == CountedGroup::uvw ? 6 : 3;
  double sum = group == CountedGroup::xyz ? surface.square_of(travel) : 0;
  for (std::size_t i = first; i < first + 3; ++i) sum += travel.values[i] * travel.values[i];
  return group == CountedGroup::abc ? sum * (surface.unit * surface.unit) : sum;
}
inline double length_in(const Point& travel, CountedGroup group, const SurfaceScale& surface = {}) {
  return std::sqrt(square_in(travel, group, surface));
}
inline CountedGroup counted_group(const Point& travel, const SurfaceScale& surface = {}) {
  if (square_in(travel, CountedGroup::xyz, surface) > 0) return CountedGroup::xyz;
  return square_in(travel, CountedGroup::uvw) > 0 ? CountedGroup::uvw : CountedGroup::abc;
}
inline double counted_length(const Point& travel, const SurfaceScale& surface = {}) {
  return length_in(travel, counted_group(travel, surface), surface);
}

}  // namespace passo
