#include "passo/motor/running_motor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

constexpr double longest_step = 25e-6;
constexpr double radians_of_ringing = 0.05;  // the most of a ringing's angle in one step
constexpr double part_of_time_constant = 0.05;
constexpr int steps_between_looks = 64;
constexpr int steps_between_exact_angles = 256;
constexpr double most_turn = 0.5;   // electrical radians in half a step
constexpr double averaging = 3e-3;  // seconds
constexpr double in_motion = 3;     // full steps from the field to a rotor that is in step
constexpr double at_rest_in_step = 2;
constexpr double at_rest = 1e-9;  // of the energy that holds a rotor, and of the rated current

}  // namespace

NewtonMetreSeconds damping_of(const MotorData& motor, double share_of_critical) {
  const double stiffness = motor.rotor.teeth() * motor.holding_torque.value;
  return {2 * share_of_critical * std::sqrt(stiffness * motor.rotor.inertia.value)};
}

MotorSetup measured_setup(const TorqueCurve& curve, const Excitation& excitation) {
  MotorSetup setup{.motor = {.rotor = curve.rotor(),
                             .holding_torque = curve.pull_out({0}),
                             .rated_current = {1},
                             .resistance = {1},
                             .inductance = {1e-3}},
                   .drive = {.supply = {1}},
                   .excitation = excitation};
  setup.measured = curve;
  setup.damping = damping_of(setup.motor);
  return setup;
}

TorqueCurve pull_out_curve(const MotorSetup& setup) {
  if (setup.measured) return *setup.measured;
  return *TorqueCurve::from_motor(setup.motor, setup.drive);
}

RunningMotor::StepSize RunningMotor::size_of(double time) const {
  const double half = resistance_ * time / (2 * inductance_);
  return {.h = time,
          .keep = (1 - half) / (1 + half),
          .push = time / inductance_ / (1 + half),
          .fade = (viscous_ + hand_) * time / (2 * inertia_),
          .kick = time / inertia_};
}

RunningMotor::RunningMotor(const MotorSetup& setup)
    : teeth_(setup.motor.rotor.teeth()),
      supply_(std::max(setup.drive.supply.value - setup.drive.drop.value, 0.0)),
      decay_(setup.drive.fast_decay),
      chops_(setup.drive.regulation == Regulation::chopper),
      freewheels_(!chops_ && !setup.excitation.is_sine()),
      inertia_(setup.motor.rotor.inertia.value + setup.load.inertia.value),
      detent_(setup.detent.value),
      viscous_(setup.damping.value + setup.load.friction_per_speed.value),
      dry_(setup.load.friction.value),
      weight_(setup.weight.value),
      measured_(setup.measured),
      steps_(setup.excitation.steps_per_full_step()),
      places_per_radian_(2 * steps_ / std::numbers::pi) {
  const MotorData winding = as_wound(setup.motor, setup.drive.winding);
  rated_ = winding.rated_current.value;
  inductance_ = winding.inductance.value;
  constant_ = winding.holding_torque.value / (std::numbers::sqrt2 * rated_);
  resistance_ = winding.resistance.value;
  if (!chops_) resistance_ = std::max(resistance_, supply_ / rated_);
  const double ringing = std::sqrt(teeth_ * winding.holding_torque.value / inertia_);
  longest_ = std::min({longest_step, radians_of_ringing / ringing, part_of_time_constant * inductance_ / resistance_});

  for (int place = 0; place < 4 * steps_; ++place) {
    const WindingState state = setup.excitation.at(place);
    shares_.push_back({.a = state.phase_a, .b = state.phase_b});
  }
  excite();
  const double full = chops_ ? rated_ : supply_ / resistance_;
  current_a_ = share_a_ * full;
  current_b_ = share_b_ * full;
  angle_ = std::atan2(share_b_, share_a_);
  first_ = angle_ * places_per_radian_;
  sine_ = std::sin(angle_);
  cosine_ = std::cos(angle_);
  rests_ = weight_ == 0 && detent_ == 0;
}

void RunningMotor::step(int way) {
  commanded_ += way;
  excite();
  check_slip(in_motion);
  rests_ = false;
}

void RunningMotor::excite() {
  const auto turn = static_cast<std::int64_t>(shares_.size());
  const Shares& shares = shares_[static_cast<std::size_t>((commanded_ % turn + turn) % turn)];
  share_a_ = shares.a;
  share_b_ = shares.b;
}

void RunningMotor::resume(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque) {
  commanded_ = commanded;
  excite();
  const double full = chops_ ? rated_ : supply_ / resistance_;
  current_a_ = share_a_ * full;
  current_b_ = share_b_ * full;
  angle_ = (place + first_) / places_per_radian_;
  until_exact_ = 0;
  speed_ = speed.value;
  gain_ = 0;
  mean_torque_ = mean_torque.value;
  rests_ = false;
}

void RunningMotor::carry(RadiansPerSecond speed) {
  if (hand_ == 0) {
    hand_ = 2 * std::sqrt(teeth_ * constant_ * rated_ * inertia_);
    speed_ = speed.value;
    gain_ = 0;
    last_time_ = 0;  // the hand's damping counts from now on
  }
  hand_speed_ = speed.value;
  rests_ = false;
}

void RunningMotor::let_go() {
  hand_ = hand_speed_ = 0;
  last_time_ = 0;
}

void RunningMotor::set_resistance(NewtonMetres torque) {
  resisting_ = torque.value;
  rests_ = false;
}

