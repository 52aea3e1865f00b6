// BoundedMotor: a stepper motor in motion, fully integrated only where its bound does not hold.
//
// While the bound of ReducedMotor holds, the currents are not integrated. Where the bound fails, RunningMotor continues
// from the rotor's state, with the currents that the driver sets; when the motor has settled, ReducedMotor takes over
// again. docs/ramps/physics.md states the possible difference in position from a motor that is always fully integrated.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/motor/reduced_motor.hpp"
#include "passo/motor/running_motor.hpp"

namespace passo {

enum class Integration : std::uint8_t {
  where_needed,  // fully only where the bound does not hold
  always,
};

class BoundedMotor {
 public:
  // The motor starts at rest at position 0, like a RunningMotor. The setup's parts must have passed their checks.
  BoundedMotor(const MotorSetup& setup, Integration integration);

  void step(int way) {
    if (is_reduced_ && reduced_->step(way)) return;
    step_in_full(way);
  }
  void run(Seconds time) {
    if (!is_reduced_) return run_in_full(time);
    reduced_->run(time.value());
    if (!reduced_->holds()) leave();
  }
  // Combines run() and step() for the most frequent case, in which the bound holds and the motor turns.
  [[nodiscard]] PulseDone turn(Seconds time, int way) {
    if (!is_reduced_) return PulseDone::nothing;
    const PulseDone done = reduced_->turn(time.value(), way);
    if (done == PulseDone::time_only && !reduced_->holds()) leave();
    return done;
  }
  void set_resistance(NewtonMetres torque);
  // While the rotor is carried by hand, the motor is fully integrated.
  void carry(RadiansPerSecond speed);
  void let_go();

  // The same as those of RunningMotor.
  double place() const { return is_reduced_ ? reduced_->place() : full_.place(); }
  double lag() const { return is_reduced_ ? reduced_->load_angle() * full_steps_per_radian : full_.lag(); }
  std::int64_t slipped() const { return full_.slipped(); }
  RadiansPerSecond speed() const { return is_reduced_ ? reduced_->speed() : full_.speed(); }
  NewtonMetres mean_torque() const { return is_reduced_ ? reduced_->mean_torque() : full_.mean_torque(); }
  bool rests() const { return is_reduced_ ? reduced_->rests() : full_.rests(); }
  int steps_per_full_step() const { return full_.steps_per_full_step(); }
  // Returns true if the bound holds now.
  bool is_reduced() const { return is_reduced_; }

 private:
  static constexpr double full_steps_per_radian = 0.63661977236758134;  // 2/π

  void step_in_full(int way);
  void run_in_full(Seconds time);
  void leave();
  bool is_calm() const;
  double interval_needed() const;

  RunningMotor full_;
  std::optional<ReducedMotor> reduced_;
  bool is_reduced_ = false;
  double calm_ = 0;   // seconds
  double since_ = 0;  // the last step, fully integrated
  double interval_ = 0;
};

}  // namespace passo
