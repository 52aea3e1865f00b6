#include "passo/motor/reduced_motor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

constexpr double longest_block = 200e-6;
constexpr double radians_in_block = 0.2;
constexpr double averaging_time = 3e-3;  // seconds, as in RunningMotor
constexpr double share_at_rest = 1e-9;   // of the energy that holds a rotor, about as in RunningMotor
constexpr double care = 1.1;             // the speed may grow until the next look
constexpr double long_ago = 1e9;
constexpr double least_delay = 12.5e-6;  // half a step of the full integration

// The sine of −1.6 … 1.6, to 1e-7. Pairs of terms, so that few products wait for others: a block waits for this.
double small_sine(double x) {
  const double q = x * x;
  constexpr double a = 1.0 / 6;
  constexpr double b = a / 20;
  constexpr double c = b / 42;
  constexpr double d = c / 72;
  constexpr double e = d / 110;
  const double q2 = q * q;
  return x * ((1 - a * q) + q2 * (b - c * q) + q2 * q2 * (d - e * q));
}

}  // namespace

bool ReducedMotor::suits(const MotorSetup& setup) {
  return setup.excitation.is_sine() && (setup.measured || setup.drive.regulation == Regulation::chopper);
}

ReducedMotor::ReducedMotor(const MotorSetup& setup)
    : teeth_(setup.motor.rotor.teeth()),
      inertia_(setup.motor.rotor.inertia.value + setup.load.inertia.value),
      viscous_(setup.damping.value + setup.load.friction_per_speed.value),
      dry_(setup.load.friction.value),
      weight_(setup.weight.value),
      detent_(setup.detent.value),
      field_step_(std::numbers::pi / 2 / setup.excitation.steps_per_full_step()),
      places_per_radian_(1 / field_step_),
      first_(std::numbers::pi / 4),
      measured_(setup.measured),
      is_plain_(!measured_ && detent_ == 0) {
  const MotorData winding = as_wound(setup.motor, setup.drive.winding);
  const double current = winding.rated_current.value;
  amplitude_ = measured_ ? measured_->pull_out({0}).value : winding.holding_torque.value / std::numbers::sqrt2;
  if (!measured_) {
    const double supply = setup.drive.supply.value - setup.drive.drop.value;
    volt_seconds_ = care * winding.inductance.value * current * field_step_;
    voltage_ = std::min(supply - winding.resistance.value * current, setup.drive.fast_decay * supply);
    const double decay = setup.drive.fast_decay;
    mean_voltage_ = supply * 2 * decay / (1 + decay);
    back_emf_ = winding.holding_torque.value / (std::numbers::sqrt2 * current);
  }
  ringing_squared_ = teeth_ * (amplitude_ + 4 * detent_) / inertia_;
  most_square_at_rest_ = share_at_rest * amplitude_ / (teeth_ * inertia_);
  block_ = block_of(std::min(longest_block, radians_in_block / std::sqrt(ringing_squared_)));
}

// A drift, a kick and a drift ring a little too fast. With the kick (sin x/x)² as strong, x = ω·h/2, small swings have
// the right frequency.
ReducedMotor::Block ReducedMotor::block_of(double time) const {
  const double square = ringing_squared_ * time * time / 4;
  const double kick = time / inertia_ * (1 - square / 3 * (1 - square * 2 / 15));
  const double fade = viscous_ * time / (2 * inertia_);
  return {.time = time,
          .rate = 1 / time,
          .turn = teeth_ * time / 2,
          .keep = (1 - fade) / (1 + fade),
          .gain = kick / (1 + fade),
          .average = std::min(time / averaging_time, 1.0)};
}

void ReducedMotor::begin(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque) {
  commanded_ = commanded;
  ahead_ = (static_cast<double>(commanded) - place) * field_step_;
  speed_ = speed.value;
  drift_ = teeth_ * speed_;
  mean_torque_ = mean_torque.value;
  held_ = 0;
  area_ = 0;
  left_ = 0;
  since_ = long_ago;
  check_currents();
  holds_ = std::abs(ahead_) <= most_load_angle;
  rests_ = false;
}

