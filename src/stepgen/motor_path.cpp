#include "motor_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
// Radians: far enough behind a turning point to be on the other side of it for certain, and no place further.
constexpr double behind_turn = 1e-7;

}  // namespace

MotorPath::MotorPath(const Curve& curve, const StepOptions& options)
    : straight_(curve.shape() == Curve::Shape::line), length_(curve.length().value()) {
  const Curve::ArcData& arc = curve.arc_data();
  if (!straight_) {
    turn_ = arc.sweep / length_;
    angle_ = arc.start_angle;
    radius_ = arc.start_radius;
    growth_ = (arc.end_radius - arc.start_radius) / length_;
  }
  for (unsigned m = 0; m < options.motor_count; ++m) {
    const Motor& motor = options.motors[m];
    Term& term = terms_[m];
    const bool first = !straight_ && motor.axis == arc.first;
    const bool second = !straight_ && motor.axis == arc.second;
    term.turning = first || second;
    term.on_cosine = first;
    if (term.turning) {
      term.scale = motor.steps_per_unit * place_per_step;
      term.base = (first ? arc.first_center : arc.second_center) * term.scale + 0.5 * place_per_step;
      // cos(a) = sin(a + pi/2): one formula for both axes.
      term.angle = arc.start_angle + (first ? pi / 2 : 0);
    } else {
      term.base = place_of(motor, curve.start());
      term.scale = length_ > 0 ? (place_of(motor, curve.end()) - term.base) / length_ : 0;
    }
  }
}

MotorPath::Spot MotorPath::at(double s) const {
  if (straight_) return {.s = s};
  const double angle = angle_ + turn_ * s;
  return {.s = s, .cosine = std::cos(angle), .sine = std::sin(angle)};
}

double MotorPath::place(unsigned motor, const Spot& spot) const {
  const Term& term = terms_[motor];
  if (!term.turning) return term.base + term.scale * spot.s;
  return term.base + term.scale * radius_at(spot.s) * (term.on_cosine ? spot.cosine : spot.sine);
}

double MotorPath::reach(unsigned motor) const {
  const Term& term = terms_[motor];
  return term.turning ? std::fabs(term.scale) * radius_ : infinity;
}

double MotorPath::slope(unsigned motor, const Spot& spot) const {
  const Term& term = terms_[motor];
  if (!term.turning) return term.scale;
  const double speed = radius_at(spot.s) * turn_;
  return term.scale *
         (term.on_cosine ? growth_ * spot.cosine - speed * spot.sine : growth_ * spot.sine + speed * spot.cosine);
}

double MotorPath::crossing(unsigned motor, double target, const Spot& spot) const {
  const double from = spot.s;
  const Term& term = terms_[motor];
  if (!term.turning) {
    if (term.scale == 0) return infinity;
    return std::fmax(from, (target - term.base) / term.scale);
  }
  const double sine = (target - term.base) / (term.scale * radius_at(from));
  if (!(std::fabs(sine) <= 1)) return infinity;
  // The sine rises on one half of the turn and falls on the other: stay on the half where `from` is.
  const double here = angle_at(term, from);
  const bool sine_rises = (slope(motor, spot) > 0) == (term.scale * turn_ > 0);
  const double principal = sine_rises ? std::asin(sine) : pi - std::asin(sine);
  const double turns = std::round((here - principal) / (2 * pi));
  double s = (principal + turns * 2 * pi - term.angle) / turn_;
  if (growth_ != 0) return crossing_on_spiral(motor, target, from, s);
  return std::fmax(from, s);
}

// The closed form, which takes the radius for constant, is a guess; Newton's method makes it exact, and bisection where
// that runs away near a turning point.
double MotorPath::crossing_on_spiral(unsigned motor, double target, double from, double guess) const {
  const double turn = turning_point(motor, from);
  double s = guess;
  for (int i = 0; i < 4; ++i) s -= (place(motor, at(s)) - target) / slope(motor, at(s));
  if (s >= from && s <= turn && std::fabs(place(motor, at(s)) - target) < 0.5) return s;

  double low = from;
  double high = turn;
  const bool rising = place(motor, at(high)) > place(motor, at(low));
  if ((place(motor, at(low)) < target) != rising || (place(motor, at(high)) > target) != rising) return infinity;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((place(motor, at(middle)) < target) == rising ? low : high) = middle;
  }
  return high;
}

double MotorPath::turning_point(unsigned motor, double from) const {
  const Term& term = terms_[motor];
  if (!term.turning) return infinity;
  // The sine turns back at odd multiples of a right angle; on a spiral a little later, where the growth of the radius
  // is made up for.
  const double lag = std::atan(growth_ / (radius_at(from) * turn_));
  const double quarter = (angle_at(term, from) - lag - pi / 2) / pi;
  const double next = turn_ > 0 ? std::floor(quarter + 1e-9) + 1 : std::ceil(quarter - 1e-9) - 1;
  return (next * pi + pi / 2 + lag - term.angle) / turn_ + behind_turn / std::fabs(turn_);
}

double MotorPath::travel(unsigned motor, double distance, double from) const {
  const Term& term = terms_[motor];
  if (!term.turning) return term.scale == 0 ? infinity : distance / std::fabs(term.scale);
  const Spot spot = at(from);
  const double here = place(motor, spot);
  const double step = slope(motor, spot) > 0 ? distance : -distance;
  const double ahead = crossing(motor, here + step, spot);
  if (ahead < infinity) return ahead - from;
  return crossing(motor, here - step, at(turning_point(motor, from))) - from;
}

}  // namespace passo
