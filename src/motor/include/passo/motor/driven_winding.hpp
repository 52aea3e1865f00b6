// DrivenWinding: the most torque that a two-phase motor gives at a steady speed, from its data and its drive.
//
// In the frame that turns with the rotor, the currents of both phases together are one vector: i_q across the magnet's
// flux, which makes the torque K·i_q, and i_d along it, which makes none but weakens the flux where it is negative. At
// N·ω radians of current a second (N rotor teeth) and in the steady state
//
//   v_q = R·i_q + X·i_d + E      X = N·ω·L
//   v_d = R·i_d − X·i_q          E = K·ω, the back-EMF      K = holding torque / (√2·rated current)
//
// An open-loop motor lags behind the field by as much as the load asks for, so that the load itself finds the best
// (i_d, i_q); pull-out is where there is no better one. What the drive allows are discs in the plane of the currents:
//
//   chopper    |i| ≤ I (rated)  and  |v| ≤ V (supply): the highest point of what two discs share
//   resistive  |v| = V with the series resistor counted to R: the highest point of one circle
//
// At rest both give K·I = holding torque/√2. The torque falls with the speed, and rises with the supply.
//
// Currents and voltages are sines with the peak I and V, as a driver makes them that divides the step finely. Limits:
// no resonance, no iron losses, no detent, no saturation; see docs/ramps/torque.md. A steady state: the currents need
// a few L/R to follow a change of speed.
//
// Source: for the resistive drive P. Acarnley, Stepping Motors, on pull-out torque of the hybrid motor; for both limits
// at once the current and voltage circles of synchronous motors (e.g. Morimoto and others, 1990).
#pragma once

#include "passo/motor/motor_data.hpp"

namespace passo {

class DrivenWinding {
 public:
  // `data` and `drive` have passed their checks.
  DrivenWinding(const MotorData& data, const MotorDrive& drive);

  // At `speed` ≥ 0; 0 where the motor cannot follow at all.
  NewtonMetres pull_out(RadiansPerSecond speed) const;

  // Of a phase: N·m an ampere, and as well V·s.
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
