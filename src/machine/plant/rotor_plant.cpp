#include "passo/plant/rotor_plant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr Seconds short_time{0.2e-3};
constexpr Seconds between_margins{1e-3};  // the torque is averaged over 3 ms
// While a rotor lags by no more, a pulse moves it by no more than a step and what the lag may change.
constexpr double small_lag = 0.55;  // full steps

}  // namespace

void RotorPlant::fit_motor(std::size_t motor, const MotorSetup& setup) {
  motors_[motor].rotor.emplace(setup, integration_);
  motors_[motor].turns_freely = true;
  motors_[motor].setup = setup;
  motors_[motor].origin = positions()[motor];
  motors_[motor].full_step = 1.0 / setup.excitation.steps_per_full_step();
  motors_[motor].pull_out = pull_out_curve(setup);
  fitted_ = std::max(fitted_, motor + 1);
}

void RotorPlant::fit_encoder(std::size_t motor, const EncoderModel& model) {
  motors_[motor].drive.emplace(model, *motors_[motor].setup);
  motors_[motor].turns_freely = false;
}

void RotorPlant::set_resistance(std::size_t motor, NewtonMetres torque) {
  if (motors_[motor].rotor) motors_[motor].rotor->set_resistance(torque);
}

void RotorPlant::disturb(const Disturbance& disturbance) {
  disturbances_.push_back(disturbance);
  disturbs_.push_back(false);
  next_disturbance_ = std::min(next_disturbance_, disturbance.from);
}

void RotorPlant::update_disturbances(Seconds time) {
  next_disturbance_ = Seconds(HUGE_VAL);
  for (std::size_t i = 0; i < disturbances_.size(); ++i) {
    const Disturbance& one = disturbances_[i];
    const bool holds = one.from <= time && time < one.until;
    if (holds != disturbs_[i]) set_resistance(one.motor, {holds ? one.torque.value : 0});
    disturbs_[i] = holds;
    if (time < one.from) next_disturbance_ = std::min(next_disturbance_, one.from);
    if (holds) next_disturbance_ = std::min(next_disturbance_, one.until);
  }
}

int RotorPlant::steps_per_full_step(std::size_t motor) const {
  return motors_[motor].rotor ? motors_[motor].rotor->steps_per_full_step() : 0;
}

// The rotors move also between pulses, so every event counts.
std::int64_t RotorPlant::events_to_next_change() const {
  return fitted_ > 0 ? 1 : steps_to_next_switch();
}

// `stepped`: the pulse that the motor has just got, if any. Before the pulse the lag was another one.
inline void RotorPlant::update_lag(std::size_t motor, int stepped) {
  Fitted& one = motors_[motor];
  const double after = one.drive ? one.drive->error() * one.full_step : one.rotor->lag();
  const double lag = std::max(std::abs(after), std::abs(after - stepped * one.full_step));
  if (lag > one.record.most_lag) [[unlikely]] {
    one.record.most_lag = lag;
    one.record.most_lag_at = now_;
    one.next_lag = std::min(lag, small_lag);
  }
  is_close_ &= lag <= small_lag && one.rotor->is_reduced();
  if (now_.value() >= one.margin_due.value()) [[unlikely]]
    update_margin(one);
  if (!one.rotor->is_reduced() && one.rotor->slipped() != one.record.lost) record_loss(motor);
}

// Lets time pass for a motor, and then gives it its steps.
inline void RotorPlant::turn(std::size_t motor, Seconds passed, std::int64_t steps) {
  Fitted& one = motors_[motor];
  if (one.drive) [[unlikely]]
    return turn_with_encoder(motor, passed, steps);
  const bool rests = one.rotor->rests();
  if (rests && steps == 0) return;
  if (!rests && passed.value() > 0) one.rotor->run(passed);
  apply_steps(motor, passed, steps);
}

void RotorPlant::apply_steps(std::size_t motor, Seconds passed, std::int64_t steps) {
  Fitted& one = motors_[motor];
  const int way = steps > 0 ? 1 : -1;
  for (std::int64_t left = std::abs(steps); left > 0; --left) one.rotor->step(way);
  // Where the bound holds, the look after the next pulse is enough.
  if (steps == 0 && one.rotor->is_reduced() && passed < short_time) return;
  update_lag(motor, steps == 0 ? 0 : way);
}

// The usual case of turn(), kept short: each motor passes here at each pulse. `way`: 1, -1, or 0 for no step. False:
// nothing was done.
inline bool RotorPlant::turn_freely(std::size_t motor, Seconds passed, int way) {
  Fitted& one = motors_[motor];
  const PulseDone done = one.rotor->turn(passed, way);
  if (done == PulseDone::nothing) return false;
  if (done == PulseDone::time_only) [[unlikely]] {
    apply_steps(motor, passed, way);
    return true;
  }
  if (way == 0) return true;
  const double after = one.rotor->lag();
  const double lag = std::max(std::abs(after), std::abs(after - way * one.full_step));
  if (lag > one.next_lag || now_.value() >= one.margin_due.value()) [[unlikely]]
    update_lag(motor, way);
  return true;
}

