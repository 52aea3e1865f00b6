#include "passo/motor/bounded_motor.hpp"

#include <cmath>
#include <numbers>

namespace passo {
namespace {

// To take over, the bound holds with something to spare, for a whole period of the ringing.
constexpr double calm_load_angle = 0.6;
constexpr double calm_interval = 1.2;

}  // namespace

BoundedMotor::BoundedMotor(const MotorSetup& setup, Integration integration) : full_(setup) {
  if (integration == Integration::always || !ReducedMotor::suits(setup)) return;
  reduced_.emplace(setup);
  reduced_->begin(0, 0, {0}, {0});
  is_reduced_ = true;
}

void BoundedMotor::step_in_full(int way) {
  if (is_reduced_) leave();
  full_.step(way);
  interval_ = since_;
  since_ = 0;
}

void BoundedMotor::run_in_full(Seconds time) {
  full_.run(time);
  since_ += time.value();
  if (!reduced_) return;
  calm_ = is_calm() ? calm_ + time.value() : 0;
  if (calm_ < reduced_->ringing_period().value() || since_ < interval_needed()) return;
  reduced_->begin(full_.commanded() - full_.slipped(), full_.place(), full_.speed(), full_.mean_torque());
  is_reduced_ = true;
}

double BoundedMotor::interval_needed() const {
  return calm_interval * reduced_->needed_time(full_.speed());
}

bool BoundedMotor::is_calm() const {
  const double load_angle = full_.lag() * std::numbers::pi / 2;
  return interval_ >= interval_needed() && std::abs(load_angle) <= calm_load_angle;
}

void BoundedMotor::leave() {
  reduced_->end_block();
  full_.resume(reduced_->commanded() + full_.slipped(), reduced_->place(), reduced_->speed(), reduced_->mean_torque());
  is_reduced_ = false;
  calm_ = 0;
  since_ = 0;
  interval_ = 0;
  full_.run(reduced_->left());
}

void BoundedMotor::set_resistance(NewtonMetres torque) {
  full_.set_resistance(torque);
  if (reduced_) reduced_->set_resistance(torque);
}

void BoundedMotor::carry(RadiansPerSecond speed) {
  if (is_reduced_) leave();
  full_.carry(speed);
  calm_ = 0;
}

void BoundedMotor::let_go() {
  full_.let_go();
  calm_ = 0;
}

}  // namespace passo
