#include "passo/geometry/ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

using std::numbers::pi;
constexpr double most_turns = 1e6;

double squared(double value) {
  return value * value;
}

bool is_whole_turns(double sweep) {
  return std::abs(std::remainder(sweep, 2 * pi)) <= 1e-12 * std::abs(sweep);
}

// The greatest distance from its chord of an arc of P = c cos f + p sin f over f = -d … d. `across` times (cos f - cos
// d) is the distance from the chord's line. The coordinate along the chord is p sin f ± |along| cos f; it is greatest
// at f = outermost. Where outermost is below d, the arc turns back before it reaches the end:
//
//          __ outermost            From outermost to the end, and as far again before outermost, the nearest place of
//     ____/  |                     the chord is its end.
//    /_______|end
//
double farthest(double across, double along, double forward, double d) {
  const double sine = std::sin(d / 2);
  const double from_line = across * 2 * sine * sine;
  const double outermost = std::atan2(forward, std::abs(along));
  if (outermost >= d) return from_line;
  const double reach = std::hypot(along, forward) - (forward * std::sin(d) + std::abs(along) * std::cos(d));
  const double passes_end = 2 * outermost - d;
  const double there = passes_end > 0 ? across * (std::cos(passes_end) - std::cos(d)) : from_line;
  return std::max(from_line, std::hypot(there, reach));
}

}  // namespace

Result<Ellipse, CurveError> Ellipse::create(const Shape& shape) {
  const double major = length(shape.major);
  const double minor = length(shape.minor);
  if (!is_in_bounds(shape.centre) || !is_in_bounds(shape.major) || !is_in_bounds(shape.minor)) {
    return Failure{CurveError{"centre and semi-axes of an ellipse must be within 100000 mm of the origin"}};
  }
  if (!(major > 0) || !(minor > 0)) return Failure{CurveError{"both semi-axes of an ellipse must be longer than 0"}};
  if (std::abs(dot(shape.major, shape.minor)) > 1e-9 * major * minor) {
    return Failure{CurveError{"the semi-axes of an ellipse must be perpendicular"}};
  }
  if (!std::isfinite(shape.start.value) || !(std::abs(shape.sweep.value) <= most_turns * 2 * pi)) {
    return Failure{CurveError{"the angles of an ellipse must be at most a million turns"}};
  }
  if (shape.sweep.value == 0) return Failure{CurveError{"an elliptical arc must have an angle other than 0"}};
  return Ellipse(shape);
}

Result<Ellipse, CurveError> Ellipse::flat(const Vector3& centre, Mm first_radius, Mm second_radius, Radians rotation,
                                          Radians start, Radians sweep) {
  if (!(first_radius > Mm(0)) || !(second_radius > Mm(0))) {
    return Failure{CurveError{"both radii of an ellipse must be above 0 mm"}};
  }
  const Vector3 toward = {std::cos(rotation.value), std::sin(rotation.value), 0};
  const Vector3 left = {-toward.y, toward.x, 0};
  return create({.centre = centre,
                 .major = toward * first_radius.value(),
                 .minor = left * second_radius.value(),
                 .start = start,
                 .sweep = sweep});
}

Ellipse::Ellipse(const Shape& shape) : shape_(shape) {
  const double major = length(shape.major);
  is_circle_ = std::abs(major - length(shape.minor)) <= 1e-12 * major;
}

Vector3 Ellipse::at(double u) const {
  // A whole turn ends exactly at its start, without an error of rounding.
  if (u == 1 && is_whole_turns(shape_.sweep.value)) u = 0;
  const double angle = shape_.start.value + u * shape_.sweep.value;
  return shape_.centre + shape_.major * std::cos(angle) + shape_.minor * std::sin(angle);
}

Vector3 Ellipse::derivative(double u) const {
  const double angle = shape_.start.value + u * shape_.sweep.value;
  return (shape_.minor * std::cos(angle) - shape_.major * std::sin(angle)) * shape_.sweep.value;
}

Vector3 Ellipse::second_derivative(double u) const {
  const double angle = shape_.start.value + u * shape_.sweep.value;
  return (shape_.major * std::cos(angle) + shape_.minor * std::sin(angle)) * -squared(shape_.sweep.value);
}

Mm Ellipse::deviation(double from, double to) const {
  const double half = (to - from) * std::abs(shape_.sweep.value) / 2;
  // A chord spans at most half a turn. Otherwise an ellipse smaller than the tolerance would vanish.
  constexpr double widest = pi / 2 * (1 + 1e-12);
  if (half > widest) return Mm(std::numeric_limits<double>::infinity());
  const double middle = shape_.start.value + (from + to) / 2 * shape_.sweep.value;
  const double cosine = std::cos(middle);
  const double sine = std::sin(middle);
  const Vector3 out = shape_.major * cosine + shape_.minor * sine;
  const Vector3 tangent = shape_.minor * cosine - shape_.major * sine;
  const double forward = std::sqrt(dot(tangent, tangent));
  const double across = length(cross(shape_.major, shape_.minor)) / forward;
  return Mm(farthest(across, dot(out, tangent) / forward, forward, half));
}

}  // namespace passo
