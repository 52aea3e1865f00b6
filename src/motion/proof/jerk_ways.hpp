// JerkWays: what limits of jerk add to a bound of the time that is found cell by cell (TimeBound).
//
// Each axis with a limit of jerk goes back and forth. On each way between two places where it rests or turns back, it
// takes at least the time of a RampBound. So the time up to the end of the way is at least the time up to its start,
// and this time more. The same holds between two places where the axis is slowest, from and to the speeds that it has
// there at most.
#pragma once

#include <array>
#include <vector>

#include "ramp_bound.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class JerkWays {
 public:
  explicit JerkWays(const std::vector<ProvenAxis>& axes);

  bool any() const { return any_; }

  // An axis in a cell. The squares of speeds are not exceeded.
  struct Ride {
    double way = 0;    // signed; 0: the axis stands
    double entry = 0;  // square
    double exit = 0;
    double top = 0;  // anywhere in the cell
  };
  using Rides = std::array<Ride, max_motors>;
  // Takes a bound of the time up to the start of the cell and returns a better one, or the same.
  double enter(const Rides& rides, double time);
  // The path rests. `steady`: without acceleration; else it goes back where it came from.
  double rest(double time, bool steady);

 private:
  struct Way {
    double began = 0;  // bound of the time up to its start
    RampBound::End start;
    double length = 0;
    double top = 0;  // square
  };
  struct Axis {
    explicit Axis(const RampBound& of_axis) : ramp(of_axis) {}
    RampBound ramp;
    double direction = 0;  // 0: stands
    bool falls = false;    // the greatest speed falls along the last cell
    bool steady = true;    // the last end was without acceleration
    Way whole;             // since the axis stood
    Way part;              // since it was slowest
  };
  static double until(const Axis& axis, const Way& way, const RampBound::End& end);
  static double stop(Axis& axis, double time, bool steady);

  std::vector<Axis> axes_;
  bool any_ = false;
};

}  // namespace passo::proof
