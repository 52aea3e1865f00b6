#include "cubic_motor_position.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double crossing_precision = 0.01;  // places
constexpr double behind_turn = 1e-7;         // share of the length
// A target at most this far behind the motor counts as just reached. The rounding of a place is always smaller.
constexpr double place_rounding = 1;

// Crossings are near if the slope changes by less than this share on the way: then each round of the search comes much
// closer.
constexpr double near_change = 0.25;
// A last round that begins this close, in places, ends within crossing_precision. The first terms of the series already
// leave less than a tenth of the way, so the round changes the slope by less than a fortieth; it leaves half of the
// square of that share.
constexpr double last_off = 16;
constexpr int most_rounds = 4;

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

CubicMotorPosition::CubicMotorPosition(const Curve& curve, const MotorRow& motor, double end) : end_(end) {
  const Curve::CubicData cubic = curve.cubic_data();
  base_ = place_of(motor, curve.start());
  first_ = motor.steps.of(cubic.first) * place_per_step;
  second_ = motor.steps.of(cubic.second) * place_per_step;
  third_ = motor.steps.of(cubic.third) * place_per_step;
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

double CubicMotorPosition::crossing(double target, double from) const {
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

// The first terms of s as a series of the place come close. Newton's method with the bend makes that exact, mostly in
// one round.
std::size_t CubicMotorPosition::look_ahead(double target, double step, double from, Lanes& s) const {
  const double steep = slope(from);
  const double third = third_;
  const double bend = second_ + 3 * third * from;
  const double slowness = 1 / steep;
  const double gap = target - at(from);
  const double first = gap * slowness;
  const double each = step * slowness;
  if (!(first >= 0 && each > 0)) return 0;
  const auto is_near = [&](std::size_t lane) {
    const double way = first + lane_numbers[lane] * each;
    return way * (2 * std::fabs(bend) + 3 * std::fabs(third) * way) < near_change * std::fabs(steep);
  };
  std::size_t near = lane_count;
  while (near > 0 && !is_near(near - 1)) --near;
  if (near == 0) return 0;

  Lanes way;
  for (std::size_t i = 0; i < lane_count; ++i) {
    const double straight = first + lane_numbers[i] * each;
    const double bent = bend * slowness * straight;
    const double changed = third * slowness * straight * straight;
    way[i] = straight * (1 - bent * (1 - 2 * bent) - changed + 5 * bent * (changed - bent * bent));
  }
  for (int round = 0; round < most_rounds; ++round) {
    Lanes off;
    for (std::size_t i = 0; i < lane_count; ++i) {
      const double u = way[i];
      const double bend_there = bend + 3 * third * u;
      const double slower = 1 / (steep + u * (2 * bend + u * 3 * third));
      const double left = gap + lane_numbers[i] * step - u * (steep + u * (bend + u * third));
      const double more = left * slower;
      off[i] = std::fabs(left);
      way[i] = u + more * (1 - more * slower * bend_there);
      s[i] = from + (way[i] > 0 ? way[i] : 0);
    }
    if (*std::max_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(near)) <= last_off) return near;
  }
  return 0;
}

// The slope grows with the bend, whichever its sign. Near a turning point that makes the motor fast.
double CubicMotorPosition::travel(double distance, double from) const {
  const double steep = std::fabs(slope(from));
  const double bend = std::fabs(second_ + 3 * third_ * from);
  if (steep + bend == 0) return std::cbrt(distance / std::fabs(third_));
  return 2 * distance / (steep + std::sqrt(steep * steep + 4 * bend * distance));
}

}  // namespace passo
