// MotorData and MotorDrive: the data sheet of a two-phase hybrid (or permanent-magnet) stepper motor, and the
// electronics that drive it.
//
// The electrical values of a data sheet depend on how the motor is connected. A bipolar drive pushes current through
// the whole coil of each phase, in both directions. A unipolar drive has the coil tapped in its middle and uses one
// half for each direction, so that half of the copper is always idle. With four leads the data are for whole coils;
// with five or six it is nearly always for half coils. `as_wound` converts.
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
  resistive,  // the supply feeds the coil through a resistor that limits it to the rated current at standstill (an L/R
              // drive)
};

struct Rotor {
  // In full steps. Two phases make four full steps for each rotor tooth, so this is a multiple of four.
  int steps_per_revolution = 200;
  KilogramMetres2 inertia = {};

  // Periods of the winding current per revolution.
  double teeth() const { return steps_per_revolution / 4.0; }
};

struct MotorData {
  Rotor rotor = {};
  NewtonMetres holding_torque = {};       // with both phases on at the rated current
  Amperes rated_current = {};             // of one phase, with both on
  Ohms resistance = {};                   // of one phase
  Henries inductance = {};                // of one phase
  Winding winding = Winding::whole_coil;  // the coils on which the four values above were measured
};

struct MotorDrive {
  Volts supply = {};
  Winding winding = Winding::whole_coil;
  Regulation regulation = Regulation::chopper;
  Volts drop = {};        // voltage drop at the transistors
  double fast_decay = 1;  // chopper: the fraction of the supply voltage applied against a falling current; 0: slow
                          // decay
};

struct MotorError {
  std::string message;  // "the rotor's inertia must be above 0 kg·m², not -1"
};

// Checks that each value is finite and above zero, and that the number of steps is a multiple of four.
Status<MotorError> check(const Rotor& rotor);
Status<MotorError> check(const MotorData& data);
Status<MotorError> check(const MotorDrive& drive);

// Returns the data of the same motor for `winding`, at the same copper losses. A half coil has half the turns: half the
// resistance and torque per ampere, and a quarter of the inductance. It carries √2 of the current and holds 1/√2 of the
// torque. (The resistance is proportional to the length of the wire, the inductance to the square of the turns.)
MotorData as_wound(const MotorData& data, Winding winding);

}  // namespace passo
