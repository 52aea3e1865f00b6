// ConstantJerk: motion at constant jerk, s(t) = v t + a t²/2 + j t³/6, and the time at which it reaches a given
// distance.
//
// Distances may be in any unit (millimetres of a path, steps of a motor); times are in seconds. The values are plain
// doubles, because the polynomial is the same for all units. The distance must increase with time over the whole phase.
// At constant acceleration the time has a closed form. With jerk, Newton's method inside a bracket finds the time to
// full double precision.
#pragma once

#include <algorithm>
#include <cmath>

namespace passo {

struct ConstantJerk {
  double speed = 0;         // at the start of the phase
  double acceleration = 0;  // at the start of the phase
  double jerk = 0;

  constexpr double way_after(double t) const { return t * (speed + t * (acceleration / 2 + t * (jerk * sixth))); }
  constexpr double speed_after(double t) const { return speed + t * (acceleration + t * jerk / 2); }
  constexpr double acceleration_after(double t) const { return acceleration + t * jerk; }

  // Returns the time at which the phase reaches the distance `way`, in 0…duration.
  double time_to(double way, double duration) const { return time_to(way, duration, soon(way), rounding * way); }
  // The same, with an initial guess, e.g. the time of a slightly smaller distance. With jerk, the distance at the
  // returned time differs from `way` by at most `precision`.
  double time_to(double way, double duration, double guess, double precision) const {
    if (way <= 0) return 0;
    if (jerk != 0) return time_with_jerk(way, duration, guess, precision);
    if (acceleration == 0) return std::min(way / speed, duration);
    // Solves v t + a t²/2 = s, in the form that stays accurate when a is small or the speed falls to zero.
    const double square = speed * speed + 2 * acceleration * way;
    return std::min(2 * way / (speed + std::sqrt(std::max(square, 0.0))), duration);
  }
  // Returns the first terms of the time as a power series of the distance. They are accurate where the speed hardly
  // changes, and a guess elsewhere.
  double soon(double way) const {
    const double slowness = 1 / speed;
    const double time = way * slowness;
    return time - time * time * (acceleration * slowness / 2);
  }

  static constexpr double rounding = 1e-16;  // relative to the distance, smaller than the spacing of doubles

 private:
  static constexpr double sixth = 1.0 / 6;  // a multiplication is faster than a division

  double time_with_jerk(double way, double duration, double guess, double precision) const {
    double low = 0;
    double high = duration;
    double t = guess > low && guess < high ? guess : high / 2;
    for (int i = 0; i < 64; ++i) {
      const double excess = way_after(t) - way;
      (excess > 0 ? high : low) = t;
      const double step = -excess / speed_after(t);
      const double next = t + step;
      if (next >= low && next <= high) {
        // For a cubic, this is the exact error after a step of Newton's method.
        const double left = step * step * (acceleration_after(t) / 2 + step * (jerk * sixth));
        if (std::abs(left) <= precision || next == t) return next;
        t = next;
      } else {
        t = (low + high) / 2;
      }
    }
    return t;
  }
};

}  // namespace passo
