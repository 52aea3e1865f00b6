#include "exact_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace passo::proof {
namespace {

using Complex = std::complex<double>;

// A radius that grows by a smaller share of itself is constant.
constexpr double rounding_of_radii = 1e-12;

// The axes are three groups of three: X Y Z, A B C and U V W.
static_assert(axis_count == 9 && index_of(Axis::a) == 3 && index_of(Axis::u) == 6);

double dot(const Point& a, const Point& b, double degree = 1) {
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < axis_count; ++i) sums[i / 3] += a.values[i] * b.values[i];
  return sums[0] + degree * degree * sums[1] + sums[2];
}

// Three sums side by side: a single sum would wait for each of its nine additions.
double squared_distance(const Point& a, const Point& b, double degree = 1) {
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double between = b.values[i] - a.values[i];
    sums[i / 3] += between * between;
  }
  return sums[0] + degree * degree * sums[1] + sums[2];
}

// The angle between two slopes, and by how much their logarithms differ. A slope that is 0 has no direction.
double change_of_direction(const Point& a, const Point& b) {
  const double squares_a = dot(a, a);
  const double squares_b = dot(b, b);
  if (!(squares_a > 0) || !(squares_b > 0)) return 0;
  // The small angle loses no digits: the sine of its half is the distance of the two directions.
  const double size_a = std::sqrt(squares_a);
  const double size_b = std::sqrt(squares_b);
  const double half = std::min(distance(a * (1 / size_a), b * (1 / size_b)) / 2, 1.0);
  return 2 * std::asin(half) + std::abs(std::log(size_b / size_a));
}

// An arc's radius and angle at s, and their rates.
struct Polar {
  double r, g, w;
  Complex direction;  // e^(iφ)
};
Polar polar_at(const Curve& curve, double s) {
  const Curve::ArcData& arc = curve.arc_data();
  const double length = curve.length().value();
  const double g = (arc.end_radius - arc.start_radius) / length;
  const double w = arc.sweep / length;
  return {.r = arc.start_radius + g * s, .g = g, .w = w, .direction = std::polar(1.0, arc.start_angle + w * s)};
}

struct ArcDerivatives {
  Complex first, second, third;
};
ArcDerivatives derivatives_of(const Polar& polar) {
  const auto& [r, g, w, direction] = polar;
  return {.first = Complex(g, r * w) * direction,
          .second = Complex(-r * w * w, 2 * g * w) * direction,
          .third = -Complex(3 * g * w * w, r * w * w * w) * direction};
}
Derivatives real_part(const ArcDerivatives& arc) {
  return {arc.first.real(), arc.second.real(), arc.third.real()};
}
Derivatives imaginary_part(const ArcDerivatives& arc) {
  return {arc.first.imag(), arc.second.imag(), arc.third.imag()};
}

}  // namespace

double distance(const Point& a, const Point& b, double degree) {
  return std::sqrt(squared_distance(a, b, degree));
}

bool ExactCurve::in_plane(Axis axis) const {
  const Curve::ArcData& arc = curve_.arc_data();
  return curve_.shape() == Curve::Shape::arc && (axis == arc.first || axis == arc.second);
}

bool ExactCurve::moves(Axis axis) const {
  if (in_plane(axis) || curve_.start()[axis] != curve_.end()[axis]) return true;
  if (!is_cubic()) return false;
  const Curve::CubicData data = curve_.cubic_data();
  return data.first[axis] != 0 || data.second[axis] != 0 || data.third[axis] != 0;
}

double ExactCurve::feed_factor() const {
  const Curve::ArcData& arc = curve_.arc_data();
  const bool is_length = is_line() || (!is_cubic() && arc.start_radius == arc.end_radius);
  return is_length ? 1 : std::max(1.0, fastest_);
}

Point ExactCurve::place(double s) const {
  Point point;
  const double share = s / length();
  for (const Axis axis : all_axes) {
    if (curve_.shape() == Curve::Shape::cubic) {
      const Curve::CubicData data = curve_.cubic_data();
      point[axis] =
          curve_.start()[axis] + data.first[axis] * s + data.second[axis] * s * s + data.third[axis] * s * s * s;
    } else {
      point[axis] = curve_.start()[axis] * (1 - share) + curve_.end()[axis] * share;
    }
  }
  if (curve_.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve_.arc_data();
    const Polar polar = polar_at(curve_, s);
    point[arc.first] = arc.first_center + polar.r * polar.direction.real();
    point[arc.second] = arc.second_center + polar.r * polar.direction.imag();
  }
  return point;
}

