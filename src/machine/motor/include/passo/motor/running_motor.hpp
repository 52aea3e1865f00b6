// RunningMotor: a two-phase stepper motor in motion: the currents of both phases, the rotor and its load, integrated
// over time. The input is steps; the output is the rotor's true position, with lost steps if the rotor cannot follow.
//
// The model, in the usual notation (θ the rotor's angle, ω its speed, N rotor teeth, K the torque constant, J the
// inertia of rotor and load):
//
//   di_A/dt = (v_A − R·i_A − e_A)/L     e_A = −K·ω·sin(N·θ)      T = K·(i_B·cos(N·θ) − i_A·sin(N·θ)) − T_D·sin(4·N·θ)
//   di_B/dt = (v_B − R·i_B − e_B)/L     e_B =  K·ω·cos(N·θ)      J·dω/dt = T − b·ω − friction − weight,   dθ/dt = ω
//
// K = holding torque/(√2·rated current): the holding torque in a data sheet is measured with both phases on. Friction
// is dry: a rotor at rest stays at rest until the torque exceeds the friction.
//
//   chopper    sets the voltage so that the current is right at the end of the integration step, within the
//              supply. While a current falls, the decay allows a fraction of the supply against the current. The
//              ripple of the chopping itself is not modelled: its frequency is far above what a rotor can follow.
//   resistive  applies the supply, less the transistor's drop, to R with a series resistor. The current of a phase
//              that is switched off flows back into the supply until it is zero.
//
//   measured   a motor with only a measured pull-out curve: the currents follow the field immediately, with
//              the amplitude that the curve gives for the rotor's speed
//
// Not modelled: saturation, and the coupling of the two phases.
//
// Method: half a drift of the angle, currents by the trapezoidal rule with the back-EMF in the middle of the step, the
// kick of the torque with friction as an implicit impulse, half a drift. The error is of second order in the step. The
// step is 25 µs or less; docs/ramps/physics.md states the error. Without losses the drift and kick conserve the rotor's
// energy (they are symplectic), so the method neither amplifies nor damps an oscillation. Deterministic; cost: about 25
// ns per step.
//
// Sources: Simscape Electrical, Stepper Motor (the equations); P. Acarnley, Stepping Motors, chapters 3 to 5; J. J.
// Moreau, Numerical aspects of the sweeping process, 1999 (dry friction as an impulse).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/motor/excitation.hpp"
#include "passo/motor/motor_data.hpp"
#include "passo/motor/torque_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Everything that a motor's motion depends on, except the pulses.
struct MotorSetup {
  MotorData motor = {};
  MotorDrive drive = {};
  Excitation excitation;
  Load load = {};
  NewtonMetres weight = {};         // a constant torque towards the low end, as on a vertical axis; at the screw
  NewtonMetres detent = {};         // the maximum torque of the unpowered motor
  NewtonMetreSeconds damping = {};  // of the motor itself: iron losses and bearings
  // Measured pull-out torque. If set, the drive and the motor's electrical data are not used.
  std::optional<TorqueCurve> measured = {};
};

// Returns the setup of a motor with a measured curve.
MotorSetup measured_setup(const TorqueCurve& curve, const Excitation& excitation);

// Returns the pull-out curve of a motor: the measured one, or the one computed from its data and drive. The setup's
// parts must have passed their checks.
TorqueCurve pull_out_curve(const MotorSetup& setup);

// Returns the damping that gives the rotor's free oscillation this fraction of critical damping. The default is for a
// motor with unknown damping: at 1000 rpm the iron losses of a typical motor are one or two hundredths of its holding
// torque.
NewtonMetreSeconds damping_of(const MotorData& motor, double share_of_critical = 0.002);

class RunningMotor {
 public:
  // The motor starts at rest at position 0, with its currents on. The setup's parts must have passed their checks.
  explicit RunningMotor(const MotorSetup& setup);

