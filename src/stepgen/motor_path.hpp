// MotorPath: where every motor stands as a function of s, for one curve.
//
// Places are in the board's own units: 1/65536 of a step with half a step added, so that a motor's step count is the
// whole part of place/65536 and a step happens where the place crosses a multiple of 65536.
#pragma once

#include <array>

#include "passo/geometry/curve.hpp"
#include "passo/stepgen/step_generator.hpp"

namespace passo {

// Units of place a step.
inline constexpr double place_per_step = 65536.0;

inline double place_of(const Motor& motor, const Point& point) {
  return (point[motor.axis] * motor.steps_per_unit + 0.5) * place_per_step;
}

class MotorPath {
 public:
  MotorPath() = default;
  MotorPath(const Curve& curve, const StepOptions& options);

  // A place on the curve with what all motors need of it, computed once: on an arc, where it stands on its circle.
  struct Spot {
    double s = 0;
    double cosine = 1;
    double sine = 0;
  };
  Spot at(double s) const;

  double place(unsigned motor, const Spot& spot) const;
  // d place / ds: negative where the motor counts down.
  double slope(unsigned motor, const Spot& spot) const;

  // The first s >= from where the motor's place, going on in the direction it has at `from`, reaches `target`.
  // Infinity if it turns back before, or stands still. May lie beyond the end of the curve.
  double crossing(unsigned motor, double target, const Spot& from) const;
  // Just behind the first place after `from` where the motor turns back; infinity if it never does.
  double turning_point(unsigned motor, double from) const;
  // How much s it takes until the motor is `distance` away from where it is at `from`, turning back or not: what "fast"
  // means also where a motor turns back and its slope is nothing. Infinity if it never gets there.
  double travel(unsigned motor, double distance, double from) const;
  // The radius on which the motor turns, in places; infinity where it goes straight.
  double reach(unsigned motor) const;
  bool is_turning(unsigned motor) const { return terms_[motor].turning; }

  bool is_straight() const { return straight_; }
  double length() const { return length_; }

 private:
  // place = center + scale * radius(s) * cos or sin(angle(s)), or start + slope * s.
  struct Term {
    bool turning = false;
    bool on_cosine = false;  // the first axis of the plane
    double base = 0;         // place at s = 0, or of the centre
    double scale = 0;        // slope, or places a millimetre of radius
    double angle = 0;        // at s = 0, as the argument of a sine for both axes
  };
  double crossing_on_spiral(unsigned motor, double target, double from, double guess) const;
  double angle_at(const Term& term, double s) const { return term.angle + turn_ * s; }
  double radius_at(double s) const { return radius_ + growth_ * s; }

  std::array<Term, max_motors> terms_;
  bool straight_ = true;
  double length_ = 0;
  double angle_ = 0;   // at s = 0
  double turn_ = 0;    // radians a millimetre of s
  double radius_ = 0;  // at s = 0
  double growth_ = 0;  // of the radius, a millimetre of s
};

}  // namespace passo
