// passo windings: the windings, the phase currents and the rotor of each motor while a move is played. The move is one
// of `passo interpolate`, at an even speed, or of `passo ramp`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "commands.hpp"
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
  const PictureOptions options{
      .format = *picture_format_of(path),
      .program = "Windings, " + motors.excitation.name(),
      .machine = fmt::format("{}   \u00B7   motors with {} full steps/rev", move.title, motors.full_steps_per_turn)};
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
  const WindingMotors motors{.excitation = *excitation, .full_steps_per_turn = full_steps, .count = move->motors};
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
