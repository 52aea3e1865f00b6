#include "passo/geometry/curve_in_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

bool in_space(Axis axis) {
  return axis == Axis::x || axis == Axis::y || axis == Axis::z;
}

// Growth of the radius, in mm for each radian.
double growth_of(const Curve::ArcData& arc) {
  return (arc.end_radius - arc.start_radius) / std::abs(arc.sweep);
}

}  // namespace

Result<CurveInSpace, CurveError> CurveInSpace::of(const Curve& curve) {
  const bool arc = curve.shape() == Curve::Shape::arc;
  if (arc && (!in_space(curve.arc_data().first) || !in_space(curve.arc_data().second))) {
    return Failure{CurveError{"the plane of the arc is outside X Y Z"}};
  }
  const auto bounded = [](const Point& point) { return is_in_bounds(Vector3::of(point)); };
  const Box box = curve.extents();
  if (!bounded(box.low) || !bounded(box.high)) {
    return Failure{CurveError{"the curve reaches beyond 100000 mm from the origin"}};
  }
  return CurveInSpace(curve);
}

// Radius and angle change in proportion to s. Of the second derivative of P = r e(angle) two terms are left: 2 r' e'
// and r e''.
Vector3 CurveInSpace::second_derivative(double u) const {
  if (curve_.shape() == Curve::Shape::line || !curve_.has_length()) return {};
  const Curve::ArcData& arc = curve_.arc_data();
  const double length = curve_.length().value();
  const double share = u / length;
  const double radius = arc.start_radius + share * (arc.end_radius - arc.start_radius);
  const double angle = arc.start_angle + share * arc.sweep;
  const double turning = arc.sweep / length;
  const double sideways = 2 * (arc.end_radius - arc.start_radius) / length * turning;
  const double inwards = radius * turning * turning;
  Point second;
  second[arc.first] = -sideways * std::sin(angle) - inwards * std::cos(angle);
  second[arc.second] = sideways * std::cos(angle) - inwards * std::sin(angle);
  return Vector3::of(second);
}

Mm CurveInSpace::deviation(double from, double to) const {
  if (curve_.shape() == Curve::Shape::line || !curve_.has_length()) return Mm(0);
  const Curve::ArcData& arc = curve_.arc_data();
  const double length = curve_.length().value();
  const double half = (to - from) / length * std::abs(arc.sweep) / 2;
  // A chord spans at most half a turn. Otherwise a full circle smaller than the tolerance would vanish.
  constexpr double widest = std::numbers::pi / 2 * (1 + 1e-12);
  if (half > widest) return Mm(std::numeric_limits<double>::infinity());
  const double middle = (from + to) / 2 / length;
  const double radius = is_even() ? std::max(arc.start_radius, arc.end_radius)
                                  : arc.start_radius + middle * (arc.end_radius - arc.start_radius);
  const double sine = std::sin(half / 2);
  const double sagitta = radius * 2 * sine * sine;  // 1 - cos d without cancellation
  return Mm(sagitta + std::abs(growth_of(arc)) * half * half / 2 * std::sqrt(4 + half * half));
}

// A difference of the radii that comes from rounding in programs is ignored: the arc is cut like one of the larger
// radius.
bool CurveInSpace::is_even() const {
  if (curve_.shape() == Curve::Shape::line) return true;
  const Curve::ArcData& arc = curve_.arc_data();
  return std::abs(arc.end_radius - arc.start_radius) <= 0.01 * std::max(arc.start_radius, arc.end_radius);
}

}  // namespace passo
