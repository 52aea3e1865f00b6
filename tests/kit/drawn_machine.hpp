// Drawn machines: random machines and programs, harsh and mild, with motors drawn at random from their tolerances; for
// each, the verdict of a MarginSurvey and the result of the full physics.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/program.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/session/board_machine_session.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo::test {

inline constexpr double drawn_tolerance = 0.15;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  // Uniformly distributed in the logarithm.
  double about(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  bool one_of(int count) { return between(0, count) < 1; }
  template <std::size_t n>
  double choice(const std::array<double, n>& values) {
    return values[std::min(n - 1, static_cast<std::size_t>(between(0, n)))];
  }

 private:
  std::mt19937_64 random_;
};

// Returns a motor from small to large, in the proportions of data sheets, with its driver and its load; and an
// acceleration that requires a fraction of the torque, from far too little to far too much.
inline std::string axis_text(char letter, Draw& draw) {
  const double size = draw.about(0.2, 3);  // N·m
  const double current = draw.between(1, 4);
  constexpr double teeth = 50;
  // In typical motors the flux of the current is about that of the magnet, and L/R is a few milliseconds.
  const double magnet_flux = size / (std::numbers::sqrt2 * current) / teeth;
  const double inductance = draw.between(0.8, 1.5) * magnet_flux / current;
  const double resistance = inductance / draw.between(1.5e-3, 4e-3);
  const MotorData motor{.rotor = {.steps_per_revolution = 200, .inertia = {size * draw.between(1.5e-5, 2.6e-5)}},
                        .holding_torque = {size},
                        .rated_current = {current},
                        .resistance = {resistance},
                        .inductance = {inductance}};
  const bool resistive = draw.one_of(5);
  const MotorDrive drive{.supply = {draw.choice(std::array{24.0, 36.0, 48.0})},
                         .regulation = resistive ? Regulation::resistive : Regulation::chopper};
  const auto curve = TorqueCurve::from_motor(motor, drive);
  const double hold = curve->pull_out({0}).value;
  // The maximum speed leaves between most and a fifth of the torque.
  const double left = draw.between(0.2, 0.95) * hold;
  double shaft = 1;
  while (curve->pull_out({shaft}).value > left && shaft < 150) shaft *= 1.02;
  const double pitch = draw.choice(std::array{2.0, 4.0, 5.0, 10.0});
  const double way = pitch / (2 * std::numbers::pi);  // mm per radian
  const double inertia = motor.rotor.inertia.value * draw.between(0.2, 3);
  const double friction = draw.between(0.02, 0.2) * hold;
  const double acceleration =
      draw.about(0.12, 1.6) * curve->pull_out({shaft}).value / (inertia + motor.rotor.inertia.value) * way;
  std::string text = fmt::format(
      "[axis.{}]\nsteps_per_turn = 200\nmicrosteps = {}\nscrew_pitch_mm = {}\ntravel_mm = [-200, 200]\n"
      "max_velocity_mm_s = {:.3f}\nmax_acceleration_mm_s2 = {:.3f}\n",
      letter, draw.choice(std::array{1.0, 2.0, 4.0, 8.0, 16.0, 16.0}), pitch, shaft * way, acceleration);
  if (draw.one_of(2)) text += fmt::format("max_jerk_mm_s3 = {:.3f}\n", acceleration / draw.about(0.005, 0.05));
  text += fmt::format(
      "[axis.{}.torque]\nlimits_motion = false\ntolerance = {}\nholding_torque_nm = {:.4f}\nrated_current_a = {:.4f}\n"
      "resistance_ohm = {:.4f}\ninductance_mh = {:.4f}\nrotor_inertia_g_cm2 = {:.4f}\nsupply_v = {}\ndrive = \"{}\"\n"
      "load_inertia_g_cm2 = {:.4f}\nfriction_nm = {:.5f}\n",
      letter, drawn_tolerance, size, current, resistance, motor.inductance.value * 1e3, motor.rotor.inertia.value * 1e7,
      drive.supply.value, resistive ? "resistive" : "chopper", inertia * 1e7, friction);
  return text;
}

inline std::string machine_text(Draw& draw) {
  std::string text =
      "name = \"drawn\"\n[board]\nclock_hz = 72_000_000\nmax_event_rate_hz = 400_000\nstep_pulse_us = 1\n";
  text += axis_text('X', draw);
  if (draw.one_of(2)) text += axis_text('Y', draw);
  return text;
}

inline std::string program_text(const MachineDescription& machine, Draw& draw) {
  std::string text = "G21 G90 G17 F600\n";
  const double fast = machine.axes[0].velocity.value() * 60;
  const bool plane = machine.axes.size() > 1;
  for (int i = 0; i < 12; ++i) {
    text += draw.one_of(4) ? "G0" : fmt::format("G1 F{:.1f}", draw.between(0.1, 1.1) * fast);
    text += fmt::format(" X{:.3f}", draw.between(-60, 60));
    if (plane) text += fmt::format(" Y{:.3f}", draw.between(-60, 60));
    if (plane && draw.one_of(3)) text += fmt::format("\nG2 I{:.3f} J0", draw.about(0.5, 20));
    text += draw.one_of(6) ? "\nG4 P0.1\n" : "\n";
  }
  return text + "M2\n";
}

struct JudgedRun {
  Verdict verdict = Verdict::safe;
  LossCause want = LossCause::torque;
  bool lost = false;
};

inline JudgedRun play_and_judge(const MachineDescription& machine, const std::string& text, Draw& draw) {
  RotorPlant plant(Integration::always);
  fit(plant, machine, {}, {});
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    plant.fit_motor(m,
                    with_torque(*motor_setup(machine.axes[m]), draw.between(1 - drawn_tolerance, 1 + drawn_tolerance)));
  }
  MarginSurvey survey(surveyed_motors(machine), step_grid(machine));
  VirtualMachine board(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock,
                       machine.board.highest_event_rate);
  board.connect(plant);
  BoardMachineSession session(machine, board, {.start = {.place = {}, .trust = Trust::commanded}});
  while (session.state() == MachineState::offline) session.poll(endless);
  Diagnostics findings;
  request::Start start{.program = ProgramReader::from_text("drawn.ngc", text),
                       .options = {},
                       .nominal_time = Seconds(1),
                       .waits_for_operator = false,
                       .live = false,
                       .answers_probes = false,
                       .findings = &findings};
  start.watchers.motion = [&](const MotionItem& item) { survey.watch(item); };
  if (!session.request(std::move(start)).has_value()) std::abort();
  while (session.busy()) session.poll(endless);
  static_cast<void>(plant.settle(Seconds(2)));
  if (findings.any_error()) std::fputs(render(findings, false).c_str(), stderr);
  const MarginVerdict verdict = survey.verdict();
  JudgedRun outcome{.verdict = verdict.verdict};
  if (!verdict.worst.empty()) outcome.want = verdict.worst[0].want;
  outcome.lost = !plant.losses().empty();
  return outcome;
}

// Draws a run from a seed, plays it and evaluates it.
inline JudgedRun judged_run(std::uint64_t seed) {
  Draw draw(seed);
  Diagnostics diagnostics;
  const auto machine = parse_machine(machine_text(draw), "drawn.toml", diagnostics);
  if (!machine) {
    std::fputs(render(diagnostics, false).c_str(), stderr);
    std::abort();
  }
  return play_and_judge(*machine, program_text(*machine, draw), draw);
}

}  // namespace passo::test
