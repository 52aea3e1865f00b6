// ReducedMotor: a stepper motor whose currents provably follow the driver, so that only its rotor is integrated.
//
// RunningMotor integrates the currents of both phases, because a motor loses torque and oscillates when the supply
// cannot drive the currents fast enough. If the supply can, the currents at the end of each step are those that the
// driver sets, whatever the rotor does. Then the torque depends only on the load angle e, the angle of the field ahead
// of the rotor:
//
//   J·dω/dt = K·I·sin e − b·ω − friction − weight
//
// The rotor is integrated in blocks of a fixed time, a fifth of a radian of its resonance, with one torque impulse in
// the middle. The field of a block is its mean over the block's time. Many pulses share a block, so a pulse costs some
// additions.
//
// The bound is checked at each pulse and each block, and the motor reports a violation:
//
//   the time since the last pulse is at least L·I·Δ/(U − K·|ω|)         Δ: the electrical angle of a step
//   |e| ≤ 0.8 radians at the end of each block                          U = min(V − R·I, decay·V)
//
// docs/ramps/physics.md derives the bound: while it holds, the currents do not react on the rotor, so there is no
// mid-band instability, and the rotor is far from losing a step at the end of each block. The drive must be a chopper
// with microsteps, or the motor a measured curve with microsteps.
//
// Times and positions do not depend on how often they are read. Cost: docs/ramps/physics.md has a table.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "passo/motor/running_motor.hpp"

namespace passo {

// How much was done of a time that should pass and a step after it.
enum class PulseDone : std::uint8_t { nothing, time_only, all };

class ReducedMotor {
 public:
  explicit ReducedMotor(const MotorSetup& setup);

  // Whether a bound exists for this kind of motor and drive.
  static bool suits(const MotorSetup& setup);

  // Continues from a rotor's state. `commanded`: driver steps, without the lost ones.
  void begin(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque);
  // Ends the current block, so that the state is that of this time.
  void end_block();

  // Makes one driver step. Returns false if the currents might not have settled yet. Then nothing was done.
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
  // Lets time pass. Call holds() afterwards.
  void run(double time) {
    since_ += time;
    if (held_ + time < block_.time) {
      held_ += time;
      area_ += time * ahead_;
      return;
    }
    run_blocks(time);
  }
  // Combines run() and step(), for a turning motor. `way` 0: no step. Call holds() afterwards if not all is done.
  [[nodiscard]] PulseDone turn(double time, int way) {
    if (rests_) return PulseDone::nothing;
    run(time);
    if (rests_ || !holds_) return PulseDone::time_only;
    return way == 0 || step(way) ? PulseDone::all : PulseDone::time_only;
  }
  // Returns true if the bound holds at the end of the last block. If not, the motor's time stops there.
  bool holds() const { return holds_; }
  // The time that has not passed, because the bound does not hold.
  Seconds left() const { return Seconds(left_); }
  // Returns the time between pulses that the currents need at a speed. Infinite: they never settle.
  double needed_time(RadiansPerSecond speed) const;

  void set_resistance(NewtonMetres torque);
  bool rests() const { return rests_; }
  // Driver steps, without those lost before begin().
  std::int64_t commanded() const { return commanded_; }
  double place() const { return static_cast<double>(commanded_) - load_angle() * places_per_radian_; }
  // The angle of the field ahead of the rotor, in electrical radians.
  double load_angle() const { return ahead_ - drift_ * held_; }
  // The period of small oscillations.
  Seconds ringing_period() const { return Seconds(6.28318530717958648 / std::sqrt(ringing_squared_)); }
  RadiansPerSecond speed() const { return {speed_}; }
  NewtonMetres mean_torque() const { return {mean_torque_}; }

  static constexpr double most_load_angle = 0.8;

 private:
  // A block's time, and values derived from it.
  struct Block {
    double time = 0;
    double rate = 0;     // 1/time
    double turn = 0;     // electrical angle of half a block for each rad/s
    double keep = 0;     // factor on the speed, after viscous friction
    double gain = 0;     // speed change per newton-metre
    double average = 0;  // weight of the block in the mean torque
  };

  Block block_of(double time) const;
  void run_blocks(double time);
  void move(const Block& block);
  double torque_at(double ahead) const;
  double other_torque_at(double ahead) const;
  void check_rest(double before);
  void check_currents();

  // Properties of the motor and its drive.
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
  double most_square_at_rest_;  // square of the speed below which the rotor can rest
  double first_;                // the field's angle at place 0
  double volt_seconds_ = 0;
  double voltage_ = 0;
  double mean_voltage_ = 0;
  double back_emf_ = 0;
  std::optional<TorqueCurve> measured_;
  bool is_plain_;  // no measured curve, and no detent torque
  Block block_;

  // The state.
  std::int64_t commanded_ = 0;
  double ahead_ = 0;  // relative to the rotor at the start of the block
  double speed_ = 0;
  double drift_ = 0;  // its rate, in electrical radians per second
  double torque_ = 0;
  double mean_torque_ = 0;
  double resisting_ = 0;
  double held_ = 0;  // time since the start of the block, in seconds
  double area_ = 0;  // integral of ahead_ over that time
  double since_ = 0;
  double left_ = 0;
  double need_ = 0;
  double delay_ = 0;
  bool holds_ = true;
  bool rests_ = false;
};

}  // namespace passo
