#include "cubic_place.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double crossing_precision = 0.01;  // places
constexpr double behind_turn = 1e-7;         // share of the length
// A target at most this far behind the motor counts as just reached. The rounding of a place is always smaller.
constexpr double place_rounding = 1;

}  // namespace

double Parabola::above_zero(double from) const {
  if (at(from) > 0) return from;
  const double root = b * b - 4 * c * a;
  if (root < 0) return std::numeric_limits<double>::infinity();
  // Both roots without cancellation: q / c and a / q.
  const double q = -(b + std::copysign(std::sqrt(root), b)) / 2;
  double first = std::numeric_limits<double>::infinity();
  for (const double s : {q / c, a / q}) {
    if (s > from && s < first) first = s;
  }
  return first;
}

CubicPlace::CubicPlace(const Curve& curve, const Motor& motor, double end) : end_(end) {
  const double scale = motor.steps_per_unit * place_per_step;
  const Curve::CubicData cubic = curve.cubic_data();
  base_ = place_of(motor, curve.start());
  first_ = cubic.first[motor.axis] * scale;
  second_ = cubic.second[motor.axis] * scale;
  third_ = cubic.third[motor.axis] * scale;
  behind_turn_ = behind_turn * end;

  const double root = second_ * second_ - 3 * third_ * first_;
  if (root <= 0) return;
  // Both roots without cancellation: q / a and c / q.
  const double q = -(second_ + std::copysign(std::sqrt(root), second_));
  const auto inside = [&](double s) { return s > 0 && s < end_ ? s : infinity; };
  const double one = third_ != 0 ? inside(q / (3 * third_)) : infinity;
  const double other = inside(first_ / q);
  // Two turning points that are almost at the same s cancel each other.
  if (std::fabs(one - other) < 2 * behind_turn_) return;
  first_turn_ = std::min(one, other);
  second_turn_ = std::max(one, other);
}

double CubicPlace::crossing(double target, double from) const {
  const double end = next_end(from);
  const double here = at(from);
  const double whole = at(end) - here;
  const double sign = whole < 0 ? -1 : 1;
  const double way = sign * (target - here);
  if (way <= 0 && way > -place_rounding) return from;
  if (way < 0 || way > sign * whole) return end < end_ ? infinity : 2 * end_;
  const double bend = second_ + 3 * third_ * from;
  const ConstantJerk ahead{sign * slope(from), sign * 2 * bend, sign * 6 * third_};
  return from + ahead.time_to(way, end - from, ahead.soon(way), crossing_precision);
}

// Adds the bend to the slope without regard to signs: near a turning point the slope is 0, and the bend alone moves the
// motor.
double CubicPlace::travel(double distance, double from) const {
  const double steep = std::fabs(slope(from));
  const double bend = std::fabs(second_ + 3 * third_ * from);
  if (steep + bend == 0) return std::cbrt(distance / std::fabs(third_));
  return 2 * distance / (steep + std::sqrt(steep * steep + 4 * bend * distance));
}

}  // namespace passo
