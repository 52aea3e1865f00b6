// passo windings: the windings, the phase currents and the rotor of each motor while a move is played. The move is one
// of `passo interpolate`, at an even speed, or of `passo ramp`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>

#include "argument_units.hpp"
#include "commands.hpp"
#include "machine_motor.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include "study_moves.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/report/winding_record.hpp"
#include "passo/study/ideal_path.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

struct TimedMove {
  std::vector<TimedPulse> pulses = {};
  Seconds end{0};
  std::size_t motors = 1;
  std::string title = {};
};
using Timed = Result<TimedMove, std::string>;

constexpr std::int64_t most_pulses = 10'000'000;

Timed line_or_arc(const InterpolateArguments& arguments) {
  const auto move = step_move_of(arguments);
  if (!move) return Failure{move.error()};
  const auto method = method_of(arguments);
  if (!method) return Failure{method.error()};
  const auto time = time_of(arguments, *move);
  if (!time) return Failure{time.error()};
  if (!*time)
    return Failure{std::string("expected --time SECONDS or --feed MM_MIN, which set the duration of the move")};
  const auto counted = measure(*method, *move);
  if (!counted) return Failure{title(*method) + " " + counted.error()};
  if (counted->pulses > most_pulses) return Failure{fmt::format("more than {} pulses", most_pulses)};
  double way = 0;
  static_cast<void>(follow(*method, *move, [&](const Followed& now) { way += way_of(now.pulse); }).has_value());
  SpeedClock clock(SpeedRule::roots, counted->pulses, way);
  TimedMove timed{.pulses = {}, .end = **time, .motors = move->axes(), .title = {}};
  static_cast<void>(follow(*method, *move, [&](const Followed& now) {
                      timed.pulses.push_back({.time = **time * clock.after(now), .pulse = now.pulse});
                    }).has_value());
  timed.title =
      fmt::format("from ({}) to ({}) by {}", fmt::join(move->from, ", "), fmt::join(move->to, ", "), title(*method));
  return timed;
}

Timed ramp_move(const RampArguments& arguments) {
  const std::string wrong = wrong_number(arguments);
  if (!wrong.empty()) return Failure{wrong};
  if (!arguments.clock || !arguments.acceleration || !arguments.steps_per_turn) {
    return Failure{std::string("a --move of one motor needs --clock, --accel and --steps-per-rev")};
  }
  if (*arguments.move > most_pulses) return Failure{fmt::format("more than {} pulses", most_pulses)};
  auto sequence = RampSequence::start(ramp_request_of(arguments));
  if (!sequence) return Failure{sequence.error().message};
  TimedMove timed{.title = fmt::format("a move of {} with its ramp", counted(*arguments.move, "step"))};
  std::int64_t place = 0;
  long double ticks = 0;
  while (!sequence->done()) {
    ticks += sequence->next();
    timed.end = Seconds(static_cast<double>(ticks) / *arguments.clock);
    const bool down = sequence->place() < place;
    place = sequence->place();
    timed.pulses.push_back({.time = timed.end, .pulse = {1, down ? std::uint8_t{1} : std::uint8_t{0}}});
  }
  return timed;
}

constexpr Volts diode_drop{0.7};

// The motor and the stage that switches it; empty: they are not known, and the currents do not rise.
using Stage = Result<std::optional<WindingStage>, std::string>;

Stage stage_of_machine(const WindingsArguments& arguments) {
  const auto setup = machine_motor(arguments.machine, arguments.axis);
  if (!setup) return Failure{setup.error()};
  if (setup->measured) {
    return Failure{fmt::format("{} has a measured curve for the motor of {}, not its resistance and inductance",
                               arguments.machine, arguments.axis)};
  }
  const MotorData motor = as_wound(setup->motor, setup->drive.winding);
  WindingStage stage{.circuit = {.supply = setup->drive.supply,
                                 .drop = setup->drive.drop,
                                 .diode = diode_drop,
                                 .winding = motor.resistance,
                                 .series = {},
                                 .inductance = motor.inductance},
                     .rated = motor.rated_current};
  if (setup->drive.regulation == Regulation::chopper) {
    stage.circuit.limit = motor.rated_current;
  } else {
    const double whole = stage.circuit.final().value * motor.resistance.value / motor.rated_current.value;
    stage.circuit.series.value = std::max(whole - motor.resistance.value, 0.0);
  }
  return std::optional(stage);
}

