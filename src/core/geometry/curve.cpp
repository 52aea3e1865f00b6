#include "passo/geometry/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

using std::numbers::pi;

double low_angle(const Curve::ArcData& arc) {
  return std::min(arc.start_angle, arc.start_angle + arc.sweep);
}
double high_angle(const Curve::ArcData& arc) {
  return std::max(arc.start_angle, arc.start_angle + arc.sweep);
}

double radius_at(const Curve::ArcData& arc, double angle) {
  return arc.start_radius + (arc.end_radius - arc.start_radius) * ((angle - arc.start_angle) / arc.sweep);
}

// Whether the arc passes `angle`, counted modulo `period`.
bool sweeps_over(const Curve::ArcData& arc, double angle, double period) {
  return angle + period * std::ceil((low_angle(arc) - angle) / period) <= high_angle(arc);
}

double largest_sine(const Curve::ArcData& arc) {
  if (sweeps_over(arc, pi / 2, pi)) return 1;
  return std::max(std::abs(std::sin(arc.start_angle)), std::abs(std::sin(arc.start_angle + arc.sweep)));
}
double largest_cosine(const Curve::ArcData& arc) {
  if (sweeps_over(arc, 0, pi)) return 1;
  return std::max(std::abs(std::cos(arc.start_angle)), std::abs(std::cos(arc.start_angle + arc.sweep)));
}

// atan2(rise, run) for a positive run. Most arcs are circles but for the rounding of their numbers, where the angle is
// the slope itself: its third power is below what a double resolves beside an angle of the arc.
double angle_of_slope(double rise, double run) {
  const double slope = rise / run;
  return run > 0 && std::abs(slope) < 1e-6 ? slope : std::atan2(rise, run);
}

// How far the arc reaches from its centre in the direction `toward`, a multiple of a quarter turn. 0 where one of the
// arc's ends is the farthest point. A growing radius reaches farthest on the first or on the last turn, at the angle
// where tan(angle - toward) = growth / radius.
double reach(const Curve::ArcData& arc, double toward) {
  const double low = low_angle(arc);
  const double high = high_angle(arc);
  const double growth = (arc.end_radius - arc.start_radius) / arc.sweep;
  const double first = toward + 2 * pi * std::ceil((low - pi / 2 - toward) / (2 * pi));
  const double last = toward + 2 * pi * std::floor((high + pi / 2 - toward) / (2 * pi));
  double best = 0;
  const auto look_at = [&](double turn) {
    if (turn + pi / 2 < low || turn - pi / 2 > high) return;  // the angle is less than a quarter turn away
    double angle = turn;
    for (int pass = 0; pass < 3 && growth != 0; ++pass) angle = turn + angle_of_slope(growth, radius_at(arc, angle));
    if (angle < low || angle > high) return;
    best = std::max(best, radius_at(arc, angle) * std::cos(angle - turn));
  };
  look_at(first);
  if (last > first) {
    look_at(first + 2 * pi);
    look_at(last - 2 * pi);
    look_at(last);
  }
  return best;
}

}  // namespace

Curve Curve::line(const Point& start, const Point& end, const SurfaceScale& surface) {
  Curve curve;
  curve.start_ = start;
  curve.end_ = end;
  const Point travel = end - start;
  curve.length_ = counted_length(travel, surface);
  // This divides instead of multiplying by 1/length, because a length of 1e-310 has no reciprocal.
  for (std::size_t i = 0; i < axis_count && curve.length_ > 0; ++i) {
    curve.slope_.values[i] = travel.values[i] / curve.length_;
  }
  return curve;
}

bool Curve::has_length() const {
  constexpr double rounding = 1e-12;
  if (shape_ != Shape::line) return length_ > rounding;
  if (!(length_ > 0)) return false;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (std::abs(end_.values[i] - start_.values[i]) > rounding) return true;
  }
  return false;
}

Curve Curve::arc(const Point& start, const Point& end, Axis first, Axis second, double first_center,
                 double second_center, double sweep) {
  const double first_arm = start[first] - first_center;
  const double second_arm = start[second] - second_center;
  return arc(start, end,
             {.first = first,
              .second = second,
              .first_center = first_center,
              .second_center = second_center,
              .start_radius = std::hypot(first_arm, second_arm),
              .end_radius = std::hypot(end[first] - first_center, end[second] - second_center),
              .start_angle = std::atan2(second_arm, first_arm),
              .sweep = sweep});
}

