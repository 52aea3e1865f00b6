// MotorData and MotorDrive: the data sheet of a two-phase hybrid (or permanent-magnet) stepping motor, and the
// electronics that drive it.
//
// The electrical values of a sheet belong to a way of connecting the motor. A bipolar drive pushes current through the
// whole coil of each phase, in both directions. A unipolar drive has the coil tapped in its middle and uses one half
// for each direction, so that half of the copper is always idle. With four leads the sheet is for whole coils; with
// five or six it is nearly always for half coils. `as_wound` converts.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/result.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Volts {
  double value = 0;
  friend constexpr auto operator<=>(Volts, Volts) = default;
};
struct Amperes {
  double value = 0;
  friend constexpr auto operator<=>(Amperes, Amperes) = default;
};
struct Ohms {
  double value = 0;
  friend constexpr auto operator<=>(Ohms, Ohms) = default;
};
struct Henries {
  double value = 0;
  friend constexpr auto operator<=>(Henries, Henries) = default;
};

enum class Winding : std::uint8_t {
  whole_coil,  // bipolar
  half_coil,   // unipolar
};

enum class Regulation : std::uint8_t {
  chopper,    // holds the rated current by switching, as long as the supply can push it
  resistive,  // the supply feeds the coil through a resistor that lets the rated current flow at standstill (an L/R
              // drive)
};

struct Rotor {
  // Full steps. Two phases make four full steps for each rotor tooth, so this is a multiple of four.
  int steps_per_revolution = 200;
  KilogramMetres2 inertia = {};

  // Periods of the winding's current in one revolution.
  double teeth() const { return steps_per_revolution / 4.0; }
};

struct MotorData {
  Rotor rotor = {};
  NewtonMetres holding_torque = {};       // with both phases on at the rated current
  Amperes rated_current = {};             // of one phase, with both on
  Ohms resistance = {};                   // of one phase
  Henries inductance = {};                // of one phase
  Winding winding = Winding::whole_coil;  // the coils that the four values above were measured on
};

struct MotorDrive {
  Volts supply = {};
  Winding winding = Winding::whole_coil;
  Regulation regulation = Regulation::chopper;
  Volts drop = {};        // what the transistors take of the supply
  double fast_decay = 1;  // chopper: the share of the supply against a falling current; 0: slow decay
};

struct MotorError {
  std::string message;  // "the rotor's inertia must be above 0 kg·m², not -1"
};

// Checks that each value is finite and above zero, and the steps a multiple of four.
Status<MotorError> check(const Rotor& rotor);
Status<MotorError> check(const MotorData& data);
Status<MotorError> check(const MotorDrive& drive);

// The same motor with its values for `winding`, at the same heat in the copper. A half coil has half the turns: half
// the resistance and torque per ampere, and a quarter of the inductance. It takes √2 of the current and holds 1/√2 of
// the torque. (The resistance goes with the length of the wire, the inductance with the turns squared.)
MotorData as_wound(const MotorData& data, Winding winding);

}  // namespace passo
