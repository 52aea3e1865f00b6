// TorqueCurve: what a stepping motor can do at each speed, from the points of a data sheet or from motor and drive.
//
//   torque                        Pull-out: the most torque of a motor that runs. It falls with the speed.
//    |------.   pull-out          Pull-in: the most friction against which it starts and stops at that rate at once,
//    |...    `--.                 without a ramp; less with more inertia. Below it is the start/stop region.
//    |   `.      `--.             What pull-out has above the friction is left to accelerate with.
//    |_____`._______ `---  speed
//
// Pull-in from pull-out. At the first pulse the field turns at ω and the rotor rests. Seen from the field the rotor
// moves back at ω, and it is a pendulum: it is caught if its energy does not carry it over the top, half a period of
// the torque behind. With T = pull-out at ω, N rotor teeth, friction F and the inertia J of rotor and load
//
//   ½·J·ω² ≤ (2·T/N)·(sin β − β·cos β)        cos β = F/T
//
// (the equal-area criterion of synchronous machines, from the lag at which the rotor breaks loose). Where T is flat
// that is ω_s = ω_s0/√(1 + J_load/J_rotor), the rule of the data sheets, and by this rule pull-in points, which
// hold for the rotor alone, are carried over to a load. It is an estimate: damping, currents that lag, resonance and
// the jerk of whole first steps are left out, so take no more than part of it. docs/ramps/torque.md says how far it is
// right.
//
// Invariant: pull-out never rises, and pull-in is never above it. Speeds are ≥ 0. Rates are full steps a second.
//
// Sources: T. Kenjo, Stepping Motors and their Microprocessor Controls, on starting characteristics; any textbook of
// power systems on the equal-area criterion.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "passo/motor/driven_winding.hpp"
#include "passo/motor/monotone_curve.hpp"

namespace passo {

struct TorquePoint {
  Hertz rate;  // full steps a second
  NewtonMetres torque;
};

// Of friction that grows with the speed: N·m a radian per second.
struct NewtonMetreSeconds {
  double value = 0;
  friend constexpr auto operator<=>(NewtonMetreSeconds, NewtonMetreSeconds) = default;
};

// What the motor turns, as felt at its shaft and coupled without play.
struct Load {
  KilogramMetres2 inertia = {};
  NewtonMetres friction = {};                  // at any speed
  NewtonMetreSeconds friction_per_speed = {};  // on top of it

  NewtonMetres friction_at(RadiansPerSecond speed) const {
    return {friction.value + friction_per_speed.value * speed.value};
  }
};

// Nothing in it is negative or infinite.
Status<MotorError> check(const Load& load);

class TorqueCurve {
 public:
  // Pull-out through the points: rates ascending, torques never rising and not all 0. Below the first point it keeps
  // the first torque; beyond the last one nothing was measured and nothing is promised: 0. Without pull-in points,
  // pull-in is computed; with them, the same rules hold, and they may not lie above pull-out.
  static Result<TorqueCurve, MotorError> from_points(const Rotor& rotor, const std::vector<TorquePoint>& pull_out,
                                                     const std::vector<TorquePoint>& pull_in = {});
  static Result<TorqueCurve, MotorError> from_motor(const MotorData& data, const MotorDrive& drive);

  const Rotor& rotor() const { return rotor_; }
  RadiansPerSecond speed_at(Hertz rate) const;
  Hertz rate_at(RadiansPerSecond speed) const;

  NewtonMetres pull_out(RadiansPerSecond speed) const;
  // The most friction with which a load of that inertia starts at that speed.
  NewtonMetres pull_in(RadiansPerSecond speed, KilogramMetres2 load_inertia) const;

  // Up to here the load starts and stops without a ramp; 0 where the motor cannot even move it.
  RadiansPerSecond maximum_starting_speed(const Load& load) const;
  // Up to here pull-out is above the friction; 0 where it never is. Nothing where the model knows no end: without
  // friction, a winding whose flux its own current can cancel goes on for ever, with ever less torque.
  std::optional<RadiansPerSecond> fastest_speed(const Load& load) const;
  // margin · (pull-out − friction) / (rotor's + load's inertia), never negative. `margin` 0…1 is what of the torque to
  // spend; the rest is kept for what the model does not know.
  RadiansPerSecond2 available_acceleration(RadiansPerSecond speed, const Load& load, double margin = 1) const;

 private:
  TorqueCurve(const Rotor& rotor, std::variant<DrivenWinding, MonotoneCurve> pull_out)
      : rotor_(rotor), pull_out_(std::move(pull_out)) {}

  double computed_pull_in(double speed, double inertia) const;

  Rotor rotor_;
  std::variant<DrivenWinding, MonotoneCurve> pull_out_;
  std::optional<MonotoneCurve> pull_in_;  // of the rotor alone
};

}  // namespace passo