double ReducedMotor::needed_time(RadiansPerSecond speed) const {
  if (measured_) return 0;
  const double left = voltage_ - care * back_emf_ * std::abs(speed.value);
  return left > 0 ? volt_seconds_ / left : std::numeric_limits<double>::infinity();
}

// Each phase's current reaches its new value at an even rate. So the field of both is late by the time in which a lack
// in proportion to |sin φ|, of a torque in proportion to |sin φ| too, ends under a back-EMF in proportion to |sin φ|.
void ReducedMotor::check_currents() {
  need_ = needed_time({speed_});
  if (measured_) return;
  constexpr double lack = 0.42;      // 1/2 of the mean of |sin φ|³ + |cos φ|³
  constexpr double opposing = 0.88;  // the mean of |sin φ|⁴ over that of |sin φ|³
  const double pushes = mean_voltage_ - opposing * back_emf_ * std::abs(speed_);
  if (pushes > 0) delay_ = std::max(least_delay, lack / care * volt_seconds_ / pushes);
}

void ReducedMotor::set_resistance(NewtonMetres torque) {
  resisting_ = torque.value;
  rests_ = false;
}

void ReducedMotor::run_blocks(double time) {
  while (held_ + time >= block_.time) {
    const double left = block_.time - held_;
    area_ += left * ahead_;
    time -= left;
    move(block_);
    if (rests_) return;
    if (!holds_) {
      left_ = time;
      return;
    }
  }
  held_ = time;
  area_ = time * ahead_;
}

void ReducedMotor::end_block() {
  if (held_ > 0) move(block_of(held_));
}

// `ahead`: the field's mean ahead of the rotor in the middle of the block.
inline double ReducedMotor::torque_at(double ahead) const {
  if (!is_plain_ || std::abs(ahead) > 1.6) return other_torque_at(ahead);
  return amplitude_ * small_sine(ahead);
}

void ReducedMotor::move(const Block& block) {
  const double before = speed_;
  torque_ = torque_at(area_ * block.rate - block.turn * before);
  mean_torque_ += (torque_ - mean_torque_) * block.average;
  const double free = before * block.keep + (torque_ - weight_) * block.gain;
  const double dry = (dry_ + resisting_) * block.gain;
  speed_ = std::copysign(std::max(std::abs(free) - dry, 0.0), free);
  ahead_ -= block.turn * (before + speed_);
  drift_ = teeth_ * speed_;
  held_ = 0;
  area_ = 0;
  check_currents();
  holds_ = std::abs(ahead_) <= most_load_angle && need_ < long_ago;
  if (speed_ * speed_ <= most_square_at_rest_) [[unlikely]]
    check_rest(before);
}

double ReducedMotor::other_torque_at(double ahead) const {
  const double amplitude = measured_ ? measured_->pull_out({std::abs(speed_)}).value : amplitude_;
  if (detent_ == 0) return amplitude * std::sin(ahead);
  // The detent goes up and down with each full step; its mean over the block counts.
  const double turned = drift_ * block_.time / 2;
  const double angle = first_ + static_cast<double>(commanded_) * field_step_ - ahead_ + turned;
  const double way = 4 * turned;
  const double mean = std::abs(way) < 1e-3 ? 1 : std::sin(way) / way;
  return amplitude * std::sin(ahead) - detent_ * mean * std::sin(4 * angle);
}

void ReducedMotor::check_rest(double before) {
  const double pull = torque_ - weight_;
  const bool is_stuck = speed_ == 0 && before == 0 && std::abs(pull) <= dry_ + resisting_;
  if (!is_stuck) {
    if (pull * pull > share_at_rest * amplitude_ * amplitude_) return;
    speed_ = 0;
    drift_ = 0;
  }
  rests_ = true;
  since_ = long_ago;
}

}  // namespace passo