// An arc's direction is computed once for both.
ExactCurve::Local ExactCurve::local(double s) const {
  if (curve_.shape() != Curve::Shape::arc) return {.place = place(s), .slopes = at(all_axes, s)};
  Local local;
  const double per_length = 1 / length();
  for (const Axis axis : all_axes) {
    const double way = curve_.end()[axis] - curve_.start()[axis];
    local.place[axis] = curve_.start()[axis] + way * s * per_length;
    local.slopes[index_of(axis)] = {.first = way * per_length};
  }
  const Curve::ArcData& arc = curve_.arc_data();
  const Polar polar = polar_at(curve_, s);
  local.place[arc.first] = arc.first_center + polar.r * polar.direction.real();
  local.place[arc.second] = arc.second_center + polar.r * polar.direction.imag();
  const ArcDerivatives derivatives = derivatives_of(polar);
  local.slopes[index_of(arc.first)] = real_part(derivatives);
  local.slopes[index_of(arc.second)] = imaginary_part(derivatives);
  return local;
}

ExactCurve::AllDerivatives ExactCurve::at(std::span<const Axis> axes, double s) const {
  AllDerivatives all;
  if (curve_.shape() != Curve::Shape::arc) {
    for (std::size_t i = 0; i < axes.size(); ++i) all[i] = at(axes[i], s);
    return all;
  }
  const ArcDerivatives arc = derivatives_of(polar_at(curve_, s));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    all[i] = !in_plane(axes[i])                   ? at(axes[i], s)
             : axes[i] == curve_.arc_data().first ? real_part(arc)
                                                  : imaginary_part(arc);
  }
  return all;
}

Derivatives ExactCurve::at(Axis axis, double s) const {
  if (curve_.shape() == Curve::Shape::cubic) {
    const Curve::CubicData data = curve_.cubic_data();
    return {.first = data.first[axis] + 2 * data.second[axis] * s + 3 * data.third[axis] * s * s,
            .second = 2 * data.second[axis] + 6 * data.third[axis] * s,
            .third = 6 * data.third[axis]};
  }
  if (!in_plane(axis)) return {.first = (curve_.end()[axis] - curve_.start()[axis]) / length()};
  const ArcDerivatives arc = derivatives_of(polar_at(curve_, s));
  return axis == curve_.arc_data().first ? real_part(arc) : imaginary_part(arc);
}

Derivatives ExactCurve::sizes_in_plane(double s) const {
  const Curve::ArcData& arc = curve_.arc_data();
  const double g = (arc.end_radius - arc.start_radius) / length();
  const double w = arc.sweep / length();
  const double r = arc.start_radius + g * s;
  return {.first = std::hypot(g, r * w),
          .second = std::hypot(r * w * w, 2 * g * w),
          .third = std::hypot(3 * g * w * w, r * w * w * w)};
}

double ExactCurve::turning_of_all() const {
  if (curve_.shape() == Curve::Shape::arc) return std::abs(curve_.arc_data().sweep);
  if (curve_.shape() == Curve::Shape::line) return 0;
  constexpr int parts = 8;
  double sum = 0;
  Point before = slope(0);
  for (int i = 1; i <= parts; ++i) {
    const Point after = slope(length() * i / parts);
    sum += change_of_direction(before, after);
    before = after;
  }
  return sum;
}

Point ExactCurve::slope(double s) const {
  Point slope;
  for (const Axis axis : all_axes) slope[axis] = at(axis, s).first;
  return slope;
}

bool ExactCurve::is_circle() const {
  if (curve_.shape() != Curve::Shape::arc) return false;
  const Curve::ArcData& arc = curve_.arc_data();
  if (std::abs(arc.end_radius - arc.start_radius) > rounding_of_radii * arc.start_radius) return false;
  return std::ranges::none_of(all_axes,
                              [&](Axis axis) { return !in_plane(axis) && curve_.start()[axis] != curve_.end()[axis]; });
}

