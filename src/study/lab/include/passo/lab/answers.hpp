// The answers of the lab: the data that the web interface's lab draws, computed by the program's own interpolators,
// ramps and motors.
//
// Each answer is one JSON text. Columns are lists of equal length, with one entry for each pulse, step or moment; the
// names include the units. If a question has no answer, the text is {"error": "…"} with the reason.
//
// Every answer is bounded: most_entries is the maximum length of a column. No state is kept between questions.
#pragma once

#include <cstdint>
#include <string>

#include "passo/feedback/loop_trial.hpp"
#include "passo/motor/darlington.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/motor/torque_curve.hpp"
#include "passo/motor/winding_current.hpp"
#include "passo/ramp/ramp_sequence.hpp"
#include "passo/study/method.hpp"

namespace passo {

inline constexpr std::int64_t most_entries = 20'000;

// Returns one move by one method, pulse by pulse: position, deviation from the ideal path in steps, the fraction of the
// time under each SpeedRule, and the method's decisions and counters (study/pulse_details.hpp). `ideal` is the path as
// a polyline in X and Y; `places` and `feet` have a column for each of the two to eight axes. For a faulty listing,
// `fault` has the numbers of its wrong pulses and where it ends.
std::string interpolation_answer(const Method& method, const StepMove& move);
// Returns the figures of every method that supports the move.
std::string comparison_answer(const StepMove& move);

// Returns the windings and the rotor at the positions `first` … `last`.
std::string windings_answer(const Excitation& excitation, std::int32_t full_steps_per_turn, std::int64_t first,
                            std::int64_t last);

// Returns one ramp or move: intervals in ticks, each with its difference from the exact interval, and the ideal rate.
std::string ramp_answer(const RampRequest& request);

// A question about pull-out and pull-in torque and the available acceleration, at `rows` rates from 0 to `end`.
// `margin`: the fraction of the torque to use, above 0 up to 1. `end` 0: where no torque is left. `acceleration`: the
// required acceleration; the answer includes the torque it needs in addition to friction, and the rate up to which the
// motor has that torque.
struct TorqueQuestion {
  MotorData motor;
  MotorDrive drive;
  Load load;
  double margin = 1;
  RadiansPerSecond2 acceleration = {};
  Hertz end{0};
  std::int32_t rows = 100;
};
std::string torque_answer(const TorqueQuestion& question);

// A question about the stage that switches the windings of a unipolar motor: the current of one winding, on for two
// steps and off for two, with three stages: the supply alone, a raised supply with a series resistor, and the raised
// supply with a chopper that holds the rated current. Then what its base resistor and its heat are.
struct DriverQuestion {
  MotorData motor;  // of a half coil
  Volts supply = {};
  Volts raised = {};
  Ohms series = {};
  double ripple = 0;  // of the chopper, as WindingCircuit::ripple
  Hertz rate{0};      // full steps a second
  Darlington transistor = {};
  Volts logic = {};
  double reserve = 0;  // of the base current: 0.3 for 30 %
  Ohms base = {};
};
std::string driver_answer(const DriverQuestion& question);

// Returns the step response, and its figures.
std::string loop_answer(const LoopSetup& setup, Seconds whole);
// Returns the gain at which the loop with P only oscillates with constant amplitude, and the gains of Ziegler and
// Nichols.
std::string ultimate_answer(const LoopSetup& setup);

// Returns the answer to a question that could not be passed to any of the above functions.
std::string error_answer(const std::string& words);

}  // namespace passo
