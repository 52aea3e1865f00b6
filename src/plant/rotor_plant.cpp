#include "passo/plant/rotor_plant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {

void RotorPlant::fit_motor(std::size_t motor, const MotorSetup& setup) {
  motors_[motor].rotor.emplace(setup);
  motors_[motor].origin = positions()[motor];
  motors_[motor].pull_out = pull_out_curve(setup);
  any_ = true;
}

void RotorPlant::set_resistance(std::size_t motor, NewtonMetres torque) {
  if (motors_[motor].rotor) motors_[motor].rotor->set_resistance(torque);
}

int RotorPlant::steps_per_full_step(std::size_t motor) const {
  return motors_[motor].rotor ? motors_[motor].rotor->steps_per_full_step() : 0;
}

// The rotors move also between pulses, so every event counts.
std::int64_t RotorPlant::events_to_next_change() const {
  return any_ ? 1 : steps_to_next_switch();
}

void RotorPlant::pulse(Seconds time, const MotorSteps& steps) {
  run_to(time);
  MotorPositions& moving = moving_positions();
  for (std::size_t m = 0; m < steps.size(); ++m) {
    if (steps[m] == 0) continue;
    if (!motors_[m].rotor) {
      moving[m] += static_cast<double>(steps[m]);
      continue;
    }
    const int way = steps[m] > 0 ? 1 : -1;
    for (std::int64_t left = std::abs(steps[m]); left > 0; --left) motors_[m].rotor->step(way);
    look_at(m);
  }
  set_switches();
}

void RotorPlant::run_to(Seconds time) {
  const Seconds passed = time - std::exchange(now_, std::max(now_, time));
  if (!any_ || passed.value() <= 0) return;
  MotorPositions& moving = moving_positions();
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    Fitted& one = motors_[m];
    if (!one.rotor || one.rotor->rests()) continue;
    one.rotor->run(passed);
    moving[m] = one.origin + one.rotor->place();
    look_at(m);
  }
  move_slides();
}

void RotorPlant::look_at(std::size_t motor) {
  Fitted& one = motors_[motor];
  const double lag = std::abs(one.rotor->lag());
  if (lag > one.record.most_lag) {
    one.record.most_lag = lag;
    one.record.most_lag_at = now_;
  }
  if (one.pull_out) {
    const RadiansPerSecond speed{std::abs(one.rotor->speed().value)};
    const double torque = std::abs(one.rotor->mean_torque().value);
    const double most = one.pull_out->pull_out(speed).value;
    const double margin = torque < 2 * most ? 1 - torque / most : -1;
    if (margin < one.record.least_margin) {
      one.record.least_margin = margin;
      one.record.least_margin_at = now_;
    }
  }
  const std::int64_t lost = one.rotor->slipped() - one.record.lost;
  if (lost == 0) return;
  one.record.lost += lost;
  if (losses_.size() < most_losses) losses_.push_back({.time = now_, .motor = motor, .steps = lost});
}

std::uint16_t RotorPlant::inputs_at(Seconds time) {
  run_to(time);
  set_switches();
  return switches().closed();
}

bool RotorPlant::settle(Seconds most) {
  constexpr Seconds look{0.01};
  const auto moves = [](const Fitted& one) { return one.rotor && !one.rotor->rests(); };
  const Seconds end = now_ + most;
  while (std::ranges::any_of(motors_, moves)) {
    if (now_ >= end) return false;
    run_to(now_ + look);
  }
  set_switches();
  return true;
}

Truth RotorPlant::truth_at(Seconds time) {
  run_to(time);
  set_switches();
  return {.positions = slides(), .spindle_turns = spindle().turns_at(time), .inputs = switches().closed()};
}

}  // namespace passo
