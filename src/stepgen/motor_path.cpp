#include "motor_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

}  // namespace

MotorPath::MotorPath(const Curve& curve, const StepOptions& options)
    : straight_(curve.shape() == Curve::Shape::line), length_(curve.length().value()) {
  const Curve::ArcData& arc = curve.arc_data();
  if (!straight_) {
    turn_ = arc.sweep / length_;
    radius_ = arc.start_radius;
    growth_ = (arc.end_radius - arc.start_radius) / length_;
  }
  for (unsigned m = 0; m < options.motor_count; ++m) {
    const Motor& motor = options.motors[m];
    Term& term = terms_[m];
    const bool first = !straight_ && motor.axis == arc.first;
    const bool second = !straight_ && motor.axis == arc.second;
    term.turning = first || second;
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

double MotorPath::place(unsigned motor, double s) const {
  const Term& term = terms_[motor];
  if (!term.turning) return term.base + term.scale * s;
  return term.base + term.scale * radius_at(s) * std::sin(angle_at(term, s));
}

double MotorPath::slope(unsigned motor, double s) const {
  const Term& term = terms_[motor];
  if (!term.turning) return term.scale;
  const double angle = angle_at(term, s);
  return term.scale * (growth_ * std::sin(angle) + radius_at(s) * turn_ * std::cos(angle));
}

double MotorPath::crossing(unsigned motor, double target, double from) const {
  const Term& term = terms_[motor];
  if (!term.turning) {
    if (term.scale == 0) return infinity;
    return std::fmax(from, (target - term.base) / term.scale);
  }
  const double sine = (target - term.base) / (term.scale * radius_at(from));
  if (!(std::fabs(sine) <= 1)) return infinity;
  // The sine rises on one half of the turn and falls on the other: stay on the half where `from` is.
  const double here = angle_at(term, from);
  const double principal = std::cos(here) >= 0 ? std::asin(sine) : pi - std::asin(sine);
  const double turns = std::round((here - principal) / (2 * pi));
  double s = (principal + turns * 2 * pi - term.angle) / turn_;
  if (growth_ != 0) {
    // A slight spiral: the closed form is a guess that Newton's method makes exact.
    for (int i = 0; i < 4; ++i) s -= (place(motor, s) - target) / slope(motor, s);
    if (!(std::fabs(s - from) < infinity)) return infinity;
  }
  return std::fmax(from, s);
}

double MotorPath::turning_point(unsigned motor, double from) const {
  const Term& term = terms_[motor];
  if (!term.turning) return infinity;
  // The sine turns back at odd multiples of a right angle.
  const double quarter = (angle_at(term, from) - pi / 2) / pi;
  const double next = turn_ > 0 ? std::floor(quarter + 1e-9) + 1 : std::ceil(quarter - 1e-9) - 1;
  return (next * pi + pi / 2 - term.angle) / turn_;
}

}  // namespace passo
