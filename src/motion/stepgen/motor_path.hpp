// MotorPath: the position of every motor as a function of s, for a curve or a part of one. place.hpp defines positions.
//
// A motor's motion is straight, proportional to s; or round, like that of the axes in an arc's plane, possibly with a
// straight part from an axis outside the plane; or along a cubic. Its row (passo/kinematics) determines the kind.
// Several crossings are found at once (lanes.hpp). One takes about 1 ns if straight, 8 ns if round and 5 ns on a cubic.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "cubic_motor_position.hpp"
#include "lanes.hpp"
#include "place.hpp"

namespace passo {

class MotorPath {
 public:
  // Begins a curve, which is followed up to `end`. `curve` must exist until the next curve begins.
  void start(const Curve& curve, double end, std::span<const MotorRow> motors);
  void curve_lives_in(const Curve& curve) { curve_ = &curve; }

  // A point on the curve, with the values that all motors need, computed once. On an arc these are the cosine and the
  // sine of the angle.
  struct Spot {
    double s = 0;
    double cosine = 1;
    double sine = 0;
  };
  Spot at(double s) const { return turn_ == 0 ? Spot{.s = s} : on_circle(s); }

  double place(unsigned motor, const Spot& spot) const {
    const Term& term = terms_[motor];
    switch (term.way) {
      case Way::round: return place_round(term, spot);
      case Way::cubic: return cubics_[motor].at(spot.s);
      case Way::straight: break;
    }
    return term.base + term.scale * spot.s;
  }
  // d position / ds. Negative where the motor counts down.
  double slope(unsigned motor, const Spot& spot) const {
    const Term& term = terms_[motor];
    switch (term.way) {
      case Way::round: return slope_round(term, spot);
      case Way::cubic: return cubics_[motor].slope(spot.s);
      case Way::straight: break;
    }
    return term.scale;
  }
  // Whether the motor counts up just after `spot`. On a cubic this is also correct at a turning point.
  bool rises(unsigned motor, const Spot& spot) const {
    return terms_[motor].way == Way::cubic ? cubics_[motor].rises(spot.s) : slope(motor, spot) > 0;
  }

  // Returns the first spot at or after `from` where the motor reaches `target`, in its direction at `from`. Its s is
  // infinite if the motor reverses before, or does not move. The spot may lie beyond the end.
  Spot crossing(unsigned motor, double target, const Spot& from) const {
    const Term& term = terms_[motor];
    switch (term.way) {
      case Way::round: return crossing_round(motor, target, from);
      case Way::cubic: return {.s = cubics_[motor].crossing(target, from.s)};
      case Way::straight: break;
    }
    return at(term.scale == 0 ? infinity : std::max(from.s, (target - term.base) / term.scale));
  }
  // The same for several near targets, each farther by `step`. Returns none for a motor that moves straight on an arc.
  // The lanes after them have arbitrary values.
  struct Spots {
    Lanes s;
    Lanes cosine;
    Lanes sine;
    std::size_t count = 0;
    Spot operator[](std::size_t i) const { return {.s = s[i], .cosine = cosine[i], .sine = sine[i]}; }
  };
  void look_ahead(unsigned motor, double target, double step, double from, Spots& ahead) const;
  void places(unsigned motor, const Spots& spots, Lanes& places) const;
  void slopes(unsigned motor, const Spots& spots, Lanes& slopes) const;
  // Returns an s just after the first point after `from` where the motor reverses. Infinity if it never does.
  double turning_point(unsigned motor, double from) const;
  // Returns the change of s until the motor is `distance` away from its position at `from`, in either direction. This
  // measures how fast a motor is, even at a turning point, where its slope is 0. Infinity if the motor never gets that
  // far.
  double travel(unsigned motor, double distance, double from) const;
  // Returns an s up to which no other motor is faster than `master` by the factor `takeover`; the master counts in
  // direction `sign`. On an arc the true limit may be later: call again from there.
  double leads_until(unsigned master, int sign, double takeover, const Spot& from) const;
  // Returns the radius of the motor's round motion at `spot`, in position units. Infinity where it moves straight.
  double reach(unsigned motor, const Spot& spot) const;
  bool is_turning(unsigned motor) const { return terms_[motor].way != Way::straight; }

