// AxisRamp: the maximum speed of a single axis over a distance, and the minimum time for the distance.
//
// At full acceleration A(v) the axis reaches the speed v from rest after the distance ∫ v dv / A(v) and the time ∫ dv /
// A(v). So for any two speeds at two points, these distances differ by at most the distance between the points,
// whichever speed comes first. With a constant A this is v₁² − v₀² ≤ 2 A |q₁ − q₀|. A limit that falls with the speed
// is replaced by a step function that is nowhere below the limit.
#pragma once

#include <cstdint>
#include <vector>

#include "speed_limit.hpp"

namespace passo::proof {

constexpr double squared(double value) {
  return value * value;
}

class AxisRamp {
 public:
  AxisRamp(const ProvenAxis& axis, const SpeedLimit& limit);

  // Returns false if any change of speed is possible at once.
  bool limits() const { return strongest_ > 0; }

  // Returns the maximum squared speed at this distance after, or before, a point with the given squared speed.
  double square_after(double square, double way) const;

  // Returns the distance from rest to that speed.
  double way_from_rest(double speed) const { return steps_.empty() ? speed * speed / (2 * strongest_) : way_to(speed); }

  // Upper bounds of the axis' squared speed: at the start and the end of a distance, and anywhere on it.
  struct Squares {
    double start = 0;
    double end = 0;
    double top = 0;
  };
  double least_time(Squares squares, double way) const;

 private:
  struct Step {
    double speed = 0;
    double strength = 0;  // the acceleration from this speed to that of the next step of the function
    double way = 0;       // distance from rest
    double time = 0;
  };
  const Step& step_at(double speed) const;
  double way_to(double speed) const;
  double time_to(double speed) const;
  double speed_after(double way) const;

  double strongest_ = 0;                    // the acceleration from rest; 0: no limit
  double width_ = 0;                        // speed range of a step
  std::vector<Step> steps_;                 // empty: the limit is constant
  std::vector<std::uint32_t> first_steps_;  // for even steps of the root of the way: a step that is not beyond it
};

}  // namespace passo::proof
