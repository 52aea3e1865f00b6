// DrivenWinding: the greatest torque of a two-phase motor at a steady speed, computed from the motor's data and drive.
//
// In the frame that turns with the rotor, the currents of both phases together are one vector. Its part i_q across the
// magnet's flux makes the torque K·i_q. Its part i_d along the flux makes no torque; a negative i_d weakens the flux.
// At the speed ω the current has N·ω radians a second (N rotor teeth), and in the steady state
//
//   v_q = R·i_q + X·i_d + E      X = N·ω·L
//   v_d = R·i_d − X·i_q          E = K·ω, the back-EMF      K = holding torque / (√2·rated current)
//
// An open-loop motor lags behind the field by as much as the load asks for, so the load itself finds the best (i_d,
// i_q). At pull-out there is no better one. The limits of the drive are discs in the plane of the currents:
//
//   chopper    |i| ≤ I (rated)  and  |v| ≤ V (supply): the highest point that two discs share
//   resistive  |v| = V, R including the series resistor: the highest point of one circle
//
// At rest both give K·I = holding torque/√2. The torque falls with the speed and rises with the supply.
//
// Currents and voltages are sines with the peaks I and V, as a driver with fine microsteps makes them. Left out:
// resonance, iron losses, detent, saturation; see docs/ramps/torque.md. The result is for a steady state: after a
// change of speed the currents need a few L/R to follow.
//
// Source: for the resistive drive P. Acarnley, Stepping Motors, on pull-out torque of the hybrid motor. For both limits
// at once, the current and voltage circles of synchronous motors (e.g. Morimoto and others, 1990).
#pragma once

#include "passo/motor/motor_data.hpp"

namespace passo {

class DrivenWinding {
 public:
  // `data` and `drive` must have passed their checks.
  DrivenWinding(const MotorData& data, const MotorDrive& drive);

  // The pull-out torque at `speed` ≥ 0. 0 where the motor cannot follow at all.
  NewtonMetres pull_out(RadiansPerSecond speed) const;

  // The torque constant K of one phase: N·m an ampere, which is also V·s.
  double torque_constant() const { return torque_constant_; }

 private:
  double best_current(double reactance, double back_emf) const;

  double teeth_;
  double torque_constant_;
  double current_;  // the limit of the chopper
  double voltage_;
  double resistance_;  // with the series resistor
  double inductance_;
  bool limits_current_;
};

}  // namespace passo