// A cubic's slope lies within the convex hull of its Bézier points.
double ExactCurve::fastest_of_all() const {
  double squares = 0;
  for (const Axis axis : all_axes) {
    if (in_plane(axis)) continue;
    double most = std::abs(at(axis, 0).first);
    if (curve_.shape() == Curve::Shape::cubic) {
      const Curve::CubicData data = curve_.cubic_data();
      const double middle = data.first[axis] + data.second[axis] * length();
      most = std::max({most, std::abs(middle), std::abs(at(axis, length()).first)});
    }
    squares += most * most;
  }
  if (curve_.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve_.arc_data();
    const double around = std::max(arc.start_radius, arc.end_radius) * arc.sweep;
    const double growing = arc.end_radius - arc.start_radius;
    squares += (around * around + growing * growing) / (length() * length());
  }
  return std::sqrt(squares);
}

double ExactCurve::nearest_at_best(const Point& point, double from, double to, double degree) const {
  return distance(point, place((from + to) / 2), degree) - fastest_ * std::max(degree, 1.0) * (to - from) / 2;
}

ExactCurve::Nearest ExactCurve::nearest(const Point& point, double from, double to, double degree) const {
  if (circles_) return nearest_of_circle(point, from, to, degree);
  if (!is_line()) return nearest_of_bent(point, from, to, degree);
  const Point way = curve_.end() - curve_.start();
  const double share = dot(point - curve_.start(), way, degree) / dot(way, way, degree);
  const double s = std::clamp(share * length(), from, to);
  return {.s = s, .distance = distance(point, place(s), degree)};
}

// A circle's nearest place lies in the direction of the point. If the part does not reach that far, it is an end.
ExactCurve::Nearest ExactCurve::nearest_of_circle(const Point& point, double from, double to, double degree) const {
  const Curve::ArcData& arc = curve_.arc_data();
  const double angle = std::atan2(point[arc.second] - arc.second_center, point[arc.first] - arc.first_center);
  const double way_of_a_turn = 2 * std::numbers::pi * length() / std::abs(arc.sweep);
  const double way = (angle - arc.start_angle) * length() / arc.sweep;
  const double turns = std::round(((from + to) / 2 - way) / way_of_a_turn);
  const double s = std::clamp(way + turns * way_of_a_turn, from, to);
  return {.s = s, .distance = distance(point, place(s), degree)};
}

// Takes the best of a row of points. Between its neighbours, where the way from the point is at right angles to the
// curve, it is nearest: Newton's method, and halves where that would leave the part.
ExactCurve::Nearest ExactCurve::nearest_of_bent(const Point& point, double from, double to, double degree) const {
  constexpr double piece = 0.2;  // radians
  constexpr int most_steps = 40;
  constexpr double near = 1e-8;  // a share of the part: its square is the error of the distance
  const double turns = turning_ * (to - from) / length();
  const int parts = 2 + static_cast<int>(std::min(turns / piece, 1e4));
  const double step = (to - from) / parts;
  int best = 0;
  double least = INFINITY;
  for (int i = 0; i <= parts; ++i) {
    const double here = squared_distance(point, place(from + step * i), degree);
    if (here < least) {
      least = here;
      best = i;
    }
  }
  double low = from + step * std::max(best - 1, 0);
  double high = from + step * std::min(best + 1, parts);
  double s = from + step * best;
  for (int i = 0; i < most_steps && high - low > near * step; ++i) {
    double pull = 0;   // half of the derivative of the squared distance
    double steep = 0;  // and its derivative
    const Local here = local(s);
    for (std::size_t k = 0; k < axis_count; ++k) {
      const double weight = is_rotary(all_axes[k]) ? degree * degree : 1;
      const double away = here.place.values[k] - point.values[k];
      pull += weight * away * here.slopes[k].first;
      steep += weight * (here.slopes[k].first * here.slopes[k].first + away * here.slopes[k].second);
    }
    (pull > 0 ? high : low) = s;
    const double next = steep > 0 ? s - pull / steep : low;
    const bool is_inside = next > low && next < high;
    const double moved = std::abs(next - s);
    s = is_inside ? next : (low + high) / 2;
    if (is_inside && moved < near * step) break;
  }
  const double here = squared_distance(point, place(s), degree);
  return here <= least ? Nearest{s, std::sqrt(here)} : Nearest{from + step * best, std::sqrt(least)};
}

}  // namespace passo::proof