Curve Curve::arc(const Point& start, const Point& end, const ArcData& arc, const SurfaceScale& surface) {
  Curve curve;
  curve.shape_ = Shape::arc;
  curve.start_ = start;
  curve.end_ = end;
  curve.arc_ = arc;

  Point travel = end - start;
  travel[arc.first] = 0;
  travel[arc.second] = 0;
  const double along = length_in(travel, CountedGroup::xyz, surface);
  const double around = (arc.start_radius + arc.end_radius) / 2 * std::abs(arc.sweep);
  const double outward = arc.end_radius - arc.start_radius;
  curve.length_ = std::sqrt(around * around + outward * outward + along * along);
  for (std::size_t i = 0; i < axis_count && curve.length_ > 0; ++i) {
    curve.slope_.values[i] = travel.values[i] / curve.length_;
  }
  return curve;
}

Curve Curve::cubic(const Point& start, const Point& start_tangent, const Point& end, const Point& end_tangent,
                   Mm length) {
  Curve curve;
  curve.shape_ = Shape::cubic;
  curve.start_ = start;
  curve.end_ = end;
  curve.slope_ = start_tangent;
  curve.length_ = length.value();
  const double h = curve.length_;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double mean = (end.values[i] - start.values[i]) / h;
    const double first = start_tangent.values[i];
    const double last = end_tangent.values[i];
    curve.square_.values[i] = (3 * mean - 2 * first - last) / h;
    curve.cube_.values[i] = (first + last - 2 * mean) / (h * h);
  }
  return curve;
}

// A part is not made by arc(). A spiral's parameter equals its length only over the whole spiral, and a part must keep
// the parameter of the whole.
Curve Curve::part(Mm from, Mm to) const {
  Curve piece = *this;
  piece.start_ = at(from);
  piece.end_ = at(to);
  piece.length_ = (to - from).value();
  if (shape_ == Shape::arc) {
    const double share = 1 / length_;
    const double growth = (arc_.end_radius - arc_.start_radius) * share;
    const double turn = arc_.sweep * share;
    piece.arc_.start_radius = arc_.start_radius + growth * from.value();
    piece.arc_.end_radius = arc_.start_radius + growth * to.value();
    piece.arc_.start_angle = arc_.start_angle + turn * from.value();
    piece.arc_.sweep = turn * piece.length_;
  } else if (shape_ == Shape::cubic) {
    piece.slope_ = tangent(from);
    piece.square_ = second_derivative(from) * 0.5;
  }
  return piece;
}

Point Curve::at(Mm s) const {
  if (s.value() <= 0) return start_;
  if (s.value() >= length_) return end_;
  if (shape_ == Shape::cubic) {
    const double u = s.value();
    Point point;
    for (std::size_t i = 0; i < axis_count; ++i) {
      point.values[i] = start_.values[i] + u * (slope_.values[i] + u * (square_.values[i] + u * cube_.values[i]));
    }
    return point;
  }
  Point point = start_ + slope_ * s.value();
  if (shape_ == Shape::arc) {
    const double share = s.value() / length_;
    const double radius = arc_.start_radius + share * (arc_.end_radius - arc_.start_radius);
    const double angle = arc_.start_angle + share * arc_.sweep;
    point[arc_.first] = arc_.first_center + radius * std::cos(angle);
    point[arc_.second] = arc_.second_center + radius * std::sin(angle);
  }
  return point;
}

Point Curve::tangent(Mm s) const {
  Point tangent = slope_;
  if (shape_ == Shape::cubic) {
    const double u = std::clamp(s.value(), 0.0, length_);
    for (std::size_t i = 0; i < axis_count; ++i) {
      tangent.values[i] += u * (2 * square_.values[i] + 3 * u * cube_.values[i]);
    }
  }
  if (shape_ == Shape::arc && length_ > 0) {
    const double share = std::clamp(s.value() / length_, 0.0, 1.0);
    const double radius = arc_.start_radius + share * (arc_.end_radius - arc_.start_radius);
    const double angle = arc_.start_angle + share * arc_.sweep;
    const double outward = (arc_.end_radius - arc_.start_radius) / length_;
    const double around = radius * arc_.sweep / length_;
    tangent[arc_.first] = outward * std::cos(angle) - around * std::sin(angle);
    tangent[arc_.second] = outward * std::sin(angle) + around * std::cos(angle);
  }
  return tangent;
}