  bool is_straight() const { return curve_->shape() == Curve::Shape::line; }
  double end() const { return end_; }
  const Curve& curve() const { return *curve_; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  enum class Way : std::uint8_t { straight, round, cubic };
  // Straight: position = base + scale * s. Round: position = base + drift * s + scale * radius(s) * outward(s), where
  // outward is cosine * cos(angle(s)) + sine * sin(angle(s)).
  struct Term {
    Way way = Way::straight;
    double base = 0;    // position at s = 0, or of the centre
    double scale = 0;   // slope, or position units per millimetre of radius
    double cosine = 0;  // the motor's components along the first and second axis of the plane, normalised
    double sine = 0;
    double drift = 0;     // from an axis outside the plane; 0 for most motors
    double angle = 0;     // at s = 0; outward is its sine
    double sharpest = 0;  // round: maximum |d² position / ds²|
  };

  void start_arc(const Curve::ArcData& arc, double length);
  Term straight_term(const MotorRow& motor) const;
  Term round_term(const MotorRow& motor, const Curve::ArcData& arc) const;
  Parabola slope_of(unsigned motor) const;
  double leads_on_arc(unsigned master, int sign, double takeover, const Spot& from) const;

  Spot on_circle(double s) const {
    const double angle = angle_ + turn_ * s;
    return {.s = s, .cosine = std::cos(angle), .sine = std::sin(angle)};
  }
  double place_round(const Term& term, const Spot& spot) const {
    return term.base + term.drift * spot.s + term.scale * radius_at(spot.s) * arm(term, spot).outward;
  }
  // The position on the circle: `outward` for this motor, and its value a right angle farther.
  struct Arm {
    double outward = 0;
    double around = 0;
  };
  // Most motors are: their arm is a spot's cosine and sine as they are, and the loops below need no products for it.
  static bool is_of_one_axis(const Term& term) { return term.drift == 0 && (term.sine == 0 || term.cosine == 0); }
  static Arm arm(const Term& term, const Spot& spot) {
    return {term.cosine * spot.cosine + term.sine * spot.sine, term.sine * spot.cosine - term.cosine * spot.sine};
  }
  double slope_round(const Term& term, const Arm& at, double radius) const {
    return term.scale * (growth_ * at.outward + radius * turn_ * at.around) + term.drift;
  }
  double slope_round(const Term& term, const Spot& spot) const {
    return slope_round(term, arm(term, spot), radius_at(spot.s));
  }
  double bend_round(const Term& term, const Arm& at, double radius) const {
    return term.scale * turn_ * (2 * growth_ * at.around - radius * turn_ * at.outward);
  }
  void look_ahead_round(unsigned motor, double target, double step, double from, Spots& ahead) const;
  Spot crossing_round(unsigned motor, double target, const Spot& from) const;
  double crossing_on_spiral(unsigned motor, double target, double from, double guess) const;
  double crossing_with_drift(unsigned motor, double target, double from) const;
  double crossing_between(unsigned motor, double target, double from, double to) const;
  double turning_point_round(const Term& term, double from) const;
  double turning_point_with_drift(const Term& term, double from) const;
  double travel_round(unsigned motor, double distance, double from) const;
  double angle_at(const Term& term, double s) const { return term.angle + turn_ * s; }
  double radius_at(double s) const { return radius_ + growth_ * s; }

  unsigned motors_ = 0;
  std::array<Term, max_motors> terms_;
  std::array<CubicMotorPosition, max_motors> cubics_;  // for motors that move along a cubic
  const Curve* curve_ = nullptr;
  double end_ = 0;
  // Data of an arc. For other curves, turn_ is 0.
  double angle_ = 0;   // at s = 0
  double turn_ = 0;    // radians per millimetre of s
  double radius_ = 0;  // at s = 0
  double growth_ = 0;  // of the radius, per millimetre of s
};

}  // namespace passo
