#include "turn_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace passo {
namespace {

constexpr std::array rotary_axes = {Axis::a, Axis::b, Axis::c};

// A tolerance that is a quotient of decimal numbers is off by less.
constexpr double rounding_of_ratio = 1e-12;

// Below this share of the first power of a unit the second one gains nothing.
constexpr double least_gain = 1e-3;

// A unit that is smaller than possible by up to this factor is kept: a stop would cost more.
constexpr double worth_a_stop = 1.5;

// Of an exact path, as in RunReader. There, degrees and millimetres have the same tolerance.
constexpr Mm exact_turn_tolerance{0.001};

bool turns(const Segment& segment) {
  return std::ranges::any_of(rotary_axes, [&](Axis axis) { return segment.curve.moves(axis); });
}

double unit_for(const Segment& segment) {
  if (!(segment.turn_tolerance > 0) || !(segment.tolerance > Mm(0))) return 1;
  return largest_turn_unit(segment.turn_tolerance / segment.tolerance.value());
}

bool suits(double unit, const Segment& segment) {
  const double most = unit_for(segment);
  return unit <= most && unit * worth_a_stop >= most;
}

// Keeps the deviation of A, B and C within their tolerance, in a unit that was chosen for another segment.
void narrow(Segment& segment, double unit) {
  const double turns = segment.turn_tolerance > 0  ? segment.turn_tolerance
                       : segment.tolerance > Mm(0) ? segment.tolerance.value()
                                                   : exact_turn_tolerance.value();
  const Mm most(turns / unit);
  if (segment.tolerance > Mm(0)) {
    segment.tolerance = std::min(segment.tolerance, most);
  } else if (most < exact_turn_tolerance && segment.mode == PathMode::exact_path) {
    segment.tolerance = most;
  }
  segment.merge = std::min(segment.merge, segment.tolerance / 2);
}

Point divided(Point point, double unit) {
  for (const Axis axis : rotary_axes) point[axis] /= unit;
  return point;
}

Curve divided(const Curve& curve, double unit, const SurfaceScale& surface) {
  const Point start = divided(curve.start(), unit);
  const Point end = divided(curve.end(), unit);
  switch (curve.shape()) {
    case Curve::Shape::line: return Curve::line(start, end, surface);
    case Curve::Shape::arc: return Curve::arc(start, end, curve.arc_data(), surface);
    case Curve::Shape::cubic: break;
  }
  return Curve::cubic(start, divided(curve.tangent(Mm(0)), unit), end, divided(curve.tangent(curve.length()), unit),
                      curve.length());
}

}  // namespace

double largest_turn_unit(double ratio) {
  const double most = ratio * (1 + rounding_of_ratio);
  const double first = std::exp2(std::ilogb(most));
  const double rest = most - first;
  return rest > first * least_gain ? first + std::exp2(std::ilogb(rest)) : first;
}

double with_52_bits(double value) {
  if (value == 0) return value;  // an axis that is not there
  int exponent = 0;
  const double significand = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(significand, 52)), exponent - 52);
}

bool TurnScale::pull() {
  if (!has_ahead_ && !at_end_) {
    has_ahead_ = path_.next(ahead_);
    at_end_ = !has_ahead_;
  }
  return has_ahead_;
}

bool TurnScale::next(PathItem& item) {
  if (has_ahead_) {
    std::swap(item, ahead_);
    has_ahead_ = false;
  } else if (at_end_ || !path_.next(item)) {
    return false;
  }
  auto* const segment = std::get_if<Segment>(&item);
  if (segment == nullptr) {
    rests_ = true;
    return true;
  }
  if (share_ != 1) {
    segment->tolerance = segment->tolerance * share_;
    segment->merge = segment->merge * share_;
    segment->turn_tolerance *= share_;
  }
  scale(*segment);
  if (has_tolerance_ && segment->mode != PathMode::exact_stop && pull()) {
    const auto* const after = std::get_if<Segment>(&ahead_);
    if (after != nullptr && turns(*after) && (is_wide_ || !suits(unit_, *after))) segment->mode = PathMode::exact_stop;
  }
  rests_ = segment->mode == PathMode::exact_stop;
  return true;
}

void TurnScale::scale(Segment& segment) {
  has_tolerance_ = has_tolerance_ || segment.turn_tolerance > 0;
  if (!has_tolerance_) return;
  if (rests_) {
    unit_ = unit_for(segment);
    has_turned_ = is_wide_ = false;
  }
  has_turned_ = has_turned_ || turns(segment);
  if (has_turned_) {
    narrow(segment, unit_);
  } else {
    is_wide_ = is_wide_ || unit_ > unit_for(segment);
  }
  if (unit_ == 1) return;
  segment.surface = segment.surface.in_units_of(unit_);
  segment.curve = divided(segment.curve, unit_, segment.surface);
}

void convert_to_degrees(Segment& segment) {
  const double unit = segment.surface.unit;
  if (unit == 1) return;
  segment.curve = segment.curve.with_turns_scaled(unit);
  segment.surface = segment.surface.in_units_of(1 / unit);
  segment.surface.unit = 1;
}

}  // namespace passo
