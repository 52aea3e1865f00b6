// RunningMotor: a two-phase stepping motor in motion: the currents of both phases, the rotor and what it turns,
// integrated over time. Steps go in; the rotor's true place comes out, with lost steps if the rotor cannot follow.
//
// The model, with the names and signs of the accepted one (θ the rotor's angle, ω its speed, N rotor teeth, K the
// torque constant, J the inertia of rotor and load):
//
//   di_A/dt = (v_A − R·i_A − e_A)/L     e_A = −K·ω·sin(N·θ)      T = K·(i_B·cos(N·θ) − i_A·sin(N·θ)) − T_D·sin(4·N·θ)
//   di_B/dt = (v_B − R·i_B − e_B)/L     e_B =  K·ω·cos(N·θ)      J·dω/dt = T − b·ω − friction − weight,   dθ/dt = ω
//
// K = holding torque/(√2·rated current): a sheet's holding torque is measured with both phases on. Friction is dry: a
// resting rotor keeps still until the torque is more than the friction.
//
//   chopper    gives the voltage at which the current is right at the end of the integration's step, as far as the
//              supply can. While a current falls, the decay allows a share of the supply against the current. The
//              ripple of the chopping itself is left out: its frequency is far above what a rotor can follow.
//   resistive  switches the supply, less the transistor's drop, to R with a series resistor. The current of a phase
//              that is switched off goes back into the supply until the current is zero.
//
//   measured   a motor of which only a pull-out curve is known: the currents are at once where the field points, and as
//              strong as that curve says for the rotor's speed
//
// Left out: saturation, and the coupling of the two phases.
//
// Method: half a drift of the angle, currents by the trapezoidal rule with the back-EMF in the middle of the step, the
// kick of the torque with friction as an implicit impulse, half a drift. The error is of second order in the step. The
// step is 25 µs or less; docs/ramps/physics.md states the error. Without losses the drift and kick keep the rotor's
// energy (they are symplectic), so a ringing neither grows nor fades by the method. Deterministic; cost: about 25 ns a
// step.
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

// All that a motor's motion depends on, beside the pulses.
struct MotorSetup {
  MotorData motor = {};
  MotorDrive drive = {};
  Excitation excitation;
  Load load = {};
  NewtonMetres weight = {};         // a torque that always pulls down, as a vertical axis does; from the screw's side
  NewtonMetres detent = {};         // the greatest torque of the unpowered motor
  NewtonMetreSeconds damping = {};  // of the motor itself: iron losses and its bearings
  // Pull-out torque as measured. Then the drive and the motor's electrical data do not count.
  std::optional<TorqueCurve> measured = {};
};

// The setup of a motor that is known by its measured curve.
MotorSetup measured_setup(const TorqueCurve& curve, const Excitation& excitation);

// The pull-out of a motor: the measured curve, or the one that its data and drive give. The setup's parts have passed
// their checks.
TorqueCurve pull_out_curve(const MotorSetup& setup);

// The damping by which the ringing of the rotor alone fades by that share of critical damping. The default is for a
// motor whose own damping is not known: the iron losses of a usual motor at 1000 revolutions a minute are one or two
// hundredths of its holding torque.
NewtonMetreSeconds damping_of(const MotorData& motor, double share_of_critical = 0.002);

class RunningMotor {
 public:
  // The motor rests at place 0, with its currents on. The setup's parts have passed their checks.
  explicit RunningMotor(const MotorSetup& setup);

  // One step of the driver up or down, at the present time.
  void step(int way);
  // Lets time pass.
  void run(Seconds time);
  // Goes on from another state of the rotor, with the currents that the driver wants at `commanded`. The steps that
  // were lost stay lost.
  void resume(std::int64_t commanded, double place, RadiansPerSecond speed, NewtonMetres mean_torque);
  // A hand carries the rotor at about that speed: it pulls as much as the rotor's speed differs, with critical damping.
  // So a rotor begins in mid-motion, with the lag and the currents of that motion. The rotor starts at that speed.
  void carry(RadiansPerSecond speed);
  void let_go();
  // A torque of the work against the motion, whichever way it goes: a cutting force at the shaft.
  void set_resistance(NewtonMetres torque);

  // Where the rotor is, in steps of the driver. A resting rotor without load stands at commanded().
  double place() const { return angle_ * places_per_radian_ - first_; }
  std::int64_t commanded() const { return commanded_; }
  int steps_per_full_step() const { return steps_; }
  // How far the commanded place is ahead of the rotor, in full steps. At low speed the torque is greatest at one full
  // step, and at two the rotor falls back. At high speed the currents lag too, and a rotor in step is further behind.
  double lag() const { return (static_cast<double>(commanded_ - slipped()) - place()) / steps_; }
  // Steps of the driver that were lost (positive: the rotor stands too low). A rotor loses four full steps at a time.
  std::int64_t slipped() const { return slips_ * 4 * steps_; }
  RadiansPerSecond speed() const { return {speed_}; }
  Amperes current_a() const { return {current_a_}; }
  Amperes current_b() const { return {current_b_}; }
  NewtonMetres torque() const { return {torque_}; }
  // The torque without its ripple: averaged over some milliseconds.
  NewtonMetres mean_torque() const { return {mean_torque_}; }
  // The rotor and its currents have come to rest. Until the next step time costs nothing.
  bool rests() const { return rests_; }

 private:
  // One step of the integration, and what the trapezoidal rule for R·i + L·di/dt = u makes of it:
  //   i' = (keep·i + push·u)
  struct StepSize {
    double h = 0;
    double keep = 0;
    double push = 0;
    double fade = 0;
    double kick = 0;
  };
  struct Shares {
    double a = 0;  // of the rated current or of the supply
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

  // Of the motor and its drive.
  double teeth_;
  double constant_;    // K
  double resistance_;  // R, with the series resistor
  double inductance_;
  double rated_;
  double supply_;  // less the drop
  double decay_;   // share of the supply against a falling current
  bool chops_;
  bool freewheels_;  // a share of 0 means: switched off
  double inertia_;
  double detent_;
  double viscous_;
  double dry_;
  double weight_;
  double resisting_ = 0;
  double hand_ = 0;  // damping of the hand that carries the rotor
  double hand_speed_ = 0;
  std::optional<TorqueCurve> measured_;
  int steps_;  // of the driver to a full step
  double places_per_radian_;
  double first_;  // place() of the angle 0
  double longest_;
  std::vector<Shares> shares_;  // of the phases, for each place of an electrical turn

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
  double gain_ = 0;  // of the speed, in the last step of the integration; per second
  double torque_ = 0;
  double mean_torque_ = 0;
  int until_exact_ = 0;
  bool rests_ = true;
  // The last time that passed, and its steps: most times are as long as the one before.
  double last_time_ = 0;
  StepSize last_size_;
  std::int64_t last_count_ = 0;
};

}  // namespace passo
