#include "passo/trajectory/segment_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// What no machine does; it keeps a segment finite that no axis limits.
constexpr double fastest = 1e6;
constexpr double strongest = 1e9;

// On a path that must be met exactly (G61), directions closer than this, in radians, are one: programs round the ends
// of tangent arcs to three digits. What is left of a turn is passed as if the path might be left by a micrometre.
constexpr double tangent_angle = 0.01;
constexpr double tangent_tolerance = 0.001;

// Lines whose directions differ by less are one line in pieces: that much is rounding.
constexpr double same_direction = 1e-8;

// The share of an arc's acceleration that turning may use up: at that speed half of it is left for speeding up and
// braking, since sqrt(1 - 3/4) = 1/2.
constexpr double turning_share = 0.8660254037844386;

double squared(double value) {
  return value * value;
}

double dot(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < axis_count; ++i) sum += a.values[i] * b.values[i];
  return sum;
}

// The largest k for which k·|direction| stays within `limit` on every axis.
template <class Unit>
double largest_multiple(const Point& direction, const PerAxis<Unit>& limit) {
  double best = infinity;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double part = std::abs(direction.values[i]);
    const double most = limit.values[i].value();
    if (part > 0 && most > 0) best = std::min(best, most / part);
  }
  return best;
}

double within(double axis_limit) {
  return axis_limit > 0 ? axis_limit : infinity;
}

// In the plane of an arc, in every direction: the weaker axis decides.
double plane_acceleration(const Curve::ArcData& arc, const MotionLimits& limits) {
  return std::min(
      {within(limits.acceleration[arc.first].value()), within(limits.acceleration[arc.second].value()), strongest});
}

// On a true arc speeding up (tangential, T) and turning (radial, K) are at right angles, so that together they need
// sqrt(T² + K²) of every axis of the plane at most. In a spiral they lean towards each other: with cosine e at most
// they need sqrt((T² + K²)(1 + e)).
double lean(const Curve::ArcData& arc) {
  const double low = std::min(arc.start_radius, arc.end_radius);
  const double high = std::max(arc.start_radius, arc.end_radius);
  const double growth = (high - low) / std::abs(arc.sweep);
  return low > 0 ? std::min(1.0, high * growth / squared(low)) : 1.0;
}

SegmentLimits arc_limits(const Curve& curve, const Point& steepest, double speed, const MotionLimits& limits) {
  const Curve::ArcData& arc = curve.arc_data();
  const double length = curve.length().value();
  const double available = plane_acceleration(arc, limits) / std::sqrt(1 + lean(arc));
  const double bend = curve.curvature();
  speed = std::min(speed, std::sqrt(turning_share * available / bend));
  const double turning = bend * squared(speed);
  const double tangential = std::sqrt((available - turning) * (available + turning));

  // The share of s that the plane sees, and what the axes that only move along allow.
  const double in_plane = std::hypot(std::max(arc.start_radius, arc.end_radius) * arc.sweep / length,
                                     (arc.end_radius - arc.start_radius) / length);
  Point along = steepest;
  along[arc.first] = along[arc.second] = 0;
  const double acceleration = std::min(tangential / in_plane, largest_multiple(along, limits.acceleration));
  return {.speed = MmPerSecond(speed), .acceleration = MmPerSecond2(std::min(acceleration, strongest))};
}

}  // namespace

SegmentLimits segment_limits(const Segment& segment, const MotionLimits& limits) {
  const Point steepest = segment.curve.steepest();
  const double speed = std::min({segment.speed.value(), largest_multiple(steepest, limits.velocity), fastest});
  if (segment.curve.shape() == Curve::Shape::arc && segment.curve.curvature() > 0) {
    return arc_limits(segment.curve, steepest, speed, limits);
  }
  const double acceleration = std::min(largest_multiple(steepest, limits.acceleration), strongest);
  return {.speed = MmPerSecond(speed), .acceleration = MmPerSecond2(acceleration)};
}

Junction junction_between(const Segment& before, const Segment& after, Mm straight_before, const MotionLimits& limits) {
  const Point in = before.curve.tangent(before.curve.length());
  const Point out = after.curve.tangent(Mm(0));
  const Point turn = out - in;
  const double size = std::sqrt(dot(turn, turn));
  const double in_size = std::sqrt(dot(in, in));
  Junction junction;
  junction.straight = size < same_direction * in_size && before.curve.shape() == Curve::Shape::line &&
                      after.curve.shape() == Curve::Shape::line;
  if (before.mode == PathMode::exact_stop) return junction;
  junction.speed = MmPerSecond(infinity);
  if (size == 0) return junction;

  double tolerance = before.tolerance.value();
  if (!(tolerance > 0)) {
    if (size > tangent_angle * in_size) junction.speed = MmPerSecond(0);
    tolerance = tangent_tolerance;
  }
  // Sonny Jeon's junction deviation: the speed of a circle that touches both segments, passes `tolerance` beside the
  // corner and needs no more than the acceleration along the turn. With h the cosine of half the angle that the path
  // turns by, its radius is tolerance·h/(1 - h), and |turn|² = 4(1 - h²) for unit tangents.
  const double out_size = std::sqrt(dot(out, out));
  const Point sum = in * out_size + out * in_size;
  const double half = std::min(1.0, std::sqrt(dot(sum, sum)) / (2 * in_size * out_size));
  const double by_tolerance = 4 * tolerance * half * (1 + half) / size;
  // And it begins within half of the way from the corner before: so a circle drawn with many chords, each a corner of
  // its own, is as slow as a true one.
  const double by_length = half * straight_before.value();
  const double speed = std::sqrt(largest_multiple(turn, limits.acceleration) * std::min(by_tolerance, by_length));
  junction.speed = std::min(junction.speed, MmPerSecond(speed));
  return junction;
}

}  // namespace passo
