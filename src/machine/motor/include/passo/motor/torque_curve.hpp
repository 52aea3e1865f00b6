// TorqueCurve: the torque of a stepper motor at each speed, from the points of a data sheet or from motor and drive.
//
//   torque                        Pull-out: the maximum torque of a running motor. It falls with the speed.
//    |------.   pull-out          Pull-in: the maximum friction at which the motor starts and stops at that rate
//    |...    `--.                 without a ramp. More inertia lowers it. Below it is the start/stop region.
//    |   `.      `--.             Pull-out torque above the friction is available for acceleration.
//    |_____`._______ `---  speed
//
// Pull-in from pull-out. At the first pulse the field turns at ω and the rotor is at rest. Relative to the field, the
// rotor is a pendulum that moves back at ω. It synchronises if its energy does not carry it over the top, half a period
// of the torque behind. With T = pull-out at ω, N rotor teeth, friction F and the inertia J of rotor and load that
// means
//
//   ½·J·ω² ≤ (2·T/N)·(sin β − β·cos β)        cos β = F/T
//
// (the equal-area criterion of synchronous machines, from the lag at which friction is overcome). Where T is flat this
// is ω_s = ω_s0/√(1 + J_load/J_rotor), the rule of the data sheets. Pull-in points hold for the rotor alone; the same
// rule converts them for a load. This is an estimate, so use only a fraction of it: it ignores damping, current lag,
// resonance and the jerk of the first full steps. docs/ramps/torque.md gives its accuracy.
//
// Invariant: pull-out never rises, and pull-in is never above it. Speeds are ≥ 0. Rates are in full steps/s.
//
// Sources: T. Kenjo, Stepping Motors and their Microprocessor Controls, on starting characteristics. For the equal-area
// criterion any textbook of power systems.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "passo/motor/driven_winding.hpp"
#include "passo/motor/monotone_curve.hpp"

namespace passo {

struct TorquePoint {
  Hertz rate;  // full steps/s
  NewtonMetres torque;
};

// Viscous friction, in N·m per radian/s.
struct NewtonMetreSeconds {
  double value = 0;
  friend constexpr auto operator<=>(NewtonMetreSeconds, NewtonMetreSeconds) = default;
};

// The load of the motor, reflected to its shaft, coupled without backlash.
struct Load {
  KilogramMetres2 inertia = {};
  NewtonMetres friction = {};                  // independent of the speed
  NewtonMetreSeconds friction_per_speed = {};  // added to `friction`

  NewtonMetres friction_at(RadiansPerSecond speed) const {
    return {friction.value + friction_per_speed.value * speed.value};
  }
};

// Checks that no value is negative or infinite.
Status<MotorError> check(const Load& load);

class TorqueCurve {
 public:
  // Creates a pull-out curve through the points: rates ascending, torques never rising and not all 0. Below the first
  // point the curve keeps the first torque. Beyond the last point nothing was measured, so the torque is 0. Pull-in is
  // computed, unless pull-in points are given; the same rules hold for them, and they must not lie above pull-out.
  static Result<TorqueCurve, MotorError> from_points(const Rotor& rotor, const std::vector<TorquePoint>& pull_out,
                                                     const std::vector<TorquePoint>& pull_in = {});
  static Result<TorqueCurve, MotorError> from_motor(const MotorData& data, const MotorDrive& drive);

  // Returns the curve with all torques multiplied, for a stronger or weaker motor of the same kind. `factor` > 0.
  TorqueCurve scaled(double factor) const;

  const Rotor& rotor() const { return rotor_; }
  RadiansPerSecond speed_at(Hertz rate) const;
  Hertz rate_at(RadiansPerSecond speed) const;

  NewtonMetres pull_out(RadiansPerSecond speed) const;
  // Returns the maximum friction at which a load of that inertia starts at that speed.
  NewtonMetres pull_in(RadiansPerSecond speed, KilogramMetres2 load_inertia) const;

  // Returns the highest speed at which the load starts and stops without a ramp; 0 if the motor cannot move the load.
  RadiansPerSecond maximum_starting_speed(const Load& load) const;
  // Returns the highest speed at which pull-out exceeds the friction; 0 if it never does. Empty if the model has no
  // limit: without friction, a winding whose own current can cancel its flux keeps a decreasing torque at any speed.
  std::optional<RadiansPerSecond> fastest_speed(const Load& load) const;
  // Returns margin · (pull-out − friction) / (rotor's + load's inertia), never negative. `margin`, 0…1, is the fraction
  // of the torque to use. The remainder is a margin for effects outside the model.
  RadiansPerSecond2 available_acceleration(RadiansPerSecond speed, const Load& load, double margin = 1) const;

 private:
  TorqueCurve(const Rotor& rotor, std::variant<DrivenWinding, MonotoneCurve> pull_out)
      : rotor_(rotor), pull_out_(std::move(pull_out)) {}

  double computed_pull_in(double speed, double inertia) const;

  Rotor rotor_;
  std::variant<DrivenWinding, MonotoneCurve> pull_out_;
  std::optional<MonotoneCurve> pull_in_;  // for the rotor without a load
  double factor_ = 1;                     // on all torques
};

// Returns the rate at which tables and plots end: slightly above the lower of two rates, the highest rate of the load,
// and the rate above which less than a twentieth of the torque is left.
Hertz natural_end(const TorqueCurve& curve, const Load& load);

}  // namespace passo