Point Curve::second_derivative(Mm s) const {
  Point second;
  if (shape_ == Shape::cubic) {
    const double u = std::clamp(s.value(), 0.0, length_);
    for (std::size_t i = 0; i < axis_count; ++i) second.values[i] = 2 * square_.values[i] + 6 * u * cube_.values[i];
  } else if (shape_ == Shape::arc && length_ > 0) {
    const double share = std::clamp(s.value() / length_, 0.0, 1.0);
    const double radius = arc_.start_radius + share * (arc_.end_radius - arc_.start_radius);
    const double angle = arc_.start_angle + share * arc_.sweep;
    const double turning = arc_.sweep / length_;
    const double inward = radius * turning * turning;
    const double sideways = 2 * turning * (arc_.end_radius - arc_.start_radius) / length_;
    second[arc_.first] = -inward * std::cos(angle) - sideways * std::sin(angle);
    second[arc_.second] = -inward * std::sin(angle) + sideways * std::cos(angle);
  }
  return second;
}

Point Curve::third_derivative(Mm s) const {
  Point third;
  if (shape_ == Shape::cubic) {
    third = cube_ * 6;
  } else if (shape_ == Shape::arc && length_ > 0) {
    // P = r (cos t, sin t) with r and t linear in s: P''' = -3 r' t'² (cos t, sin t) - r t'³ (-sin t, cos t).
    const double turn = arc_.sweep / length_;
    const double growth = (arc_.end_radius - arc_.start_radius) / length_;
    const double radius = arc_.start_radius + growth * s.value();
    const double angle = arc_.start_angle + turn * s.value();
    const double out = -3 * growth * turn * turn;
    const double along = -radius * turn * turn * turn;
    third[arc_.first] = out * std::cos(angle) - along * std::sin(angle);
    third[arc_.second] = out * std::sin(angle) + along * std::cos(angle);
  }
  return third;
}

// The slope of a cubic is largest at an end, or where the slope's own change is 0.
Point Curve::steepest_of_cubic() const {
  Point steepest;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double slope = slope_.values[i];
    const double square = square_.values[i];
    const double cube = cube_.values[i];
    const auto at = [&](double u) { return std::abs(slope + u * (2 * square + 3 * u * cube)); };
    double most = std::max(std::abs(slope), at(length_));
    const double vertex = cube != 0 ? -square / (3 * cube) : -1;
    if (vertex > 0 && vertex < length_) most = std::max(most, at(vertex));
    steepest.values[i] = most;
  }
  return steepest;
}

Point Curve::steepest() const {
  if (shape_ == Shape::cubic) return steepest_of_cubic();
  Point steepest;
  for (std::size_t i = 0; i < axis_count; ++i) steepest.values[i] = std::abs(slope_.values[i]);
  if (shape_ == Shape::arc && length_ > 0) {
    const double outward = std::abs(arc_.end_radius - arc_.start_radius) / length_;
    const double around = std::max(arc_.start_radius, arc_.end_radius) * std::abs(arc_.sweep) / length_;
    const double sine = largest_sine(arc_);
    const double cosine = largest_cosine(arc_);
    steepest[arc_.first] = outward * cosine + around * sine;
    steepest[arc_.second] = outward * sine + around * cosine;
  }
  return steepest;
}

Point Curve::steepest_bound() const {
  if (shape_ != Shape::arc) return steepest();
  Point bound;
  for (std::size_t i = 0; i < axis_count; ++i) bound.values[i] = std::abs(slope_.values[i]);
  if (!(length_ > 0)) return bound;
  const double outward = std::abs(arc_.end_radius - arc_.start_radius) / length_;
  const double around = std::max(arc_.start_radius, arc_.end_radius) * std::abs(arc_.sweep) / length_;
  bound[arc_.first] = bound[arc_.second] = outward + around;
  return bound;
}

// Of an axis whose first slope is 0, on an arc or a cubic.
bool Curve::bends(Axis axis) const {
  if (shape_ == Shape::cubic) return square_[axis] != 0 || cube_[axis] != 0;
  return shape_ == Shape::arc && (axis == arc_.first || axis == arc_.second) && steepest()[axis] != 0;
}

// A cubic's second derivative is linear. A slope is a quadratic; one of at most k changes at a rate of at most 8 k /
// length (Markov).
double Curve::turning(const Point& steep) const {
  if (shape_ == Shape::arc) return std::abs(arc_.sweep);
  if (shape_ == Shape::line) return 0;
  const Point bends[] = {second_derivative(Mm(0)), second_derivative(Mm(length_))};
  double most = 0;
  for (const Point& bend : bends) {
    double squares = 0;
    for (std::size_t i = 0; i < axis_count; ++i) {
      const double part = steep.values[i] > 1 ? bend.values[i] / steep.values[i] : bend.values[i];
      squares += part * part;
    }
    most = std::max(most, squares);
  }
  return length_ * std::sqrt(most);
}