void RotorPlant::turn_with_encoder(std::size_t motor, Seconds passed, std::int64_t steps) {
  Fitted& one = motors_[motor];
  if (steps == 0 && one.drive->rests(*one.rotor)) return;
  one.drive->run(*one.rotor, passed);
  one.drive->pulse(*one.rotor, steps);
  update_lag(motor, 0);
  if (!one.drive->is_alarmed() || following_fault_) return;
  following_fault_ = {.time = now_, .motor = motor, .error = one.drive->error()};
  set_switch(input_emergency_stop, true);
  is_close_ = false;
}

void RotorPlant::pulse(Seconds time, const MotorSteps& steps) {
  const Seconds passed = pass_to(time);
  if (time.value() >= next_disturbance_.value()) [[unlikely]]
    update_disturbances(time);
  is_close_ = true;
  const bool is_short = passed.value() < short_time.value();
  const std::size_t fitted = fitted_;
  for (std::size_t m = 0; m < fitted; ++m) {
    const bool is_single = steps[m] >= -1 && steps[m] <= 1;
    if (is_short && is_single && motors_[m].turns_freely && turn_freely(m, passed, static_cast<int>(steps[m])))
      continue;
    if (motors_[m].rotor) turn(m, passed, steps[m]);
  }
  for (std::size_t m = 0; m < steps.size(); ++m) untaken_[m] += steps[m];
  if (--quiet_pulses_ <= 0 || !is_close_) update_places();
}

// The switches need not follow each pulse of rotors that stay close to their commanded places.
void RotorPlant::update_places() {
  update_positions();
  set_switches(now_);
  double wander = 0;  // steps, back and forth
  for (std::size_t m = 0; m < fitted_; ++m) {
    if (motors_[m].rotor) wander = std::max(wander, 2 * small_lag / motors_[m].full_step);
  }
  const std::int64_t spare = static_cast<std::int64_t>(wander) + 1;
  const std::int64_t steps = steps_to_next_switch();
  quiet_pulses_ = fitted_ > 0 && is_close_ && steps > spare ? steps - spare : 1;
}

void RotorPlant::update_positions() {
  MotorPositions& moving = moving_positions();
  for (std::size_t m = 0; m < moving.size(); ++m) {
    const Fitted& one = motors_[m];
    if (one.rotor) {
      moving[m] = one.origin + one.rotor->place();
    } else {
      moving[m] += static_cast<double>(untaken_[m]);
    }
  }
  untaken_ = {};
}

void RotorPlant::run_to(Seconds time) {
  const Seconds passed = pass_to(time);
  if (time >= next_disturbance_) [[unlikely]]
    update_disturbances(time);
  if (fitted_ == 0 || passed.value() <= 0) return;
  for (std::size_t m = 0; m < fitted_; ++m) {
    if (motors_[m].rotor) turn(m, passed, 0);
  }
  update_positions();
  move_slides();
}

Seconds RotorPlant::pass_to(Seconds time) {
  const Seconds passed(std::max(time.value() - now_.value(), 0.0));
  now_ = Seconds(std::max(now_.value(), time.value()));
  return passed;
}

void RotorPlant::record_loss(std::size_t motor) {
  Fitted& one = motors_[motor];
  const std::int64_t lost = one.rotor->slipped() - one.record.lost;
  one.record.lost += lost;
  if (losses_.size() < most_losses) losses_.push_back({.time = now_, .motor = motor, .steps = lost});
}

void RotorPlant::update_margin(Fitted& one) const {
  one.margin_due = now_ + between_margins;
  if (!one.pull_out) return;
  const RadiansPerSecond speed{std::abs(one.rotor->speed().value)};
  const double torque = std::abs(one.rotor->mean_torque().value);
  const double most = one.pull_out->pull_out(speed).value;
  const double margin = torque < 2 * most ? 1 - torque / most : -1;
  if (margin >= one.record.least_margin) return;
  one.record.least_margin = margin;
  one.record.least_margin_at = now_;
}

std::uint16_t RotorPlant::inputs_at(Seconds time) {
  if (time <= now_ && quiet_pulses_ > 1) return switches().closed();
  run_to(time);
  update_places();
  return switches().closed();
}

bool RotorPlant::settle(Seconds most) {
  constexpr Seconds look{0.01};
  const auto moves = [](const Fitted& one) {
    return one.rotor && !(one.drive ? one.drive->rests(*one.rotor) : one.rotor->rests());
  };
  const Seconds end = now_ + most;
  while (std::ranges::any_of(motors_, moves)) {
    if (now_ >= end) return false;
    run_to(now_ + look);
  }
  update_places();
  return true;
}

Truth RotorPlant::truth_at(Seconds time) {
  run_to(time);
  update_places();
  return truth_now(time);
}

}  // namespace passo