Stage stage_of(const WindingsArguments& arguments) {
  const std::initializer_list<std::pair<const char*, std::optional<double>>> needed = {
      {"--current", arguments.current},
      {"--resistance", arguments.resistance},
      {"--inductance", arguments.inductance},
      {"--supply", arguments.supply}};
  bool any = arguments.series || arguments.drop || arguments.chopper;
  std::string missing;
  for (const auto& [name, value] : needed) {
    any = any || value;
    if (!value) missing += missing.empty() ? name : std::string(", ") + name;
  }
  if (!arguments.machine.empty()) {
    if (any) return Failure{std::string("--machine has the motor and its supply; give only one of them")};
    return stage_of_machine(arguments);
  }
  if (!arguments.axis.empty()) return Failure{std::string("--axis is an axis of a --machine")};
  if (!any) return std::optional<WindingStage>();
  if (!missing.empty()) return Failure{"for currents that rise, expected also " + missing};
  WindingStage stage{.circuit = {.supply = {*arguments.supply},
                                 .drop = {arguments.drop.value_or(0)},
                                 .diode = diode_drop,
                                 .winding = {*arguments.resistance},
                                 .series = {arguments.series.value_or(0)},
                                 .inductance = {*arguments.inductance * henries_per_millihenry}},
                     .rated = {*arguments.current}};
  if (!(*arguments.current > 0)) return Failure{std::string("--current must be above 0 A")};
  if (arguments.chopper) stage.circuit.limit = stage.rated;
  if (const auto good = check(stage.circuit); !good) return Failure{good.error().message};
  return std::optional(stage);
}

// One line about the stage, for a picture; empty if it is not known.
std::string describe(const std::optional<WindingStage>& stage) {
  if (!stage) return {};
  const WindingCircuit& circuit = stage->circuit;
  const std::string series = circuit.series.value > 0 ? fmt::format(" + {:.4g} \u2126", circuit.series.value) : "";
  return fmt::format("   \u00B7   {:g} V, {:g} \u2126{}, {:g} mH{}", circuit.supply.value, circuit.winding.value,
                     series, circuit.inductance.value / henries_per_millihenry,
                     circuit.limit ? fmt::format(", chopper at {:g} A", circuit.limit->value) : "");
}

int record(const TimedMove& move, const WindingMotors& motors, const std::string& path, bool vcd) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  const std::unique_ptr<WindingRecord> written =
      vcd ? std::unique_ptr<WindingRecord>(std::make_unique<WindingVcd>(motors, *file))
          : std::unique_ptr<WindingRecord>(std::make_unique<WindingCsv>(motors, *file));
  for (const TimedPulse& pulse : move.pulses) written->add(pulse);
  written->finish(move.end);
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int draw(const TimedMove& move, const WindingMotors& motors, const std::string& path) {
  if (move.pulses.size() > WindingScene::most_pulses) {
    return fail(exit_bad_program, fmt::format("--picture: {} pulses are too many to draw; at most {} are possible",
                                              move.pulses.size(), WindingScene::most_pulses));
  }
  auto file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = *picture_format_of(path),
                               .program = "Windings, " + motors.excitation.name(),
                               .machine = fmt::format("{}   \u00B7   motors with {} full steps/rev{}", move.title,
                                                      motors.full_steps_per_turn, describe(motors.stage))};
  Status<OutputError> done = draw_windings({.motors = motors, .pulses = move.pulses, .end = move.end}, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int windings(const WindingsArguments& arguments) {
  const auto excitation = Excitation::named(arguments.drive);
  if (!excitation) return fail(exit_bad_program, "--drive: " + excitation.error());
  const bool ramped = arguments.ramp.move.has_value();
  if (ramped == !arguments.line.to.empty()) {
    return fail(exit_bad_program, "expected --to X,Y..., a line or an arc, or --move N, one motor with its ramp");
  }
  for (const std::string& path : arguments.traces) {
    if (!is_trace_name(path)) return fail(exit_bad_program, path + ": the name of a trace must end with .vcd or .csv");
  }
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  const int full_steps = arguments.full_steps;
  RampArguments ramp = arguments.ramp;
  // A ramp counts the driver's steps, of which there may be several to a full step.
  ramp.steps_per_turn = full_steps * excitation->steps_per_full_step();
  const Timed move = ramped ? ramp_move(ramp) : line_or_arc(arguments.line);
  if (!move) return fail(exit_bad_program, move.error());
  const Stage stage = stage_of(arguments);
  if (!stage) return fail(exit_bad_program, stage.error());
  const WindingMotors motors{
      .excitation = *excitation, .full_steps_per_turn = full_steps, .count = move->motors, .stage = *stage};
  for (const std::string& path : arguments.traces) {
    const int code = record(*move, motors, path, path.ends_with(".vcd"));
    if (code != exit_done) return code;
  }
  if (!arguments.picture.empty()) {
    const int code = draw(*move, motors, arguments.picture);
    if (code != exit_done) return code;
  }
  if (arguments.traces.empty() && arguments.picture.empty()) return record(*move, motors, "", false);
  return exit_done;
}

}  // namespace passo
