#include "motor_path.hpp"

#include <algorithm>
#include <numbers>

namespace passo {
namespace {

using std::numbers::pi;
// Radians. So far after a turning point, s is certainly past the turn, and the place has hardly changed.
constexpr double behind_reversal = 1e-7;

// A crossing is near if the arc turns by less than this on the way (radians), and the motor's slope changes by less
// than a quarter. Then the slope keeps its sign, and each round of the search comes much closer.
constexpr double near_turn = 0.125;
constexpr double near_bend = 0.125;  // half of that change
// A last round by this many radians leaves an error of half its square: 5e-13 of the radius.
constexpr double last_turn = 1e-6;
constexpr int most_search_rounds = 4;
// A target at most so many places behind the motor counts as just reached.
constexpr double position_rounding = 1;

bool goes_straight(const Curve::CubicData& cubic, const AxisRow& row) {
  return row.of(cubic.second) == 0 && row.of(cubic.third) == 0;
}

bool goes_round(const Curve::ArcData& arc, const AxisRow& row) {
  return row.factor_of(arc.first) != 0 || row.factor_of(arc.second) != 0;
}

// Of a near turn, to the last digits: the next term is below 1e-17.
double near_sine(double angle) {
  const double x = angle * angle;
  return angle * (1 + x * (-1.0 / 6 + x * (1.0 / 120 + x * (-1.0 / 5040 + x * (1.0 / 362'880)))));
}
double near_cosine(double angle) {
  const double x = angle * angle;
  return 1 + x * (-1.0 / 2 + x * (1.0 / 24 + x * (-1.0 / 720 + x * (1.0 / 40'320 - x * (1.0 / 3'628'800)))));
}

}  // namespace

void MotorPath::start(const Curve& curve, double end, std::span<const MotorRow> motors) {
  curve_ = &curve;
  end_ = end;
  turn_ = 0;
  motors_ = static_cast<unsigned>(motors.size());
  const bool arc = curve.shape() == Curve::Shape::arc;
  if (arc) start_arc(curve.arc_data(), curve.length().value());
  for (unsigned m = 0; m < motors_; ++m) {
    const MotorRow& motor = motors[m];
    if (arc && goes_round(curve.arc_data(), motor.steps)) {
      terms_[m] = round_term(motor, curve.arc_data());
    } else if (curve.shape() == Curve::Shape::cubic && !goes_straight(curve.cubic_data(), motor.steps)) {
      terms_[m].way = Way::cubic;
      cubics_[m] = CubicMotorPosition(curve, motor, end);
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

MotorPath::Term MotorPath::straight_term(const MotorRow& motor) const {
  const double base = place_of(motor, curve_->start());
  const double length = curve_->length().value();
  return {.base = base, .scale = length > 0 ? (place_of(motor, curve_->end()) - base) / length : 0};
}

MotorPath::Term MotorPath::round_term(const MotorRow& motor, const Curve::ArcData& arc) const {
  const double first = motor.steps.factor_of(arc.first);
  const double second = motor.steps.factor_of(arc.second);
  // A motor that sees one axis keeps its sign.
  const double factor = second == 0 ? first : first == 0 ? second : std::hypot(first, second);
  const double scale = factor * place_per_step;
  Point center = curve_->start();
  Point straight = curve_->end() - center;
  center[arc.first] = arc.first_center;
  center[arc.second] = arc.second_center;
  straight[arc.first] = straight[arc.second] = 0;
  return {.way = Way::round,
          .base = motor.steps.of(center) * place_per_step + (motor.offset + 0.5) * place_per_step,
          .scale = scale,
          .cosine = first / factor,
          .sine = second / factor,
          .drift = motor.steps.of(straight) * place_per_step / curve_->length().value(),
          // cosine * cos(a) + sine * sin(a) is the sine of this.
          .angle = arc.start_angle + std::atan2(first / factor, second / factor),
          .sharpest = std::fabs(scale * turn_) *
                      (std::max(arc.start_radius, arc.end_radius) * std::fabs(turn_) + 2 * std::fabs(growth_))};
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

double MotorPath::leads_until(unsigned master, int sign, double takeover, const Spot& from) const {
  if (turn_ != 0) return leads_on_arc(master, sign, takeover, from);
  const Parabola own = slope_of(master);
  const double own_share = -sign * takeover;
  double until = infinity;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == master) continue;
    const Parabola other = slope_of(m);
    for (const double way : {1.0, -1.0}) {
      const Parabola ahead{way * other.a + own_share * own.a, way * other.b + own_share * own.b,
                           way * other.c + own_share * own.c};
      until = std::min(until, ahead.above_zero(from.s));
    }
  }
  return until;
}

// Each slope changes at most as fast as its motor's place bends.
double MotorPath::leads_on_arc(unsigned master, int sign, double takeover, const Spot& from) const {
  const double own = sign * takeover * slope(master, from);
  if (!(own > 0)) return from.s;
  const double own_sharpest = takeover * terms_[master].sharpest;
  double way = own / own_sharpest;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == master) continue;
    way = std::min(way, (own - std::fabs(slope(m, from))) / (own_sharpest + terms_[m].sharpest));
  }
  return from.s + std::max(way, 0.0);
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

// The first terms of s as a series of the place come close, with P'' and, as on a circle, P''' = -turn² P'. The same
// with P'' of the place found makes that exact: on all but the smallest arcs one round does. From the spot where the
// search begins, cosine and sine of the others follow by series of the small angles between.
void MotorPath::look_ahead_round(unsigned motor, double target, double step, double from, Spots& ahead) const {
  ahead.count = 0;
  const Term& term = terms_[motor];
  const Spot spot = at(from);
  const Arm start = arm(term, spot);
  const double slowness = 1 / slope_round(term, start, radius_at(from));
  const double first = (target - place_round(term, spot)) * slowness;
  const double each = step * slowness;
  const double bend = bend_round(term, start, radius_at(from)) * slowness / 2;
  if (!(first >= 0 && each > 0)) return;
  const auto is_near = [&](std::size_t lane) {
    const double last = first + lane_numbers[lane] * each;
    return last * std::fabs(turn_) < near_turn && last * std::fabs(bend) < near_bend;
  };
  std::size_t near = lane_count;
  while (near > 0 && !is_near(near - 1)) --near;
  if (near == 0) return;

  Lanes way;
  for (std::size_t i = 0; i < lane_count; ++i) {
    const double straight = first + lane_numbers[i] * each;
    const double turned = turn_ * straight;
    const double bent = bend * straight;
    const double square = turned * turned;
    way[i] = straight * (1 - bent * (1 - 2 * bent + 5 * bent * bent + 0.75 * square) + square * (1.0 / 6));
  }
  Lanes outward;
  Lanes around;
  Lanes left;
  const auto search = [&](const auto& straight_at) {
    for (int round = 0; round < most_search_rounds && ahead.count == 0; ++round) {
      for (std::size_t i = 0; i < lane_count; ++i) {
        const double sine = near_sine(turn_ * way[i]);
        const double cosine = near_cosine(turn_ * way[i]);
        const Arm there{start.outward * cosine + start.around * sine, start.around * cosine - start.outward * sine};
        const double radius = radius_at(from + way[i]);
        const double off =
            target + lane_numbers[i] * step - (straight_at(from + way[i]) + term.scale * radius * there.outward);
        const double more = off / slope_round(term, there, radius);
        const double angle = turn_ * more;
        const double still = 1 - angle * angle / 2;
        way[i] += more;
        left[i] = std::fabs(angle);
        outward[i] = there.outward * still + there.around * angle;
        around[i] = there.around * still - there.outward * angle;
      }
      const auto last = left.begin() + static_cast<std::ptrdiff_t>(near);
      if (*std::max_element(left.begin(), last) <= last_turn) ahead.count = near;
    }
  };
  // The loop is compiled twice: most motors do not drift.
  if (term.drift == 0) {
    search([&](double) { return term.base; });
  } else {
    search([&](double s) { return term.base + term.drift * s; });
  }
  for (std::size_t i = 0; i < lane_count; ++i) ahead.s[i] = from + (way[i] > 0 ? way[i] : 0);
  // The same as below, without products.
  if (term.sine == 0) {
    ahead.cosine = outward;
    for (std::size_t i = 0; i < lane_count; ++i) ahead.sine[i] = -around[i];
  } else if (term.cosine == 0) {
    ahead.cosine = around;
    ahead.sine = outward;
  } else {
    for (std::size_t i = 0; i < lane_count; ++i) {
      ahead.cosine[i] = term.cosine * outward[i] + term.sine * around[i];
      ahead.sine[i] = term.sine * outward[i] - term.cosine * around[i];
    }
  }
}

void MotorPath::look_ahead(unsigned motor, double target, double step, double from, Spots& ahead) const {
  switch (terms_[motor].way) {
    case Way::round: return look_ahead_round(motor, target, step, from, ahead);
    case Way::cubic: ahead.count = cubics_[motor].look_ahead(target, step, from, ahead.s); return;
    case Way::straight: break;
  }
  ahead.count = turn_ == 0 ? lane_count : 0;
  const Term term = terms_[motor];
  for (std::size_t i = 0; i < lane_count; ++i) {
    const double s = (target + lane_numbers[i] * step - term.base) / term.scale;
    ahead.s[i] = s > from ? s : from;
  }
}

void MotorPath::places(unsigned motor, const Spots& spots, Lanes& places) const {
  const Term term = terms_[motor];
  const CubicMotorPosition cubic = cubics_[motor];
  const auto fill = [&](const auto& place) {
    for (std::size_t i = 0; i < lane_count; ++i) places[i] = place(spots[i]);
  };
  if (term.way == Way::round && is_of_one_axis(term)) {
    const Lanes& outward = term.sine == 0 ? spots.cosine : spots.sine;
    const double radius = radius_;
    const double growth = growth_;
    for (std::size_t i = 0; i < lane_count; ++i) {
      places[i] = term.base + term.scale * (radius + growth * spots.s[i]) * outward[i];
    }
    return;
  }
  switch (term.way) {
    case Way::round: return fill([&](const Spot& spot) { return place_round(term, spot); });
    case Way::cubic: return fill([&](const Spot& spot) { return cubic.at(spot.s); });
    case Way::straight: return fill([&](const Spot& spot) { return term.base + term.scale * spot.s; });
  }
}

void MotorPath::slopes(unsigned motor, const Spots& spots, Lanes& slopes) const {
  const Term term = terms_[motor];
  const CubicMotorPosition cubic = cubics_[motor];
  const auto fill = [&](const auto& slope) {
    for (std::size_t i = 0; i < lane_count; ++i) slopes[i] = slope(spots[i]);
  };
  if (term.way == Way::round && is_of_one_axis(term)) {
    const Lanes& outward = term.sine == 0 ? spots.cosine : spots.sine;
    const Lanes& around = term.sine == 0 ? spots.sine : spots.cosine;
    const double turn = term.sine == 0 ? -turn_ : turn_;
    const double radius = radius_;
    const double growth = growth_;
    for (std::size_t i = 0; i < lane_count; ++i) {
      slopes[i] = term.scale * (growth * outward[i] + (radius + growth * spots.s[i]) * turn * around[i]);
    }
    return;
  }
  switch (term.way) {
    case Way::round: return fill([&](const Spot& spot) { return slope_round(term, spot); });
    case Way::cubic: return fill([&](const Spot& spot) { return cubic.slope(spot.s); });
    case Way::straight: return fill([&](const Spot&) { return term.scale; });
  }
}

MotorPath::Spot MotorPath::crossing_round(unsigned motor, double target, const Spot& spot) const {
  Spots ahead;
  look_ahead_round(motor, target, std::copysign(place_per_step, target - place(motor, spot)), spot.s, ahead);
  if (ahead.count > 0) return ahead[0];
  const double from = spot.s;
  const Term& term = terms_[motor];
  if (term.drift != 0) return at(crossing_with_drift(motor, target, from));
  const double sine = (target - term.base) / (term.scale * radius_at(from));
  if (!(std::fabs(sine) <= 1)) return {.s = infinity};
  // The sine rises on one half of the turn and falls on the other. Stay on the half that holds `from`.
  const double here = angle_at(term, from);
  const bool sine_rises = (slope_round(term, spot) > 0) == (term.scale * turn_ > 0);
  const double principal = sine_rises ? std::asin(sine) : pi - std::asin(sine);
  const double turns = std::round((here - principal) / (2 * pi));
  const double s = (principal + turns * 2 * pi - term.angle) / turn_;
  return at(growth_ != 0 ? crossing_on_spiral(motor, target, from, s) : std::max(from, s));
}

// `guess` is the crossing on a circle of constant radius. Newton's method makes the guess exact. Near a turning point
// Newton's method may run away; then bisection finds the crossing.
double MotorPath::crossing_on_spiral(unsigned motor, double target, double from, double guess) const {
  const double turn = turning_point(motor, from);
  double s = guess;
  for (int i = 0; i < 4; ++i) s -= (place(motor, at(s)) - target) / slope(motor, at(s));
  if (s >= from && s <= turn && std::fabs(place(motor, at(s)) - target) < 0.5) return s;

  return crossing_between(motor, target, from, turn);
}

// Where nothing bounds how far the motor goes before it turns back, its straight part does.
double MotorPath::crossing_with_drift(unsigned motor, double target, double from) const {
  const Term& term = terms_[motor];
  const double here = place(motor, at(from));
  const double left = slope(motor, at(from)) > 0 ? target - here : here - target;
  if (left <= 0 && left > -position_rounding) return from;
  const double turn = turning_point(motor, from);
  const double swing = 2 * std::fabs(term.scale) * std::max(radius_, radius_at(end_));
  const double way = (std::fabs(left) + swing) / std::fabs(term.drift);
  return crossing_between(motor, target, from, turn < infinity ? turn : from + way);
}

// By bisection. The motor does not turn back between the two.
double MotorPath::crossing_between(unsigned motor, double target, double from, double to) const {
  double low = from;
  double high = to;
  const bool rising = place(motor, at(high)) > place(motor, at(low));
  if ((place(motor, at(low)) < target) != rising || (place(motor, at(high)) > target) != rising) return infinity;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((place(motor, at(middle)) < target) == rising ? low : high) = middle;
  }
  return high;
}

double MotorPath::turning_point_round(const Term& term, double from) const {
  if (term.drift != 0) return turning_point_with_drift(term, from);
  // The sine turns back at odd multiples of a right angle. On a spiral whose radius grows, the motor turns back a
  // little later.
  const double lag = std::atan(growth_ / (radius_at(from) * turn_));
  const double quarter = (angle_at(term, from) - lag - pi / 2) / pi;
  const double next = turn_ > 0 ? std::floor(quarter + 1e-9) + 1 : std::ceil(quarter - 1e-9) - 1;
  return (next * pi + pi / 2 + lag - term.angle) / turn_ + behind_reversal / std::fabs(turn_);
}

// The motor turns back where its part of the circle goes just as fast against its drift. The slope of that part is
// steepest * cos(angle - lag). A radius that changes changes both a little: each round corrects that.
double MotorPath::turning_point_with_drift(const Term& term, double from) const {
  constexpr int rounds = 4;
  double radius = radius_at(from);
  double turn = infinity;
  for (int i = 0; i < rounds; ++i) {
    const double steepest = term.scale * std::copysign(std::hypot(growth_, radius * turn_), turn_);
    const double cosine = -term.drift / steepest;
    if (!(std::fabs(cosine) < 1)) return infinity;
    const double lag = std::atan(growth_ / (radius * turn_));
    const double here = angle_at(term, from) - lag;
    turn = infinity;
    for (const double angle : {std::acos(cosine), -std::acos(cosine)}) {
      const double turns = (here - angle) / (2 * pi);
      const double next = turn_ > 0 ? std::floor(turns + 1e-9) + 1 : std::ceil(turns - 1e-9) - 1;
      turn = std::min(turn, (angle + next * 2 * pi + lag - term.angle) / turn_);
    }
    radius = radius_at(turn);
  }
  return turn + behind_reversal / std::fabs(turn_);
}

double MotorPath::travel_round(unsigned motor, double distance, double from) const {
  const Spot spot = at(from);
  const double here = place(motor, spot);
  const double step = slope(motor, spot) > 0 ? distance : -distance;
  const double ahead = crossing(motor, here + step, spot).s;
  if (ahead < infinity) return ahead - from;
  return crossing(motor, here - step, at(turning_point(motor, from))).s - from;
}

}  // namespace passo
