// JerkTimeBound: improves a time bound that is computed cell by cell (TimeBound) by including jerk limits.
//
// An axis with a jerk limit moves back and forth. Between two points where it stops or reverses, it takes at least the
// time of a RampBound. So the time up to the second point is at least the time up to the first one plus this time. The
// same holds between two points where the axis is slowest, with its maximum speeds at these points. At a stop of the
// path an axis with a start-stop velocity may jump to it, or from it, without acceleration.
#pragma once

#include <array>
#include <vector>

#include "ramp_bound.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class JerkTimeBound {
 public:
  explicit JerkTimeBound(const std::vector<ProvenAxis>& axes);

  bool any() const { return any_; }

  // The motion of an axis in a cell. The squared speeds are upper bounds.
  struct Ride {
    double way = 0;    // signed distance; 0: the axis does not move
    double entry = 0;  // squared
    double exit = 0;
    double top = 0;  // anywhere in the cell
  };
  using Rides = std::array<Ride, max_motors>;
  // Takes a bound of the time up to the start of the cell and returns a better one, or the same.
  double enter(const Rides& rides, double time);
  // Call at a stop of the path. `steady`: the stop is without acceleration; otherwise the path reverses.
  double rest(double time, bool steady);

 private:
  struct Way {
    double began = 0;  // bound of the time up to its start
    RampBound::End start;
    double length = 0;
    double top = 0;  // squared
  };
  struct Axis {
    Axis(const RampBound& of_axis, double start_stop) : ramp(of_axis), jump(start_stop) {}
    RampBound ramp;
    double jump;           // the start-stop velocity
    double start = 0;      // the speed with which it may begin to move
    double direction = 0;  // 0: it does not move
    double exit = 0;       // the maximum speed at the end of the last cell
    bool falls = false;    // the maximum speed falls along the last cell
    bool steady = true;    // the last end was without acceleration
    Way whole;             // since the axis was stopped
    Way part;              // since it was slowest
  };
  static double until(const Axis& axis, const Way& way, const RampBound::End& end);
  static double stop(Axis& axis, double time, const RampBound::End& end);

  std::vector<Axis> axes_;
  bool any_ = false;
};

}  // namespace passo::proof
