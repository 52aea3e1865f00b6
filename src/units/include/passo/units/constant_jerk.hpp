// ConstantJerk: what a stretch of constant jerk does, s(t) = v t + a t²/2 + j t³/6, and when it has come how far.
//
// For any unit of way (millimetres of a path, steps of a motor) and seconds; bare numbers, as the polynomial cares for
// none. The way grows with the time all along the stretch. Time from way: constant acceleration in closed form, jerk
// by Newton's method inside a bracket, to the last digits of t.
#pragma once

#include <algorithm>
#include <cmath>

namespace passo {

struct ConstantJerk {
  double speed = 0;         // at the start of the stretch
  double acceleration = 0;  // there
  double jerk = 0;

  constexpr double way_after(double t) const { return t * (speed + t * (acceleration / 2 + t * jerk / 6)); }
  constexpr double speed_after(double t) const { return speed + t * (acceleration + t * jerk / 2); }
  constexpr double acceleration_after(double t) const { return acceleration + t * jerk; }

  // The time at which it has come `way`, in 0…duration.
  double time_to(double way, double duration) const {
    if (way <= 0) return 0;
    if (jerk != 0) return time_with_jerk(way, duration);
    // v t + a t²/2 = s, in the form that loses no digits when a is small or the speed falls to zero.
    const double square = speed * speed + 2 * acceleration * way;
    return std::min(2 * way / (speed + std::sqrt(std::max(square, 0.0))), duration);
  }

 private:
  double time_with_jerk(double way, double duration) const {
    double low = 0;
    double high = duration;
    double t = high / 2;
    for (int i = 0; i < 64; ++i) {
      const double excess = way_after(t) - way;
      (excess > 0 ? high : low) = t;
      const double slope = speed_after(t);
      double next = slope > 0 ? t - excess / slope : low;
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (next == t) break;
      t = next;
    }
    return t;
  }
};

}  // namespace passo
