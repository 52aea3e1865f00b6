#include "motor_path.hpp"

#include <numbers>

namespace passo {
namespace {

constexpr double pi = std::numbers::pi;
// Radians. So far after a turning point, s is certainly past the turn, and the place has hardly changed.
constexpr double behind_turn = 1e-7;

bool goes_straight(const Curve::CubicData& cubic, Axis axis) {
  return cubic.second[axis] == 0 && cubic.third[axis] == 0;
}

}  // namespace

void MotorPath::start(const Curve& curve, double end, const StepOptions& options) {
  curve_ = &curve;
  end_ = end;
  turn_ = 0;
  motors_ = options.motor_count;
  const bool arc = curve.shape() == Curve::Shape::arc;
  if (arc) start_arc(curve.arc_data(), curve.length().value());
  for (unsigned m = 0; m < options.motor_count; ++m) {
    const Motor& motor = options.motors[m];
    if (arc && (motor.axis == curve.arc_data().first || motor.axis == curve.arc_data().second)) {
      terms_[m] = round_term(motor, curve.arc_data());
    } else if (curve.shape() == Curve::Shape::cubic && !goes_straight(curve.cubic_data(), motor.axis)) {
      terms_[m].way = Way::cubic;
      cubics_[m] = CubicPlace(curve, motor, end);
    } else {
      terms_[m] = straight_term(motor);
    }
  }
}

void MotorPath::start_arc(const Curve::ArcData& arc, double length) {
  turn_ = arc.sweep / length;
  angle_ = arc.start_angle;
  radius_ = arc.start_radius;
  growth_ = (arc.end_radius - arc.start_radius) / length;
}

MotorPath::Term MotorPath::straight_term(const Motor& motor) const {
  const double base = place_of(motor, curve_->start());
  const double length = curve_->length().value();
  return {.base = base, .scale = length > 0 ? (place_of(motor, curve_->end()) - base) / length : 0};
}

MotorPath::Term MotorPath::round_term(const Motor& motor, const Curve::ArcData& arc) {
  const bool first = motor.axis == arc.first;
  const double scale = motor.steps_per_unit * place_per_step;
  return {.way = Way::round,
          .on_cosine = first,
          .base = (first ? arc.first_center : arc.second_center) * scale + 0.5 * place_per_step,
          .scale = scale,
          // cos(a) = sin(a + pi/2): one formula for both axes.
          .angle = arc.start_angle + (first ? pi / 2 : 0)};
}

double MotorPath::turning_point(unsigned motor, double from) const {
  const Term& term = terms_[motor];
  switch (term.way) {
    case Way::round: return turning_point_round(term, from);
    case Way::cubic: return cubics_[motor].turning_point(from);
    case Way::straight: break;
  }
  return infinity;
}

double MotorPath::travel(unsigned motor, double distance, double from) const {
  const Term& term = terms_[motor];
  switch (term.way) {
    case Way::round: return travel_round(motor, distance, from);
    case Way::cubic: return cubics_[motor].travel(distance, from);
    case Way::straight: break;
  }
  return term.scale == 0 ? infinity : distance / std::fabs(term.scale);
}

// Do not call it for a motor that moves round.
Parabola MotorPath::slope_of(unsigned motor) const {
  const Term& term = terms_[motor];
  return term.way == Way::cubic ? cubics_[motor].slope() : Parabola{.a = term.scale};
}

double MotorPath::leads_until(unsigned master, int sign, double takeover, double from) const {
  if (turn_ != 0) return from;
  const Parabola own = slope_of(master);
  const double own_share = -sign * takeover;
  double until = infinity;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == master) continue;
    const Parabola other = slope_of(m);
    for (const double way : {1.0, -1.0}) {
      const Parabola ahead{way * other.a + own_share * own.a, way * other.b + own_share * own.b,
                           way * other.c + own_share * own.c};
      until = std::min(until, ahead.above_zero(from));
    }
  }
  return until;
}

double MotorPath::reach(unsigned motor, const Spot& spot) const {
  const Term& term = terms_[motor];
  switch (term.way) {
    case Way::round: return std::fabs(term.scale) * radius_;
    case Way::cubic: return std::fabs(cubics_[motor].slope(spot.s)) * curve_->length().value() / curve_->turning();
    case Way::straight: break;
  }
  return infinity;
}

MotorPath::Spot MotorPath::on_circle(double s) const {
  const double angle = angle_ + turn_ * s;
  return {.s = s, .cosine = std::cos(angle), .sine = std::sin(angle)};
}

double MotorPath::place_round(const Term& term, const Spot& spot) const {
  return term.base + term.scale * radius_at(spot.s) * (term.on_cosine ? spot.cosine : spot.sine);
}

double MotorPath::slope_round(const Term& term, const Spot& spot) const {
  const double speed = radius_at(spot.s) * turn_;
  return term.scale *
         (term.on_cosine ? growth_ * spot.cosine - speed * spot.sine : growth_ * spot.sine + speed * spot.cosine);
}

double MotorPath::crossing_round(unsigned motor, double target, const Spot& spot) const {
  const double from = spot.s;
  const Term& term = terms_[motor];
  const double sine = (target - term.base) / (term.scale * radius_at(from));
  if (!(std::fabs(sine) <= 1)) return infinity;
  // The sine rises on one half of the turn and falls on the other. The result must be on the same half as `from`.
  const double here = angle_at(term, from);
  const bool sine_rises = (slope_round(term, spot) > 0) == (term.scale * turn_ > 0);
  const double principal = sine_rises ? std::asin(sine) : pi - std::asin(sine);
  const double turns = std::round((here - principal) / (2 * pi));
  const double s = (principal + turns * 2 * pi - term.angle) / turn_;
  if (growth_ != 0) return crossing_on_spiral(motor, target, from, s);
  return std::max(from, s);
}

// `guess` is the crossing on a circle of constant radius. Newton's method makes the guess exact. Near a turning point
// Newton's method may run away; then bisection finds the crossing.
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

double MotorPath::turning_point_round(const Term& term, double from) const {
  // The sine turns back at odd multiples of a right angle. On a spiral whose radius grows, the motor turns back a
  // little later.
  const double lag = std::atan(growth_ / (radius_at(from) * turn_));
  const double quarter = (angle_at(term, from) - lag - pi / 2) / pi;
  const double next = turn_ > 0 ? std::floor(quarter + 1e-9) + 1 : std::ceil(quarter - 1e-9) - 1;
  return (next * pi + pi / 2 + lag - term.angle) / turn_ + behind_turn / std::fabs(turn_);
}

double MotorPath::travel_round(unsigned motor, double distance, double from) const {
  const Spot spot = at(from);
  const double here = place(motor, spot);
  const double step = slope(motor, spot) > 0 ? distance : -distance;
  const double ahead = crossing(motor, here + step, spot);
  if (ahead < infinity) return ahead - from;
  return crossing(motor, here - step, at(turning_point(motor, from))) - from;
}

}  // namespace passo
