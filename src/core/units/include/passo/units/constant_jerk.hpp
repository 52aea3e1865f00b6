// ConstantJerk: motion at constant jerk, s(t) = v t + a t²/2 + j t³/6, and the time at which it reaches a given way.
//
// Ways may be in any unit (millimetres of a path, steps of a motor); times are in seconds. The numbers are bare,
// because the polynomial is the same for all units. The way must grow with time all along the stretch. At constant
// acceleration the time of a way has a closed form. With jerk, Newton's method inside a bracket finds the time to the
// last digits of t.
#pragma once

#include <algorithm>
#include <cmath>

namespace passo {

struct ConstantJerk {
  double speed = 0;         // at the start of the stretch
  double acceleration = 0;  // at the start of the stretch
  double jerk = 0;

  constexpr double way_after(double t) const { return t * (speed + t * (acceleration / 2 + t * (jerk * sixth))); }
  constexpr double speed_after(double t) const { return speed + t * (acceleration + t * jerk / 2); }
  constexpr double acceleration_after(double t) const { return acceleration + t * jerk; }

  // The time at which the stretch reaches `way`, in 0…duration.
  double time_to(double way, double duration) const { return time_to(way, duration, soon(way), rounding * way); }
  // The same, with a guess of that time, taken for instance from a time just before. Where there is jerk, the way at
  // the returned time differs from `way` by at most `precision`.
  double time_to(double way, double duration, double guess, double precision) const {
    if (way <= 0) return 0;
    if (jerk != 0) return time_with_jerk(way, duration, guess, precision);
    if (acceleration == 0) return std::min(way / speed, duration);
    // v t + a t²/2 = s, in the form that loses no digits when a is small or the speed falls to zero.
    const double square = speed * speed + 2 * acceleration * way;
    return std::min(2 * way / (speed + std::sqrt(std::max(square, 0.0))), duration);
  }
  // The first terms of the time as a series of the way. They are right where the speed hardly changes, and a guess
  // elsewhere.
  double soon(double way) const {
    const double slowness = 1 / speed;
    const double time = way * slowness;
    return time - time * time * (acceleration * slowness / 2);
  }

  static constexpr double rounding = 1e-16;  // a share of the way, smaller than the spacing of doubles

 private:
  static constexpr double sixth = 1.0 / 6;  // a product is faster than a quotient

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
        // For a cubic, the error after a step of Newton's method is exactly this.
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
