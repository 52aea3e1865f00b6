#include "passo/plant/encoder_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

constexpr double smoothing = 0.3;    // of speeds, a cycle
constexpr double held = 1.3;         // full steps: beyond, an open-loop rotor is about to fall out of step
constexpr double most_reach = 2.5;   // full steps, at speed
constexpr double arrived = 0.6;      // full steps
constexpr double near_enough = 1.8;  // for a rotor that rests: it is drawn to the place, as it is less than 2 away
constexpr Seconds rested{5e-3};
constexpr Seconds friction_takes{20e-3};  // until the lead is a full step
constexpr double catches_up = 800;        // full steps a second above the commanded speed
constexpr Seconds time_constant{4e-3};    // of the speed, in recovery
constexpr double share_to_brake = 0.25;   // of the strength, planned for arriving

}  // namespace

EncoderDrive::EncoderDrive(const EncoderModel& model, const MotorSetup& setup)
    : model_(model), full_step_(setup.excitation.steps_per_full_step()) {
  const double steps_per_radian = setup.motor.rotor.steps_per_revolution * full_step_ / (2 * std::numbers::pi);
  const double inertia = setup.motor.rotor.inertia.value + setup.load.inertia.value;
  strength_ = setup.motor.holding_torque.value / std::numbers::sqrt2 / inertia * steps_per_radian;
  const bool is_measured = setup.measured.has_value();
  delay_ = is_measured ? 0
                       : setup.motor.inductance.value * setup.motor.rated_current.value /
                             std::max(setup.drive.supply.value - setup.drive.drop.value, 1e-3);
}

double EncoderDrive::counted(const BoundedMotor& rotor) const {
  return (std::floor(rotor.place() * model_.counts_per_step) + 0.5) / model_.counts_per_step;
}

double EncoderDrive::reach() const {
  return full_step_ * std::min(held + std::abs(wanted_) / full_step_ * delay_, most_reach);
}

void EncoderDrive::pulse(BoundedMotor& rotor, std::int64_t steps) {
  if (steps == 0) return;
  commanded_ += steps;
  settled_ = false;
  if (!recovers_) set_field(rotor, commanded_);
}

void EncoderDrive::set_field(BoundedMotor& rotor, std::int64_t place) {
  for (; field_ != place; field_ += field_ < place ? 1 : -1) rotor.step(field_ < place ? 1 : -1);
}

void EncoderDrive::run(BoundedMotor& rotor, Seconds time) {
  while (time.value() > 0) {
    const Seconds piece = std::min(time, cycle - since_);
    rotor.run(piece);
    since_ += piece;
    time -= piece;
    if (since_ < cycle * (1 - 1e-9)) continue;
    since_ = Seconds(0);
    update(rotor);
    if (rests(rotor)) return;
  }
}

void EncoderDrive::update(BoundedMotor& rotor) {
  const double place = counted(rotor);
  const auto commanded = static_cast<double>(commanded_);
  speed_ += smoothing * ((place - last_counted_) / cycle.value() - speed_);
  wanted_ += smoothing * ((commanded - last_commanded_) / cycle.value() - wanted_);
  last_counted_ = place;
  last_commanded_ = commanded;
  error_ = commanded - place;
  settled_ = std::abs(wanted_) < full_step_ && std::abs(error_) < reach();
  if (model_.most_error > 0 && std::abs(error_) > model_.most_error) is_alarmed_ = true;
  if (!model_.closes_loop) return;
  if (!recovers_ && std::abs(error_) > reach()) recovers_ = true;
  if (recovers_) recover(rotor);
}

void EncoderDrive::recover(BoundedMotor& rotor) {
  const double most_more = std::min(std::sqrt(2 * share_to_brake * strength_ * std::abs(error_)),
                                    std::abs(error_) / (3 * time_constant.value()));
  const double more = std::min(most_more, catches_up * full_step_);
  const double aim = wanted_ + std::copysign(more, error_);
  double lead = std::clamp((aim - speed_) / (strength_ * time_constant.value()), -1.0, 1.0);
  const bool is_as_fast = std::abs(speed_ - wanted_) < 0.25 * strength_ * time_constant.value();
  // A rotor that friction stops on its last way.
  const bool is_slow = std::abs(speed_) < 10 * full_step_ && std::abs(wanted_) < 10 * full_step_;
  slow_ = is_slow ? slow_ + cycle : Seconds(0);
  const double allowed = slow_ > rested ? near_enough : arrived;
  if (std::abs(error_) < allowed * full_step_ && is_as_fast) {
    recovers_ = false;
    return set_field(rotor, commanded_);
  }
  // Friction that holds the rotor far from its place meets more and more lead.
  if (is_slow) {
    const double pushing = std::min(slow_ / friction_takes, 1.0);
    lead = std::copysign(std::max(std::abs(lead), pushing), error_);
  }
  // The currents are late, and the field stands still until the next look.
  const double ahead = speed_ * (delay_ + cycle.value() / 2);
  set_field(rotor, std::llround(last_counted_ + lead * full_step_ + ahead));
}

}  // namespace passo
