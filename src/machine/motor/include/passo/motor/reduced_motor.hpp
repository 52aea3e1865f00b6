// ReducedMotor: a stepping motor whose currents provably follow, so that only its rotor is left to move.
//
// RunningMotor integrates the currents of both phases, because a supply that cannot push them in time is what makes a
// motor lose its torque, and swing. Where the supply can, the currents at the end of each step are those that the
// driver wants, whatever the rotor does. Then torque depends on the load angle e alone, the field ahead of the rotor:
//
//   J·dω/dt = K·I·sin e − b·ω − friction − weight
//
// The rotor moves in blocks of a fixed time, a fifth of a radian of its ringing, with one kick of the torque in the
// middle. The field of a block is its mean over the block's time. Many pulses share a block, so a pulse costs some
// additions.
//
// The bound. It is looked at with each pulse and each block, and the motor says so where it fails:
//
//   a pulse comes L·I·Δ/(U − K·|ω|) after the one before, or later     Δ: the electrical angle of a step
//   |e| ≤ 0.8 radians at the end of each block                          U = min(V − R·I, decay·V)
//
// docs/ramps/physics.md derives the bound: while it holds, the currents feed nothing back to the rotor, so the drive
// makes no mid-band instability, and the rotor is far from losing a step at the end of each block. The drive must be a
// chopper with microsteps, or the motor a measured curve with microsteps.
//
// Times and places do not depend on how often somebody looks. Cost: docs/ramps/physics.md has a table.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "passo/motor/running_motor.hpp"

namespace passo {

// What was done of a time that should pass and a step that should follow.
enum class PulseDone : std::uint8_t { nothing, time_only, all };

class ReducedMotor {
 public:
  explicit ReducedMotor(const MotorSetup& setup);

  // Whether the motor and its drive are of a kind for which there is a bound.
  static bool suits(const MotorSetup& setup);

  // Goes on from a rotor's state. `commanded`: steps of the driver, less those that were lost.
  void begin(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque);
  // Ends the block that was begun, so that the state is that of this time.
  void end_block();

  // One step of the driver. False: the currents might not have arrived yet. Then nothing was done.
  [[nodiscard]] bool step(int way) {
    if (since_ < need_) return false;
    since_ = 0;
    commanded_ += way;
    const double turned = way * field_step_;
    ahead_ += turned;
    area_ -= turned * delay_;
    rests_ = false;
    return true;
  }
  // Lets time pass. Call holds() after it.
  void run(double time) {
    since_ += time;
    if (held_ + time < block_.time) {
      held_ += time;
      area_ += time * ahead_;
      return;
    }
    run_blocks(time);
  }
  // run() and then step() in one, for a motor that turns. `way` 0: no step. Call holds() after it where not all is
  // done.
  [[nodiscard]] PulseDone turn(double time, int way) {
    if (rests_) return PulseDone::nothing;
    run(time);
    if (rests_ || !holds_) return PulseDone::time_only;
    return way == 0 || step(way) ? PulseDone::all : PulseDone::time_only;
  }
  // The bound holds at the end of the last block. If not, the motor stands still there in time.
  bool holds() const { return holds_; }
  // The time that has not passed, because the bound did not hold.
  Seconds left() const { return Seconds(left_); }
  // The time from one pulse to the next that the currents need at a speed. Infinite: they do not arrive at all.
  double needed_time(RadiansPerSecond speed) const;

  void set_resistance(NewtonMetres torque);
  bool rests() const { return rests_; }
  // Steps of the driver, less those that were lost before begin().
  std::int64_t commanded() const { return commanded_; }
  double place() const { return static_cast<double>(commanded_) - load_angle() * places_per_radian_; }
  // The field ahead of the rotor, in electrical radians.
  double load_angle() const { return ahead_ - drift_ * held_; }
  // Of small swings.
  Seconds ringing_period() const { return Seconds(6.28318530717958648 / std::sqrt(ringing_squared_)); }
  RadiansPerSecond speed() const { return {speed_}; }
  NewtonMetres mean_torque() const { return {mean_torque_}; }

  static constexpr double most_load_angle = 0.8;

 private:
  // A block's time, and what follows from it.
  struct Block {
    double time = 0;
    double rate = 0;     // 1/time
    double turn = 0;     // electrical angle of half a block for each rad/s
    double keep = 0;     // of the speed, after friction that grows with it
    double gain = 0;     // of the speed, for each newton-metre
    double average = 0;  // share of the block in the mean torque
  };

  Block block_of(double time) const;
  void run_blocks(double time);
  void move(const Block& block);
  double torque_at(double ahead) const;
  double other_torque_at(double ahead) const;
  void check_rest(double before);
  void check_currents();

  // Of the motor and its drive.
  double teeth_;
  double inertia_;
  double viscous_;
  double dry_;
  double weight_;
  double detent_;
  double amplitude_;  // K·I
  double field_step_;
  double places_per_radian_;
  double ringing_squared_;
  double most_square_at_rest_;  // of the speed
  double first_;                // the field's angle at place 0
  double volt_seconds_ = 0;
  double voltage_ = 0;
  double mean_voltage_ = 0;
  double back_emf_ = 0;
  std::optional<TorqueCurve> measured_;
  bool is_plain_;  // neither measured nor with a detent
  Block block_;

  // The state.
  std::int64_t commanded_ = 0;
  double ahead_ = 0;  // of the rotor at the begin of the block
  double speed_ = 0;
  double drift_ = 0;  // the same in electrical radians a second
  double torque_ = 0;
  double mean_torque_ = 0;
  double resisting_ = 0;
  double held_ = 0;  // seconds of the block
  double area_ = 0;  // of ahead_ over them
  double since_ = 0;
  double left_ = 0;
  double need_ = 0;
  double delay_ = 0;
  bool holds_ = true;
  bool rests_ = false;
};

}  // namespace passo
