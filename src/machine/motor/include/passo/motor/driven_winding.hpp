// DrivenWinding: the maximum torque of a two-phase motor at a steady speed, computed from the motor's data and drive.
//
// In the frame that rotates with the rotor, the currents of both phases form one vector. Its component i_q
// perpendicular to the magnet's flux produces the torque K·i_q. Its component i_d along the flux produces no torque; a
// negative i_d weakens the flux. At the speed ω the current has the angular frequency N·ω (N rotor teeth), and in the
// steady state
//
//   v_q = R·i_q + X·i_d + E      X = N·ω·L
//   v_d = R·i_d − X·i_q          E = K·ω, the back-EMF      K = holding torque / (√2·rated current)
//
// An open-loop motor lags behind the field by the angle that the load requires, so the load itself selects the best
// (i_d, i_q). Pull-out is the maximum. The limits of the drive are discs in the (i_d, i_q) plane:
//
//   chopper    |i| ≤ I (rated)  and  |v| ≤ V (supply): the highest common point of two discs
//   resistive  |v| = V, R including the series resistor: the highest point of one circle
//
// At rest both give K·I = holding torque/√2. The torque falls with the speed and rises with the supply.
//
// Currents and voltages are sines with the peaks I and V, as a driver with fine microsteps makes them. Not modelled:
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

  // Returns the pull-out torque at `speed` ≥ 0; 0 where the motor cannot follow at all.
  NewtonMetres pull_out(RadiansPerSecond speed) const;

  // The torque constant K of one phase, in N·m/A, which equals V·s.
  double torque_constant() const { return torque_constant_; }

 private:
  double best_current(double reactance, double back_emf) const;

  double teeth_;
  double torque_constant_;
  double current_;  // the current limit of the chopper
  double voltage_;
  double resistance_;  // including the series resistor
  double inductance_;
  bool limits_current_;
};

}  // namespace passo