  // Makes one driver step up or down, at the present time.
  void step(int way);
  // Lets time pass.
  void run(Seconds time);
  // Continues from another state of the rotor, with the currents that the driver sets at `commanded`. Lost steps stay
  // lost.
  void resume(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque);
  // Carries the rotor at about that speed, as if by hand, with a critically damped torque proportional to the speed
  // difference. So a simulation can start during motion, with the lag and the currents of that motion. The rotor starts
  // at that speed.
  void carry(RadiansPerSecond speed);
  void let_go();
  // Sets a torque against the motion, in either direction: a cutting force at the shaft.
  void set_resistance(NewtonMetres torque);

  // The rotor's position, in driver steps. A rotor at rest without load is at commanded().
  double place() const { return angle_ * places_per_radian_ - first_; }
  std::int64_t commanded() const { return commanded_; }
  int steps_per_full_step() const { return steps_; }
  // How far the commanded position is ahead of the rotor, in full steps. At low speed the torque has its maximum at one
  // full step, and at two the rotor loses steps. At high speed the currents lag too, and a synchronous rotor is further
  // behind.
  double lag() const { return (static_cast<double>(commanded_ - slipped()) - place()) / steps_; }
  // The number of lost driver steps (positive: the rotor is too low). A rotor loses four full steps at a time.
  std::int64_t slipped() const { return slips_ * 4 * steps_; }
  RadiansPerSecond speed() const { return {speed_}; }
  Amperes current_a() const { return {current_a_}; }
  Amperes current_b() const { return {current_b_}; }
  NewtonMetres torque() const { return {torque_}; }
  // The torque without its ripple: averaged over a few milliseconds.
  NewtonMetres mean_torque() const { return {mean_torque_}; }
  // Returns true if the rotor and its currents have settled. Until the next step, run() costs nothing.
  bool rests() const { return rests_; }

 private:
  // One integration step, and the resulting coefficients of the trapezoidal rule for R·i + L·di/dt = u:
  //   i' = (keep·i + push·u)
  struct StepSize {
    double h = 0;
    double keep = 0;
    double push = 0;
    double fade = 0;
    double kick = 0;
  };
  struct Shares {
    double a = 0;  // fraction of the rated current or of the supply
    double b = 0;
  };

  StepSize size_of(double time) const;
  void excite();
  void integrate(const StepSize& size);
  double driven_torque(const StepSize& size);
  double measured_torque() const;
  double next_current(double current, double share, double emf, const StepSize& size) const;
  void turn(double electrical);
  void check_slip(double allowed);
  void check_rest(const StepSize& size);

  // Properties of the motor and its drive.
  double teeth_;
  double constant_;    // K
  double resistance_;  // R, including the series resistor
  double inductance_;
  double rated_;
  double supply_;  // less the voltage drop
  double decay_;   // fraction of the supply against a falling current
  bool chops_;
  bool freewheels_;  // a fraction of 0 means: switched off
  double inertia_;
  double detent_;
  double viscous_;
  double dry_;
  double weight_;
  double resisting_ = 0;
  double hand_ = 0;  // damping while the rotor is carried by hand
  double hand_speed_ = 0;
  std::optional<TorqueCurve> measured_;
  int steps_;  // driver steps per full step
  double places_per_radian_;
  double first_;  // place() of the angle 0
  double longest_;
  std::vector<Shares> shares_;  // of the phases, for each step of an electrical revolution

  // The state.
  std::int64_t commanded_ = 0;
  std::int64_t slips_ = 0;
  double share_a_ = 0;
  double share_b_ = 0;
  double current_a_ = 0;
  double current_b_ = 0;
  double angle_ = 0;  // electrical: N·θ
  double sine_ = 0;
  double cosine_ = 1;
  double speed_ = 0;
  double gain_ = 0;  // factor on the speed in the last integration step; per second
  double torque_ = 0;
  double mean_torque_ = 0;
  int until_exact_ = 0;
  bool rests_ = true;
  // The last time that passed, and its steps: most times are equal to the previous one.
  double last_time_ = 0;
  StepSize last_size_;
  std::int64_t last_count_ = 0;
};

}  // namespace passo
