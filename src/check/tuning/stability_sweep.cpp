#include "stability_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double sweep = 15;       // seconds
constexpr double dwell = 3;        // seconds at the fastest rate: a swing needs time to grow
constexpr double first_rate = 20;  // full steps a second
constexpr double just_below = 0.999;
constexpr double averaging = 0.02;  // seconds, of the lag
constexpr double most_swing = 0.7;  // full steps about the mean: twice that between the ends, near the edge at 2
constexpr double most_swing_of_coarse_steps = 1.4;  // with full and half steps each step makes the rotor ring

}  // namespace

Hertz calm_up_to(const MotorSetup& setup, Hertz fastest, double late) {
  RunningMotor motor(setup);
  const int parts = setup.excitation.steps_per_full_step();
  const double allowed = parts <= 2 ? most_swing_of_coarse_steps : most_swing;
  double even = 0;  // when the next pulse is due
  double now = 0;
  double mean = 0;
  double rate = first_rate;
  while (now < sweep + dwell) {
    const double interval = 1 / (rate * parts);
    even += interval;
    // The grid of a faster motor's events.
    const double grid = late * interval;
    const double at = grid > 0 ? std::max(std::ceil(even / grid) * grid, now) : even;
    motor.run(Seconds(at - now));
    const double before = motor.lag();
    mean += (before - mean) * std::min((at - now) / averaging, 1.0);
    if (motor.slipped() != 0 || std::abs(before - mean) > allowed)
      return Hertz(std::min(rate, just_below * fastest.value()));
    now = at;
    motor.step(1);
    rate = std::min(first_rate + (fastest.value() - first_rate) * now / sweep, fastest.value());
  }
  return fastest;
}

}  // namespace passo
