// ParametricCurve: the interface of all curves in X Y Z. It is a concept: curves are plain values.
//
// The parameter u runs from range().low to range().high; its meaning depends on the kind of curve. Points are exact at
// both ends: at(low) and at(high) are exactly the points given at construction. Derivatives come from the formula, not
// from differences.
//
// deviation(a, b), for a < b within one smooth piece, bounds the distance between curve and chord (the straight piece
// from at(a) to at(b)). No point of the curve between a and b is farther from the chord, apart from rounding errors. No
// point of the chord is farther from the curve either, since the curve joins the chord's ends. The bound may slightly
// exceed the true distance, and converges to it as chords get shorter. It is infinite if the chord is too coarse for
// the curve.
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
  // The end of the smooth piece that starts at u: the next point where the formula changes (a knot), or range().high.
  { curve.next_break(u) } -> std::same_as<double>;
  { curve.deviation(u, u) } -> std::same_as<Mm>;
  // Whether the deviation depends only on b - a, as on a circle. Equal chords are then optimal.
  { curve.is_even() } -> std::same_as<bool>;
};

// Why the curve cannot be created, in words for the user.
struct CurveError {
  std::string message;
};

// The largest allowed coordinate. Within it, neighbouring doubles are less than a picometre apart.
inline constexpr Mm largest_coordinate{1e5};
inline bool is_in_bounds(const Vector3& place) {
  const auto small = [](double value) { return std::abs(value) <= largest_coordinate.value(); };  // false for a NaN
  return small(place.x) && small(place.y) && small(place.z);
}

}  // namespace passo
