#include "phase_currents.hpp"

#include <algorithm>
#include <array>

namespace passo {
namespace {

constexpr int points_of_rise = 8;

// The parts of the rated current that F1 to F4 carry: one half of a phase for each direction.
std::array<double, winding_outputs> shares_of(const WindingState& state) {
  return {std::max(state.phase_a, 0.0), std::max(state.phase_b, 0.0), std::max(-state.phase_a, 0.0),
          std::max(-state.phase_b, 0.0)};
}

}  // namespace

PhaseCurrents::PhaseCurrents(const WindingMotors& motors) : excitation_(motors.excitation), motors_(motors.count) {
  if (!motors.stage) return;
  const WindingCircuit& circuit = motors.stage->circuit;
  rated_ = motors.stage->rated.value;
  const Seconds rise =
      circuit.limit ? circuit.rise_time(*circuit.limit).value_or(circuit.time_constant()) : circuit.time_constant();
  apart_ = Seconds(std::min(rise, circuit.time_constant()).value() / points_of_rise);
  for (Motor& motor : motors_) {
    motor.windings.assign(winding_outputs, WindingCurrent(circuit));
    switch_windings(motor);
    for (WindingCurrent& winding : motor.windings) winding.settle();
  }
}

void PhaseCurrents::switch_windings(Motor& motor) const {
  const auto shares = shares_of(excitation_.at(motor.place));
  for (std::size_t output = 0; output < motor.windings.size(); ++output) {
    motor.windings[output].switch_to(shares[output]);
  }
}

PhaseCurrents::Phases PhaseCurrents::of(std::size_t motor) const {
  const Motor& one = motors_[motor];
  if (one.windings.empty()) {
    const WindingState state = excitation_.at(one.place);
    return {state.phase_a, state.phase_b};
  }
  const auto part = [&](std::size_t output) { return one.windings[output].now().value / rated_; };
  return {part(0) - part(2), part(1) - part(3)};
}

void PhaseCurrents::move_to(std::size_t motor, std::int64_t place) {
  if (motors_[motor].place == place) return;
  motors_[motor].place = place;
  switch_windings(motors_[motor]);
}

bool PhaseCurrents::are_settled() const {
  return std::ranges::all_of(motors_, [&](const Motor& motor) {
    return std::ranges::all_of(motor.windings, [&](const WindingCurrent& one) { return one.is_settled({rated_}); });
  });
}

void PhaseCurrents::run(Seconds time) {
  now_ = now_ + time;
  for (Motor& motor : motors_) {
    for (WindingCurrent& winding : motor.windings) winding.run(time);
  }
}

}  // namespace passo
