// Pid: a PID controller, executed once per control period:
//
//   out = kp·e + ki·∫e dt − kd·d(measured)/dt        e = wanted − measured, |out| ≤ limit
//
// The D term uses only the measured value, so a step of the set point causes no derivative kick. It is smoothed over a
// few periods, because a difference of counts is noisy. While the output is at its limit, the integral does not grow
// (anti-windup: otherwise it would cause an overshoot).
//
// UltimateCycle and the rules: J. G. Ziegler and N. B. Nichols, Optimum Settings for Automatic Controllers, Trans. ASME
// 64 (1942): with P only, the loop oscillates with constant amplitude at the gain Ku, with the period Tu.
#pragma once

#include <algorithm>

#include "passo/units/units.hpp"

namespace passo {

struct PidGains {
  double kp = 0;
  double ki = 0;  // integral gain, per second
  double kd = 0;  // derivative gain, seconds
};

struct UltimateCycle {
  double gain = 0;    // Ku
  Seconds period{0};  // Tu
};

constexpr PidGains ziegler_nichols_p(const UltimateCycle& cycle) {
  return {.kp = 0.5 * cycle.gain};
}
constexpr PidGains ziegler_nichols_pi(const UltimateCycle& cycle) {
  const double kp = 0.45 * cycle.gain;
  return {.kp = kp, .ki = kp * 1.2 / cycle.period.value()};
}
constexpr PidGains ziegler_nichols_pid(const UltimateCycle& cycle) {
  const double kp = 0.6 * cycle.gain;
  return {.kp = kp, .ki = kp * 2 / cycle.period.value(), .kd = kp * cycle.period.value() / 8};
}

class Pid {
 public:
  // `limit` > 0: maximum magnitude of the output.
  Pid(const PidGains& gains, Seconds period, double limit) : gains_(gains), period_(period.value()), limit_(limit) {}

  double update(double wanted, double measured) {
    const double error = wanted - measured;
    if (!begun_) last_ = measured;
    begun_ = true;
    rate_ += smoothing * ((measured - last_) / period_ - rate_);
    last_ = measured;
    const double grown = integral_ + error * period_;
    const double free = gains_.kp * error + gains_.ki * grown - gains_.kd * rate_;
    const double out = std::clamp(free, -limit_, limit_);
    // At the limit the integral changes only in the direction that leads away from the limit.
    if (free == out || free * error < 0) integral_ = grown;
    return out;
  }

 private:
  static constexpr double smoothing = 0.2;

  PidGains gains_;
  double period_;
  double limit_;
  double integral_ = 0;
  double last_ = 0;
  double rate_ = 0;
  bool begun_ = false;
};

}  // namespace passo
