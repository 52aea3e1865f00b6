// AxisRamp: how fast a single axis can become on a way, and how long the way takes at least.
//
// At full acceleration A(v) the axis has come from rest to the speed v after the way ∫ v dv / A(v) and the time
// ∫ dv / A(v). So the ways of any two speeds differ by no more than the way between them, whichever speed comes first.
// With a constant A this is v₁² − v₀² ≤ 2 A |q₁ − q₀|. A limit that falls with the speed is a staircase of constants,
// nowhere below the limit.
#pragma once

#include <vector>

#include "speed_limit.hpp"

namespace passo::proof {

class AxisRamp {
 public:
  AxisRamp(const ProvenAxis& axis, const SpeedLimit& limit);

  // False: any change of speed is possible at once.
  bool limits() const { return strongest_ > 0; }

  // The greatest square of the speed after this way from that square, or before it.
  double square_after(double square, double way) const;

  // The way from rest to that speed.
  double way_from_rest(double speed) const { return steps_.empty() ? speed * speed / (2 * strongest_) : way_to(speed); }

  // Squares of speeds that the axis does not exceed: at the start of a way, at its end, and anywhere on it.
  struct Squares {
    double start = 0;
    double end = 0;
    double top = 0;
  };
  double least_time(Squares squares, double way) const;

 private:
  struct Step {
    double speed = 0;
    double strength = 0;  // the acceleration from this speed to that of the next step
    double way = 0;       // from rest
    double time = 0;
  };
  const Step& step_at(double speed) const;
  double way_to(double speed) const;
  double time_to(double speed) const;
  double speed_after(double way) const;

  double strongest_ = 0;     // the acceleration from rest; 0: no limit
  double width_ = 0;         // of a step
  std::vector<Step> steps_;  // empty: the limit is constant
};

}  // namespace passo::proof
