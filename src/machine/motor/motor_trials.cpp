#include "passo/motor/motor_trials.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

constexpr double gentle = 0.1;            // share of the holding torque that a ramp uses
constexpr double torque_steps = 1250;     // to the holding torque
constexpr Seconds at_each_torque{0.003};  // several times L/R, and a ringing of 300 Hz
constexpr int halvings = 10;
constexpr int steps_of_a_start = 100;  // full steps
constexpr Seconds ringing{0.3};

double inertia_of(const MotorSetup& setup) {
  return setup.motor.rotor.inertia.value + setup.load.inertia.value;
}

// Runs the motor up to a rate of its driver. False: steps were lost on the way.
bool run_up(RunningMotor& motor, const MotorSetup& setup, double rate) {
  const double acceleration = gentle * setup.motor.holding_torque.value / inertia_of(setup) *
                              setup.motor.rotor.steps_per_revolution / (2 * std::numbers::pi) *
                              setup.excitation.steps_per_full_step();
  double at = std::min(rate, std::sqrt(2 * acceleration));
  while (at < rate && motor.slipped() == 0) {
    motor.step(1);
    motor.run(Seconds(1 / at));
    at += acceleration / at;
  }
  return motor.slipped() == 0;
}

// Steps at an even rate for a time, or a single one if it takes longer.
void keep_up(RunningMotor& motor, double rate, Seconds time) {
  for (double left = time.value(); left > 0; left -= 1 / rate) {
    motor.step(1);
    motor.run(Seconds(1 / rate));
  }
}

bool starts_and_stops(const MotorSetup& setup, double rate, double torque) {
  RunningMotor motor(setup);
  motor.set_resistance({torque});
  for (int i = 0; i < steps_of_a_start * setup.excitation.steps_per_full_step(); ++i) {
    motor.step(1);
    motor.run(Seconds(1 / rate));
    if (motor.slipped() != 0) return false;
  }
  motor.run(ringing);
  return motor.slipped() == 0;
}

}  // namespace

NewtonMetres tried_pull_out(const MotorSetup& setup, Hertz rate) {
  const double pulses = rate.value() * setup.excitation.steps_per_full_step();
  RunningMotor motor(setup);
  if (!run_up(motor, setup, pulses)) return {0};
  keep_up(motor, pulses, ringing);
  const double most = 1.3 * setup.motor.holding_torque.value;
  const double step = setup.motor.holding_torque.value / torque_steps;
  for (double torque = 0; torque < most; torque += step) {
    motor.set_resistance({torque});
    keep_up(motor, pulses, at_each_torque);
    if (motor.slipped() != 0) return {std::max(torque - step, 0.0)};
  }
  return {most};
}

NewtonMetres tried_pull_in(const MotorSetup& setup, Hertz rate) {
  const double pulses = rate.value() * setup.excitation.steps_per_full_step();
  if (!starts_and_stops(setup, pulses, 0)) return {0};
  double low = 0;
  double high = setup.motor.holding_torque.value;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (starts_and_stops(setup, pulses, middle) ? low : high) = middle;
  }
  return {low};
}

double tried_lag(const MotorSetup& setup, Hertz rate) {
  const double pulses = rate.value() * setup.excitation.steps_per_full_step();
  RunningMotor motor(setup);
  if (!run_up(motor, setup, pulses)) return 2;
  keep_up(motor, pulses, ringing);
  double most = 0;
  for (double left = ringing.value(); left > 0; left -= 1 / pulses) {
    motor.step(1);
    most = std::max(most, std::abs(motor.lag()));
    motor.run(Seconds(1 / pulses));
    most = std::max(most, std::abs(motor.lag()));
    if (motor.slipped() != 0) return 2;
  }
  return most;
}

std::vector<MotorMoment> tried_motion(const MotorSetup& setup, int steps, Hertz rate, Seconds whole, Seconds apart) {
  const double per_full_step = setup.excitation.steps_per_full_step();
  const double interval = 1 / (rate.value() * per_full_step);
  RunningMotor motor(setup);
  std::vector<MotorMoment> moments;
  double now = 0;
  int made = 0;
  const auto count = static_cast<std::int64_t>(whole / apart + 0.5);
  for (std::int64_t i = 0; i <= count; ++i) {
    const double until = static_cast<double>(i) * apart.value();
    while (made < steps && made * interval <= until) {
      motor.run(Seconds(made * interval - now));
      now = made * interval;
      motor.step(1);
      ++made;
    }
    motor.run(Seconds(until - now));
    now = until;
    moments.push_back({.time = Seconds(now),
                       .commanded = static_cast<double>(motor.commanded()) / per_full_step,
                       .place = motor.place() / per_full_step,
                       .speed = motor.speed(),
                       .current_a = motor.current_a(),
                       .current_b = motor.current_b(),
                       .torque = motor.torque()});
  }
  return moments;
}

}  // namespace passo
