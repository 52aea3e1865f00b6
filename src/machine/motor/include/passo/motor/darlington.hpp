// Darlington: the transistor that switches a winding of the first board, its base resistor and its heat.
//
// A Darlington in saturation is a switch. Its base needs at least the collector's current divided by the gain; a
// reserve of 20 to 30 % makes sure that it saturates. The resistor from the logic's output to the base sets that
// current:
//
//   I_B = (U_logic − U_BE)/R_B ≥ (1 + reserve)·I_C/gain
//
// A smaller resistor drives the base harder than necessary. That costs little: milliamperes of the logic's output, not
// of the motor.
#pragma once

#include "passo/motor/motor_data.hpp"

namespace passo {

struct Watts {
  double value = 0;
  friend constexpr auto operator<=>(Watts, Watts) = default;
};

// The defaults are those of a BDX53C at 1 A.
struct Darlington {
  double gain = 750;            // at least, by the data sheet
  Volts base_emitter = {1.4};   // two junctions
  Volts saturation = {1.0};     // collector to emitter; typical at 1 A
  double kelvin_per_watt = 62;  // junction to air of a TO-220 without a heat sink
};

struct BaseResistor {
  Amperes needed = {};   // I_C/gain
  Amperes wanted = {};   // with the reserve
  Ohms largest = {};     // the resistor that gives just that
  Amperes given = {};    // what the chosen resistor gives
  double overdrive = 0;  // given/needed
  Watts heat = {};       // of the transistor while it is on: U_CE·I_C
  double warmer = 0;     // K above the air, if it is on half of the time, as in two-phase-on drive
};

// `reserve`: 0.3 for 30 %. The logic's voltage must be above the transistor's base_emitter, and all else above 0.
BaseResistor base_resistor_of(const Darlington& transistor, Amperes collector, Volts logic, double reserve,
                              Ohms chosen);

}  // namespace passo
