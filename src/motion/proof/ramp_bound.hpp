// RampBound: the least time in which a single axis, or a straight line, covers a way with limits of acceleration and
// jerk.
//
//   acceleration  __                       It speeds up to the highest speed P, goes on at P, and brakes. At an end it
//                /  \______                either has no acceleration (steady), or any that the limit allows.
//                          \__/
//
// From the speed v to P, with d = P - v, the acceleration a and the jerk j, speeding up takes
//
//     from a steady end     d/a + a/j       or 2 √(d/j) where a is not reached       on the mean speed v + d/2
//     from any other end    d/a + a/2j      or   √(2d/j)     where a is not reached       on a higher mean speed
//
// No motion is faster: whatever an axis does that comes from v, must not exceed P and has no acceleration at P, at each
// instant it is at most as fast as the ramp. The way that two ramps leave is covered at P. P is the highest speed with
// which both ramps have room, or the top.
#pragma once

namespace passo::proof {

class RampBound {
 public:
  // A limit of 0 or less does not limit.
  RampBound(double acceleration, double jerk);

  bool limits() const { return limits_; }

  // An end of a way. `speed`: it is not exceeded there.
  struct End {
    double speed = 0;
    bool steady = false;
  };
  // `top` is not exceeded on the way. 0 where the ends are too fast to tell anything.
  double least_time(const End& start, const End& end, double way, double top) const;

 private:
  struct Ramp {
    double time = 0;
    double way = 0;
  };
  Ramp ramp(const End& end, double peak) const;

  double acceleration_;
  double jerk_;
  bool limits_;
};

}  // namespace passo::proof
