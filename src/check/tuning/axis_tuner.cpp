#include "passo/tuning/axis_tuner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stability_sweep.hpp"
#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"

namespace passo {
namespace {

constexpr int speeds = 400;           // that are looked at
constexpr int points_of_curve = 120;  // for a picture
constexpr double as_good = 1.01;      // of the shortest time
constexpr int most_coarse = 2;        // steps of the driver to a full step
// From rest, friction appears at once: the swing after that jump needs this much of it.
constexpr double swing_of_a_jump = 1.38;
constexpr double most_jerk = 1e9;
constexpr double most_acceleration = 1e6;

double rounded_down(double value) {
  if (!(value > 0)) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  // Whole numbers over whole numbers, so that the result has no digits beyond the third.
  const double digits = std::floor(value / unit * (1 + 1e-12));
  return unit >= 1 ? digits * std::round(unit) : digits / std::round(1 / unit);
}

}  // namespace

// Half of the move is speeding up and running; the peak is lower where the way is short.
Seconds time_of_move(double way, MmPerSecond velocity, MmPerSecond2 acceleration, MmPerSecond3 jerk) {
  const double a = acceleration.value();
  const double j = jerk.value();
  const auto ramp = [&](double speed) { return speed >= a * a / j ? speed / a + a / j : 2 * std::sqrt(speed / j); };
  const double v = velocity.value();
  // A ramp is symmetrical, so its mean speed is half of its end: two ramps take the way v·ramp(v).
  if (v * ramp(v) <= way) return Seconds(way / v + ramp(v));
  double low = 0;
  double high = v;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (middle * ramp(middle) <= way ? low : high) = middle;
  }
  return Seconds(2 * ramp(low));
}

struct AxisTuner::Choice {
  double speed = 0;
  double time = 0;
};

std::optional<AxisTuner> AxisTuner::of(const AxisDescription& axis, const BoardDescription& board) {
  auto setup = motor_setup(axis);
  if (!setup) return std::nullopt;
  return AxisTuner(axis, board, std::move(*setup));
}

AxisTuner::AxisTuner(const AxisDescription& axis, const BoardDescription& board, MotorSetup setup)
    : axis_(axis), most_steps_(board.highest_event_rate), setup_(std::move(setup)) {
  setup_.load.friction_per_speed.value += setup_.damping.value;
  inertia_ = setup_.motor.rotor.inertia.value + setup_.load.inertia.value;
  weight_ = std::abs(axis.motor->weight.value);
  radians_per_unit_ = axis.motor->radians_per_unit;
  coarse_steps_ = setup_.excitation.steps_per_full_step() <= most_coarse;
}

// The setup of the trials has the motor's own damping once.
TorqueBand AxisTuner::band_to(double speed) const {
  MotorSetup tried = setup_;
  tried.load.friction_per_speed.value -= tried.damping.value;
  TorqueBand band(tried, axis_.motor->tolerance);
  band.try_steady({speed * radians_per_unit_});
  return band;
}

double AxisTuner::friction_at(double speed) const {
  return setup_.load.friction_at({speed * radians_per_unit_}).value + weight_;
}

double AxisTuner::usable_at(const TorqueBand& band, double share, double speed) const {
  const RadiansPerSecond shaft{speed * radians_per_unit_};
  return share * (coarse_steps_ ? band.while_steady(shaft) : band.of_curve(shaft).low).value;
}

double AxisTuner::acceleration_at(const TorqueBand& band, double share, double speed) const {
  const double torque = usable_at(band, share, speed) - friction_at(speed);
  const double most = std::min(torque / inertia_ / radians_per_unit_, most_acceleration);
  return axis_.follows_torque() ? std::min(most, axis_.motor->acceleration_at(MmPerSecond(speed)).value()) : most;
}

double AxisTuner::period_at(const TorqueBand& band, double share, double speed) const {
  const double torque = band.of_curve({speed * radians_per_unit_}).low.value;
  const double stiffness = setup_.motor.rotor.teeth() * torque * std::sqrt(1 - share * share);
  return 2 * std::numbers::pi * std::sqrt(inertia_ / stiffness);
}

// The highest speed up to which there is torque to accelerate with.
double AxisTuner::torque_ends_at(const TorqueBand& band, double share, double top) const {
  double end = 0;
  for (int i = 1; i <= speeds; ++i) {
    const double speed = top * i / speeds;
    if (!(acceleration_at(band, share, speed) > 0)) break;
    end = speed;
  }
  return end;
}

// The highest speed up to which no motor of the tolerance swings by itself, with steps in time and with late ones.
double AxisTuner::calm_to(double top) const {
  constexpr double below = 0.88;  // of the rate where the swing was seen
  const double steps_per_unit = setup_.motor.rotor.steps_per_revolution * radians_per_unit_ / (2 * std::numbers::pi);
  MotorSetup usual = setup_;
  usual.load.friction_per_speed.value -= usual.damping.value;
  usual.weight = {};
  double calm = top;
  for (const double strength : {1 - axis_.motor->tolerance, 1.0, 1 + axis_.motor->tolerance}) {
    for (const double late : {0.0, 0.41}) {
      const Hertz rate = calm_up_to(with_torque(usual, strength), Hertz(calm * steps_per_unit), late);
      if (rate.value() < calm * steps_per_unit) calm = below * rate.value() / steps_per_unit;
    }
  }
  return calm;
}

