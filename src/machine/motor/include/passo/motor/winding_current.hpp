// WindingCurrent: the current of one winding that a transistor switches, over time, in closed form.
//
// While the transistor is on, the supply pushes the current through the winding and its series resistor:
//
//   i(t) = U/R·(1 − e^(−t·R/L)) from 0      U the supply less the transistor's drop, R winding and series resistor
//
// While it is off, the current flows on through the diode across the winding and falls with L/R of the winding alone.
// A chopper switches off at its limit, and on again when the current has fallen below a band: the current rises as fast
// as the supply can push it, and is then held.
//
// A stage for unipolar motors has four of these for each motor, F1 to F4. Not modelled: the voltage that the turning
// rotor induces, and the coupling of the two halves of a coil. So this is the current of a motor that turns slowly, and
// an upper bound at speed; RunningMotor has the whole motor.
#pragma once

#include <optional>

#include "passo/motor/motor_data.hpp"

namespace passo {

struct WindingCircuit {
  Volts supply = {};
  Volts drop = {};   // at the transistor that is on
  Volts diode = {};  // at the diode across the winding
  Ohms winding = {};
  Ohms series = {};  // 0: none
  Henries inductance = {};
  std::optional<Amperes> limit = {};  // of a chopper; none: the resistances alone limit the current
  double ripple = 0;  // chopper: the band below the limit, as a fraction of it; 0: the current is held without a ripple

  // The current that the supply would reach, and how fast: L/R of winding and series resistor.
  Amperes final() const;
  Seconds time_constant() const;
  // How long the current rises from 0 to `current`; nothing if it never gets there.
  std::optional<Seconds> rise_time(Amperes current) const;
};

// Checks that supply, resistance, inductance and limit are above 0, the rest is not below 0, and the ripple is 0 or
// from 0.001 to 0.9.
Status<MotorError> check(const WindingCircuit& circuit);

class WindingCurrent {
 public:
  // Off, without current. `circuit` must have passed its check.
  explicit WindingCurrent(const WindingCircuit& circuit) : circuit_(circuit) {}

  // Switches on with `share` of the full current, 0 … 1: of the chopper's limit, or of the voltage. 0: off.
  void switch_to(double share);
  void run(Seconds time);
  // The current that it has after a long time in the present state.
  void settle();

  Amperes now() const { return {current_}; }
  // Within a thousandth of `full` of what it will be. A chopper with a ripple never settles.
  bool is_settled(Amperes full) const;

 private:
  // The current tends to `end` with the time constant `tau`, and something switches at `stop`.
  struct Piece {
    double end = 0;
    double tau = 1;
    std::optional<double> stop = {};
  };

  double limit() const { return circuit_.limit->value * share_; }
  bool is_held() const;
  // Of a chopper with a ripple that reaches its limit: from the limit down the band, and up again.
  double ripple_period() const;
  Piece piece() const;

  WindingCircuit circuit_;
  double share_ = 0;
  double current_ = 0;
  bool pushes_ = false;
};

}  // namespace passo
