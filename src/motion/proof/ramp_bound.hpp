// RampBound: the minimum time in which a single axis, or a straight line, covers a distance with acceleration and jerk
// limits.
//
//   acceleration  __                       It accelerates to the highest speed P, cruises at P, and decelerates. At an
//                /  \______                end it has either no acceleration (steady), or any within the limit.
//                          \__/
//
// From the speed v to P, with d = P - v, the acceleration a and the jerk j, the ramp takes
//
//     from a steady end     d/a + a/j       or 2 √(d/j) where a is not reached       at the mean speed v + d/2
//     from any other end    d/a + a/2j      or   √(2d/j)     where a is not reached       at a higher mean speed
//
// No motion is faster: an axis that starts at v, must not exceed P and has no acceleration at P is never faster than
// the ramp. The distance between the two ramps is covered at P. P is the highest speed for which both ramps fit, or the
// top.
#pragma once

namespace passo::proof {

class RampBound {
 public:
  // A limit of 0 or less means no limit.
  RampBound(double acceleration, double jerk);

  bool limits() const { return limits_; }

  // An end of a distance. `speed` is the maximum there.
  struct End {
    double speed = 0;
    bool steady = false;
  };
  // `top` is the maximum speed on the distance. Returns 0 if one end is too fast for the other, with any acceleration.
  double least_time(const End& start, const End& end, double way, double top) const;

 private:
  struct Ramp {
    double time = 0;
    double way = 0;
  };
  Ramp ramp(const End& end, double peak) const;
  double time_between(const End& start, const End& end, double way) const;

  double acceleration_;
  double jerk_;
  bool limits_;
};

}  // namespace passo::proof
