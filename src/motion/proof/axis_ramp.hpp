// AxisRamp: the maximum speed of a single axis over a distance, and the minimum time for the distance.
//
// At full acceleration A(v) the axis reaches the speed v from rest after the distance ∫ v dv / A(v) and the time ∫ dv /
// A(v). So for any two speeds at two points, these distances differ by at most the distance between the points,
// whichever speed comes first. With a constant A this is v₁² − v₀² ≤ 2 A |q₁ − q₀|. A limit that falls with the speed
// is replaced by a step function that is nowhere below the limit. Its steps are even in v², so the distance is a
// piecewise linear function of v², and vice versa.
#pragma once

#include <cstddef>
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
  double square_after(double square, double way) const {
    return steps_.empty() ? square + 2 * strongest_ * way : square_over_steps(square, way);
  }

  // Returns the distance from rest to that speed.
  double way_from_rest(double speed) const {
    return steps_.empty() ? speed * speed / (2 * strongest_) : way_to(step_at(speed * speed), speed * speed);
  }

  // Returns whether the axis can cover that distance from rest in that time, if no speed is too high.
  bool comes_from_rest(double way, double time) const;

  // Upper bounds of the axis' squared speed: at the start and the end of a distance, and anywhere on it.
  struct Squares {
    double start = 0;
    double end = 0;
    double top = 0;
  };
  double least_time(Squares squares, double way) const;
  // The same with a constant acceleration.
  static double least_time_by(double acceleration, Squares squares, double way);

 private:
  struct Step {
    double strength = 0;  // the acceleration from this speed to that of the next step of the function
    double way = 0;       // distance from rest
    double time = 0;
    double speed = 0;
  };
  double square_of(std::size_t step) const { return static_cast<double>(step) * width_; }
  void fill_reaches();
  std::size_t step_at(double square) const;
  std::size_t step_at_way(double way, std::size_t from) const;
  double way_to(std::size_t step, double square) const;
  double square_at_way(std::size_t step, double way) const;
  double time_to(std::size_t step, double speed) const;
  double square_over_steps(double square, double way) const;
  double least_time_over_steps(Squares squares, double way) const;

  double strongest_ = 0;         // the acceleration from rest; 0: no limit
  double width_ = 0;             // the range of v² of a step
  double per_width_ = 0;         // 1 / width_
  std::vector<Step> steps_;      // empty: the limit is constant
  std::vector<double> reaches_;  // the ways from rest at even times
  double reaches_per_time_ = 0;
};

}  // namespace passo::proof
