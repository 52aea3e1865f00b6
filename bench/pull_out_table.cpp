// Pull-out curves that a manufacturer has published, and what this project's physics makes of the same motors. Prints
// the tables of docs/ramps/published.md, which says where the numbers come from and how they were read.
//
//   build/release/bench/pull_out_table
//
// The same numbers come out on every machine.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "passo/motor/motor_trials.hpp"

namespace passo {
namespace {

struct Published {
  double turns_per_minute;
  double torque;  // N·m
};

struct Case {
  const char* name;
  const char* conditions;
  MotorData sheet;
  double peak_current;  // A, of a sine, or of a phase in half steps; as the drive was set
  double supply;        // V
  const char* excitation;
  bool knows_inertia;
  std::vector<Published> curve;
};

MotorData sheet(double torque, double current, double ohms, double millihenries, double g_cm2) {
  return {.rotor = {.steps_per_revolution = 200, .inertia = {g_cm2 * 1e-7}},
          .holding_torque = {torque},
          .rated_current = {current},
          .resistance = {ohms},
          .inductance = {millihenries * 1e-3}};
}

std::vector<Case> cases() {
  const MotorData small = sheet(1.9, 2.8, 1.13, 4.8, 440);
  const MotorData long_body = sheet(3.0, 4.2, 0.88, 3.4, 800);
  const MotorData large = sheet(9.0, 6.0, 0.45, 4.6, 1);  // its inertia is not known
  const double rms = std::numbers::sqrt2;
  return {
      {"23HS30-2804S",
       "48 V, 2.69 A rms, 2000 steps/rev",
       small,
       2.69 * rms,
       48,
       "microsteps:10",
       true,
       {{90, 1.84},
        {300, 1.76},
        {390, 1.56},
        {510, 1.28},
        {600, 1.12},
        {810, 0.88},
        {990, 0.60},
        {1200, 0.40},
        {1500, 0.18}}},
      {"23HS30-2804S",
       "36 V, 2.69 A rms, 2000 steps/rev",
       small,
       2.69 * rms,
       36,
       "microsteps:10",
       true,
       {{300, 1.44}, {390, 1.28}, {510, 1.00}, {600, 0.88}}},
      {"23HS45-4204S",
       "36 V, 4.2 A, half steps",
       long_body,
       4.2,
       36,
       "half-step",
       true,
       {{60, 2.50}, {150, 2.31}, {300, 2.07}, {360, 1.97}, {420, 1.84}}},
      {"23HE45-4204S",
       "36 V, 4.1 A (peak), 2000 steps/rev",
       long_body,
       4.1,
       36,
       "microsteps:10",
       true,
       {{300, 2.40}, {390, 2.01}, {510, 1.63}, {600, 1.30}}},
      {"23HE45-4204S",
       "36 V, 4.1 A (rms), 2000 steps/rev",
       long_body,
       4.1 * rms,
       36,
       "microsteps:10",
       true,
       {{300, 2.40}, {390, 2.01}, {510, 1.63}, {600, 1.30}}},
      {"34HE46-6004D",
       "48 V, 6 A rms, 2000 steps/rev",
       large,
       6 * rms,
       48,
       "microsteps:10",
       false,
       {{300, 3.60}, {450, 2.53}, {510, 2.24}, {600, 1.85}, {900, 1.15}}},
      {"34HE46-6004D",
       "60 V, 6 A rms, 2000 steps/rev",
       large,
       6 * rms,
       60,
       "microsteps:10",
       false,
       {{300, 4.25}, {450, 3.00}, {600, 2.43}, {900, 1.65}}},
  };
}

// The torque goes with the current: iron that saturates is left out.
MotorData at_current(const MotorData& sheet, double current) {
  MotorData motor = sheet;
  motor.holding_torque.value *= current / sheet.rated_current.value;
  motor.rated_current = {current};
  return motor;
}

struct Errors {
  double sum = 0;
  double most = 0;
  int count = 0;

  void add(double error) {
    sum += std::abs(error);
    if (std::abs(error) > std::abs(most)) most = error;
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

void print(const Case& one) {
  MotorSetup setup{.motor = at_current(one.sheet, one.peak_current),
                   .drive = {.supply = {one.supply}},
                   .excitation = *Excitation::named(one.excitation)};
  setup.damping = damping_of(setup.motor);
  const auto curve = TorqueCurve::from_motor(setup.motor, setup.drive);
  fmt::print("**{}**, {}\n\n| rpm | full steps/s | published, N\u00B7m | formula | | trial | |\n", one.name,
             one.conditions);
  fmt::print("|---|---|---|---|---|---|---|\n");
  Errors formula;
  Errors trial;
  for (const Published& point : one.curve) {
    const Hertz rate(point.turns_per_minute / 60 * 200);
    const double computed = curve->pull_out(curve->speed_at(rate)).value;
    formula.add(computed / point.torque - 1);
    fmt::print("| {:g} | {:g} | {:.2f} | {:.2f} | {:+.0f} % |", point.turns_per_minute, rate.value(), point.torque,
               computed, 100 * (computed / point.torque - 1));
    if (one.knows_inertia) {
      const double tried = tried_pull_out(setup, rate).value;
      trial.add(tried / point.torque - 1);
      fmt::print(" {:.2f} | {:+.0f} % |\n", tried, 100 * (tried / point.torque - 1));
    } else {
      fmt::print(" | |\n");
    }
  }
  fmt::print("\nFormula: {:.0f} % in the mean, {:+.0f} % at the worst.", 100 * formula.mean(), 100 * formula.most);
  if (one.knows_inertia) {
    fmt::print(" Trial: {:.0f} % in the mean, {:+.0f} % at the worst.", 100 * trial.mean(), 100 * trial.most);
  }
  fmt::print("\n\n");
}

}  // namespace
}  // namespace passo

int main() {
  for (const passo::Case& one : passo::cases()) passo::print(one);
}