void RunningMotor::run(Seconds time) {
  if (rests_ || time.value() <= 0) return;
  if (time.value() != last_time_) {
    last_time_ = time.value();
    const double count = std::ceil(time.value() / longest_);
    last_size_ = size_of(time.value() / count);
    last_count_ = static_cast<std::int64_t>(count);
  }
  const StepSize& size = last_size_;
  for (std::int64_t i = 1; i <= last_count_; ++i) {
    integrate(size);
    if (i % steps_between_looks != 0) continue;
    check_slip(in_motion);
    check_rest(size);
    if (rests_) return;
  }
  check_slip(in_motion);
}

void RunningMotor::integrate(const StepSize& size) {
  const double electrical = teeth_ * size.h / 2;
  turn(electrical * speed_);

  const double made = measured_ ? measured_torque() : driven_torque(size);
  torque_ = made - detent_ * 4 * sine_ * cosine_ * (cosine_ * cosine_ - sine_ * sine_);
  mean_torque_ += (torque_ - mean_torque_) * std::min(size.h / averaging, 1.0);

  const double pull = torque_ - weight_ + hand_ * hand_speed_;
  const double free = (speed_ * (1 - size.fade) + pull * size.kick) / (1 + size.fade);
  const double dry = (dry_ + resisting_) * size.kick;
  // A rotor that runs away, as under a weight that the motor does not hold, gets no faster than the integration can
  // see.
  const double fastest = 2 * most_turn / (teeth_ * size.h);
  const double speed = std::copysign(std::clamp(std::abs(free) - dry, 0.0, fastest), free);
  gain_ = (speed - speed_) / size.h;
  speed_ = speed;
  turn(electrical * speed_);
}

double RunningMotor::driven_torque(const StepSize& size) {
  // The speed in the middle of the step, as far as the last step tells.
  const double emf = constant_ * (speed_ + gain_ * size.h / 2);
  const double a = next_current(current_a_, share_a_, -emf * sine_, size);
  const double b = next_current(current_b_, share_b_, emf * cosine_, size);
  const double made = constant_ / 2 * ((current_b_ + b) * cosine_ - (current_a_ + a) * sine_);
  current_a_ = a;
  current_b_ = b;
  return made;
}

double RunningMotor::measured_torque() const {
  const double across = share_b_ * cosine_ - share_a_ * sine_;
  return measured_->pull_out({std::abs(speed_)}).value * across / std::hypot(share_a_, share_b_);
}

// The current of a phase after a step. `share`: of the rated current or of the supply.
double RunningMotor::next_current(double current, double share, double emf, const StepSize& size) const {
  if (chops_) {
    const double wanted = share * rated_;
    const bool falls = current * wanted >= 0 && std::abs(current) > std::abs(wanted);
    const double against = falls ? decay_ * supply_ : supply_;
    const double low = current > 0 ? -against : -supply_;
    const double high = current < 0 ? against : supply_;
    const double voltage = (wanted - size.keep * current) / size.push + emf;
    return size.keep * current + size.push * (std::clamp(voltage, low, high) - emf);
  }
  if (freewheels_ && share == 0) {
    if (current == 0) return 0;
    const double next = size.keep * current - size.push * (std::copysign(supply_, current) + emf);
    return next * current > 0 ? next : 0;
  }
  return size.keep * current + size.push * (share * supply_ - emf);
}

// Turns the rotor by a small electrical angle. The pair of sine and cosine is turned with it, and made exact at times.
void RunningMotor::turn(double electrical) {
  angle_ += electrical;
  if (--until_exact_ <= 0) {
    until_exact_ = steps_between_exact_angles;
    sine_ = std::sin(angle_);
    cosine_ = std::cos(angle_);
    return;
  }
  const double square = electrical * electrical;
  const double s = electrical * (1 - square / 6 * (1 - square / 20));
  const double c = 1 - square / 2 * (1 - square / 12 * (1 - square / 30));
  const double sine = sine_ * c + cosine_ * s;
  cosine_ = cosine_ * c - sine_ * s;
  sine_ = sine;
}

// At rest a rotor that is more than two full steps away from the field is drawn to another place. At speed the currents
// lag too, so that a rotor in step may be that far away; three full steps are more than a rotor in step can be.
void RunningMotor::check_slip(double allowed) {
  const double periods = (static_cast<double>(commanded_) - place()) / (4 * steps_);
  if (std::abs(periods - static_cast<double>(slips_)) <= allowed / 4) return;
  slips_ = std::llround(periods);
}

void RunningMotor::check_rest(const StepSize& size) {
  const double holds = constant_ * rated_ / teeth_;  // energy
  const double pull = torque_ - weight_;
  const bool is_stuck = speed_ == 0 && std::abs(pull) <= dry_ + resisting_;
  const double energy = inertia_ * speed_ * speed_ / 2 + pull * pull / (2 * teeth_ * constant_ * rated_);
  if (!is_stuck && energy > at_rest * holds) return;
  const auto steady = [&](double current, double share, double emf) {
    return std::abs(next_current(current, share, emf, size) - current) <= at_rest * rated_;
  };
  const double emf = constant_ * speed_;
  const bool currents_move =
      !measured_ && !(steady(current_a_, share_a_, -emf * sine_) && steady(current_b_, share_b_, emf * cosine_));
  if (currents_move) return;
  speed_ = 0;
  gain_ = 0;
  rests_ = true;
  check_slip(at_rest_in_step);
}

}  // namespace passo
