#include "passo/geometry/curve_derivatives.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

CurveDerivatives of_arc(const Curve& curve, double s) {
  const Curve::ArcData& arc = curve.arc_data();
  const double length = curve.length().value();
  const double growth = arc.end_radius - arc.start_radius;
  const double share = std::clamp(s / length, 0.0, 1.0);
  const double radius = arc.start_radius + share * growth;
  const double angle = arc.start_angle + share * arc.sweep;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  CurveDerivatives at{.first = curve.cubic_data().first, .second = {}, .third = {}};
  const auto set = [&](Point& derivative, double outward, double around) {
    derivative[arc.first] = outward * cosine - around * sine;
    derivative[arc.second] = outward * sine + around * cosine;
  };
  // P = r (cos t, sin t) with r and t linear in s.
  const double turning = arc.sweep / length;
  set(at.first, growth / length, radius * arc.sweep / length);
  set(at.second, -(radius * turning * turning), 2 * turning * growth / length);
  set(at.third, -3 * (growth / length) * turning * turning, -radius * turning * turning * turning);
  return at;
}

CurveDerivatives of_cubic(const Curve& curve, double s) {
  const Curve::CubicData cubic = curve.cubic_data();
  const double u = std::clamp(s, 0.0, curve.length().value());
  CurveDerivatives at{.first = cubic.first, .second = {}, .third = cubic.third * 6};
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double square = cubic.second.values[i];
    const double cube = cubic.third.values[i];
    at.first.values[i] += u * (2 * square + 3 * u * cube);
    at.second.values[i] = 2 * square + 6 * u * cube;
  }
  return at;
}

}  // namespace

CurveDerivatives derivatives_at(const Curve& curve, Mm s) {
  switch (curve.shape()) {
    case Curve::Shape::arc:
      if (curve.has_length()) return of_arc(curve, s.value());
      break;
    case Curve::Shape::cubic: return of_cubic(curve, s.value());
    case Curve::Shape::line: break;
  }
  return {.first = curve.cubic_data().first, .second = {}, .third = {}};
}

}  // namespace passo
