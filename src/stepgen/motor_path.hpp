// MotorPath: the place of every motor as a function of s, for a curve or a part of one. place.hpp defines places.
//
// A motor moves in one of three ways. Straight: in proportion to s. Round: as an axis of an arc's plane. Cubic: along a
// cubic. Finding a crossing takes about 5 ns straight, 50 ns round and 30 ns on a cubic.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "cubic_place.hpp"
#include "place.hpp"

namespace passo {

class MotorPath {
 public:
  // Begins a curve, which is followed up to `end`. `curve` must stay alive until the next curve begins.
  void start(const Curve& curve, double end, const StepOptions& options);
  void curve_lives_in(const Curve& curve) { curve_ = &curve; }

  // A place on the curve, with the values that all motors need, computed once. On an arc these are the cosine and the
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
  // d place / ds. Negative where the motor counts down.
  double slope(unsigned motor, const Spot& spot) const {
    const Term& term = terms_[motor];
    switch (term.way) {
      case Way::round: return slope_round(term, spot);
      case Way::cubic: return cubics_[motor].slope(spot.s);
      case Way::straight: break;
    }
    return term.scale;
  }
  // Whether the motor counts up just after `spot`. On a cubic this is right at a turning point too.
  bool rises(unsigned motor, const Spot& spot) const {
    return terms_[motor].way == Way::cubic ? cubics_[motor].rises(spot.s) : slope(motor, spot) > 0;
  }

  // The first s >= from at which the motor reaches `target` without turning back. Infinity if the motor turns back
  // before that, or stands still. The result may lie beyond the end.
  double crossing(unsigned motor, double target, const Spot& from) const {
    const Term& term = terms_[motor];
    switch (term.way) {
      case Way::round: return crossing_round(motor, target, from);
      case Way::cubic: return cubics_[motor].crossing(target, from.s);
      case Way::straight: break;
    }
    return term.scale == 0 ? infinity : std::max(from.s, (target - term.base) / term.scale);
  }
  // The s just after the first turning point after `from`. Infinity if the motor never turns back.
  double turning_point(unsigned motor, double from) const;
  // The change of s until the motor is `distance` away from its place at `from`, in either direction. This measures how
  // fast a motor is, even at a turning point, where its slope is 0. Infinity if the motor never gets that far.
  double travel(unsigned motor, double distance, double from) const;
  // The s up to which no other motor is faster than `master` by the factor `takeover`. The master counts in the
  // direction `sign`. On an arc the result is `from`, because there the caller checks each place.
  double leads_until(unsigned master, int sign, double takeover, double from) const;
  // The radius on which the motor turns at `spot`, in units of place. Infinity if the motor moves straight.
  double reach(unsigned motor, const Spot& spot) const;
  bool is_turning(unsigned motor) const { return terms_[motor].way != Way::straight; }

  // The motion of a motor that moves straight.
  struct Line {
    double base = 0;  // place at s = 0
    double slope = 0;
    double at(double s) const { return base + slope * s; }
  };
  Line line(unsigned motor) const { return {.base = terms_[motor].base, .slope = terms_[motor].scale}; }
  bool is_straight() const { return curve_->shape() == Curve::Shape::line; }
  double end() const { return end_; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  enum class Way : std::uint8_t { straight, round, cubic };
  // Straight: place = base + scale * s. Round: place = base + scale * radius(s) * cos or sin(angle(s)).
  struct Term {
    Way way = Way::straight;
    bool on_cosine = false;  // the first axis of the plane
    double base = 0;         // place at s = 0, or the place of the centre
    double scale = 0;        // slope, or units of place a millimetre of radius
    double angle = 0;        // at s = 0, turned so that the place is a sine of the angle for both axes
  };

  void start_arc(const Curve::ArcData& arc, double length);
  Term straight_term(const Motor& motor) const;
  Parabola slope_of(unsigned motor) const;
  static Term round_term(const Motor& motor, const Curve::ArcData& arc);

  Spot on_circle(double s) const;
  double place_round(const Term& term, const Spot& spot) const;
  double slope_round(const Term& term, const Spot& spot) const;
  double crossing_round(unsigned motor, double target, const Spot& from) const;
  double crossing_on_spiral(unsigned motor, double target, double from, double guess) const;
  double turning_point_round(const Term& term, double from) const;
  double travel_round(unsigned motor, double distance, double from) const;
  double angle_at(const Term& term, double s) const { return term.angle + turn_ * s; }
  double radius_at(double s) const { return radius_ + growth_ * s; }

  unsigned motors_ = 0;
  std::array<Term, max_motors> terms_;
  std::array<CubicPlace, max_motors> cubics_;  // for motors that move along a cubic
  const Curve* curve_ = nullptr;
  double end_ = 0;
  // The arc. For other curves, turn_ is 0.
  double angle_ = 0;   // at s = 0
  double turn_ = 0;    // radians a millimetre of s
  double radius_ = 0;  // at s = 0
  double growth_ = 0;  // of the radius, for each millimetre of s
};

}  // namespace passo