// The highest speed up to which the motor may stay at any speed.
double AxisTuner::steady_up_to(const TorqueBand& band, double share, double top) const {
  double end = 0;
  for (int i = 1; i <= speeds; ++i) {
    const double speed = top * i / speeds;
    if (share * band.while_steady({speed * radians_per_unit_}).value < friction_at(speed)) break;
    end = speed;
  }
  return end;
}

AxisTuner::Choice AxisTuner::choose(const TorqueBand& band, double share, double way, double top) const {
  std::vector<Choice> choices;
  double shortest = HUGE_VAL;
  for (int i = 1; i <= speeds; ++i) {
    const double speed = top * i / speeds;
    const double acceleration = acceleration_at(band, share, speed);
    if (!(acceleration > 0)) continue;
    const double jerk = std::min(acceleration / period_at(band, share, speed), most_jerk);
    const double time = time_of_move(way, MmPerSecond(speed), MmPerSecond2(acceleration), MmPerSecond3(jerk)).value();
    choices.push_back({.speed = speed, .time = time});
    shortest = std::min(shortest, time);
  }
  for (const Choice& choice : choices) {
    if (choice.time <= as_good * shortest) return choice;
  }
  return {};
}

AxisTuning AxisTuner::result_of(const TorqueBand& band, const TuningWish& wish, double way, double velocity,
                                double picture_end) const {
  const double share = 1 - wish.margin;
  AxisTuning tuning{.axis = axis_.axis, .margin = wish.margin, .way = way};
  const double rounded = rounded_down(velocity);
  tuning.velocity = MmPerSecond(rounded);
  const double acceleration = rounded_down(acceleration_at(band, share, rounded));
  tuning.acceleration = MmPerSecond2(acceleration);
  tuning.period = Seconds(period_at(band, share, rounded));
  tuning.jerk = MmPerSecond3(rounded_down(std::min(acceleration / tuning.period.value(), most_jerk)));
  tuning.time = time_of_move(way, tuning.velocity, tuning.acceleration, tuning.jerk);
  for (int i = 0; i <= points_of_curve; ++i) {
    const double speed = picture_end * i / points_of_curve;
    const RadiansPerSecond shaft{speed * radians_per_unit_};
    const double force = speed <= rounded ? inertia_ * acceleration * radians_per_unit_ : 0;
    tuning.curve.push_back({.speed = MmPerSecond(speed),
                            .pull_out = band.of_curve(shaft).low,
                            .steady = band.while_steady(shaft),
                            .usable = {share * band.of_curve(shaft).low.value},
                            .needed = {force + friction_at(speed)}});
  }
  return tuning;
}

Result<AxisTuning, TuningRefusal> AxisTuner::propose(const TuningWish& wish) const {
  const double share = 1 - wish.margin;
  const double way = wish.way > 0 ? wish.way : (axis_.travel_high - axis_.travel_low) / 2;
  const double of_board = most_steps_.value() / axis_.steps_per_unit;
  const bool is_wished = wish.fastest > MmPerSecond(0) && wish.fastest.value() < of_board;
  double top = is_wished ? wish.fastest.value() : of_board;
  TuningBound bound = is_wished ? TuningBound::wish : TuningBound::board;
  TorqueBand band = band_to(0);
  // With coarse steps the trials say what is usable, so they come first.
  if (coarse_steps_) band = band_to(top);
  const double start = swing_of_a_jump * (friction_at(0) - weight_) + weight_;
  if (start > share * band.of_curve({0}).low.value) {
    return Failure{
        TuningRefusal{fmt::format("friction and weight need {:.3g} N\u00B7m, but only {:.3g} N\u00B7m of the "
                                  "guaranteed torque are available with that margin",
                                  start, share * band.of_curve({0}).low.value)}};
  }
  const double torque_end = torque_ends_at(band, share, top);
  if (torque_end < top) bound = TuningBound::torque;
  top = calm_to(torque_end);
  if (top < torque_end) bound = TuningBound::swing;
  constexpr int most_rounds = 40;
  constexpr double near = 0.97;   // of a bound: the bound is the reason
  constexpr double lower = 0.93;  // the next end that is tried
  for (int round = 0; round < most_rounds && top > 0; ++round) {
    const Choice choice = choose(band, share, way, top);
    if (!(choice.speed > 0)) break;
    // The trials are at other rates for each end. So what counts are the trials up to this velocity, as a check of the
    // finished machine does them.
    band = band_to(choice.speed);
    const double calm = steady_up_to(band, share, choice.speed);
    if (calm >= choice.speed) {
      AxisTuning tuning = result_of(band, wish, way, choice.speed,
                                    std::max(1.2 * choice.speed, std::min(torque_end, 2 * choice.speed)));
      tuning.bound = choice.speed < near * top ? TuningBound::time : bound;
      return tuning;
    }
    top = std::max(calm, lower * choice.speed);
    bound = TuningBound::swing;
  }
  return Failure{TuningRefusal{"the motor may lose steps through resonance at any speed; more microsteps may help"}};
}

}  // namespace passo
