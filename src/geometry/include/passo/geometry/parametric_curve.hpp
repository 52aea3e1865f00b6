// ParametricCurve: what every curve in X Y Z can say, whatever its kind. A concept: curves are plain values.
//
// The parameter u runs from range().low to range().high and means what the kind of curve says. Points are exact at both
// ends: at(low) and at(high) are the very numbers the curve was made from. Derivatives are those of the formula, not
// differences.
//
// deviation(a, b) is for a < b within one smooth piece: never less (to the rounding of doubles) than the distance of
// any point of the curve between a and b from the chord, the straight piece from at(a) to at(b); infinite where the
// curve does not want to be cut so coarsely. Since the curve joins the ends of the chord, no point of the chord is
// farther from the curve either. It may be a little more than the true distance; it tends to it as chords get short.
#pragma once

#include <concepts>
#include <string>

#include "passo/base/result.hpp"
#include "passo/geometry/vector3.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ParameterRange {
  double low = 0;
  double high = 1;
};

template <class C>
concept ParametricCurve = requires(const C& curve, double u) {
  { curve.range() } -> std::same_as<ParameterRange>;
  { curve.at(u) } -> std::same_as<Vector3>;
  { curve.derivative(u) } -> std::same_as<Vector3>;
  { curve.second_derivative(u) } -> std::same_as<Vector3>;
  // Where the smooth piece that begins at u ends: the next place where the formula changes (a knot), or range().high.
  { curve.next_break(u) } -> std::same_as<double>;
  { curve.deviation(u, u) } -> std::same_as<Mm>;
  // Whether the deviation depends on b - a alone, as on a circle: then equal chords are best.
  { curve.is_even() } -> std::same_as<bool>;
};

// Why there is no such curve, in words for the one who asked for it.
struct CurveError {
  std::string message;
};

// No coordinate of a curve is larger, so that a double tells places a picometre or so apart everywhere on it.
inline constexpr Mm largest_coordinate{1e5};
inline bool is_in_bounds(const Vector3& place) {
  const auto small = [](double value) { return std::abs(value) <= largest_coordinate.value(); };  // false for a NaN
  return small(place.x) && small(place.y) && small(place.z);
}

}  // namespace passo