double Curve::curvature() const {
  if (shape_ == Shape::line || !(length_ > 0)) return 0;
  if (shape_ == Shape::cubic) {
    return std::max(length_of(second_derivative(Mm(0))), length_of(second_derivative(length())));
  }
  // r'' = 0 and angle'' = 0. What is left is the pull towards the centre and, in a spiral, the sideways part.
  const double turning = arc_.sweep / length_;
  const double outward = (arc_.end_radius - arc_.start_radius) / length_;
  return std::hypot(std::max(arc_.start_radius, arc_.end_radius) * turning * turning, 2 * outward * turning);
}

std::array<Mm, 2> Curve::turning_points(Axis axis) const {
  const double a = 3 * cube_[axis];
  const double b = square_[axis];
  const double c = slope_[axis];
  const double root = b * b - a * c;
  std::array<Mm, 2> places = {Mm(-1), Mm(-1)};
  if (shape_ != Shape::cubic || root < 0) return places;
  const double q = -(b + std::copysign(std::sqrt(root), b));  // both roots without cancellation: q / a and c / q
  if (a != 0 && q / a > 0 && q / a < length_) places[0] = Mm(q / a);
  if (q != 0 && c / q > 0 && c / q < length_) places[1] = Mm(c / q);
  return places;
}

void Curve::widen_by_turning_points(Box& box) const {
  for (const Axis axis : all_axes) {
    for (const Mm place : turning_points(axis)) {
      if (place < Mm(0)) continue;
      const double reached = at(place)[axis];
      box.low[axis] = std::min(box.low[axis], reached);
      box.high[axis] = std::max(box.high[axis], reached);
    }
  }
}

Curve Curve::turned(double cosine, double sine) const {
  const auto turn = [&](double& x, double& y) {
    const double from = x;
    x = from * cosine - y * sine;
    y = from * sine + y * cosine;
  };
  Curve turned = *this;
  for (Point* const of : {&turned.start_, &turned.end_, &turned.slope_, &turned.square_, &turned.cube_}) {
    turn((*of)[Axis::x], (*of)[Axis::y]);
  }
  if (shape_ == Shape::arc && arc_.first == Axis::x && arc_.second == Axis::y) {
    turn(turned.arc_.first_center, turned.arc_.second_center);
    turned.arc_.start_angle += std::atan2(sine, cosine);
  }
  return turned;
}

Curve Curve::with_turns_scaled(double by) const {
  Curve scaled = *this;
  for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
    for (Point* const of : {&scaled.start_, &scaled.end_, &scaled.slope_, &scaled.square_, &scaled.cube_}) {
      (*of)[axis] *= by;
    }
  }
  return scaled;
}

Box Curve::extents_of_ends() const {
  Box box;
  for (std::size_t i = 0; i < axis_count; ++i) {
    box.low.values[i] = std::min(start_.values[i], end_.values[i]);
    box.high.values[i] = std::max(start_.values[i], end_.values[i]);
  }
  return box;
}

Box Curve::bounds() const {
  if (shape_ != Shape::arc) return extents();
  Box box = extents_of_ends();
  const double radius = std::max(arc_.start_radius, arc_.end_radius);
  const auto widen = [&](Axis axis, double center) {
    box.low[axis] = std::min(box.low[axis], center - radius);
    box.high[axis] = std::max(box.high[axis], center + radius);
  };
  widen(arc_.first, arc_.first_center);
  widen(arc_.second, arc_.second_center);
  return box;
}

Box Curve::extents() const {
  Box box = extents_of_ends();
  if (shape_ == Shape::cubic) widen_by_turning_points(box);
  if (shape_ == Shape::arc) {
    const auto widen = [&box](Axis axis, double center, double up, double down) {
      if (up > 0) box.high[axis] = std::max(box.high[axis], center + up);
      if (down > 0) box.low[axis] = std::min(box.low[axis], center - down);
    };
    widen(arc_.first, arc_.first_center, reach(arc_, 0), reach(arc_, pi));
    widen(arc_.second, arc_.second_center, reach(arc_, pi / 2), reach(arc_, -pi / 2));
  }
  return box;
}

}  // namespace passo
