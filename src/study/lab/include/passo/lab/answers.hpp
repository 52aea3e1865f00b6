// Answers of the lab: what the page's lab draws, computed by the program's own interpolators, ramps and motors.
//
// Each answer is one JSON text. Columns are lists of equal length, one entry for each pulse, step or moment; the names
// say the units. Where a question has no answer, the text is {"error": "…"} with the reason in words.
//
// Every answer is bounded: most_entries is the longest column. Nothing is kept between two questions.
#pragma once

#include <cstdint>
#include <string>

#include "passo/feedback/loop_trial.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/motor/torque_curve.hpp"
#include "passo/ramp/ramp_sequence.hpp"
#include "passo/study/method.hpp"

namespace passo {

inline constexpr std::int64_t most_entries = 20'000;

// One move by one method, pulse by pulse: place, deviation from the ideal path in steps, the share of the time under
// each SpeedRule, and what the method judges, decides and counts (study/beats.hpp). `ideal` is the path as a polyline.
std::string interpolation_answer(const Method& method, const StepMove& move);
// The figures of every method that takes the move.
std::string comparison_answer(const StepMove& move);

// The windings and the rotor at the places `first` … `last`.
std::string windings_answer(const Excitation& excitation, std::int32_t full_steps_per_turn, std::int64_t first,
                            std::int64_t last);

// One ramp or move: intervals in ticks, each with its difference from the exact interval, and the ideal rate.
std::string ramp_answer(const RampRequest& request);

// Pull-out, pull-in and the acceleration that is left, at `rows` rates from 0 to `end`. `margin`: the share of the
// torque to use, above 0 to 1. `end` 0: where the motor is spent. `acceleration` asks how much torque it needs beside
// the friction, and up to which rate the motor has that.
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

// The response to a jump, and its figures.
std::string loop_answer(const LoopSetup& setup, Seconds whole);
// The gain at which the loop with P alone swings for ever, and the gains of Ziegler and Nichols.
std::string ultimate_answer(const LoopSetup& setup);

// The answer to a question that was wrong before it reached one of the above.
std::string error_answer(const std::string& words);

}  // namespace passo
