// passo ramp: the intervals of a ramp or of a whole move, by any method, as numbers or as a picture. ramp_limit.cpp
// says what a table can do, and prints tables.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "commands.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "ramp_limit.hpp"
#include "ramp_scene.hpp"
#include "study_moves.hpp"
#include <fmt/format.h>

#include "passo/ramp/ramp_sequence.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/ramp_picture.hpp"

namespace passo {
namespace {

// --- what was asked for ---------------------------------------------------------------------------------------------

std::string missing_options(const RampArguments& arguments) {
  std::string missing;
  const auto need = [&](const char* option, bool given) {
    if (!given) missing += missing.empty() ? option : fmt::format(", {}", option);
  };
  if (arguments.print_table) return {};
  if (!arguments.limit) {
    if (arguments.picture.empty() || !arguments.output.empty()) need("--method", !arguments.method.empty());
    need("--clock HZ", arguments.clock.has_value());
    need("--accel RAD_S2", arguments.acceleration.has_value());
  } else {
    need("--max-rate HZ or --accel RAD_S2", arguments.max_rate || arguments.acceleration);
    // Pictures and tables show all usual motors.
    if (!arguments.picture.empty() || !arguments.output.empty()) return missing;
  }
  need("--steps-per-rev N", arguments.steps_per_turn.has_value());
  return missing;
}

// How many steps to show if neither --steps nor --move says it: up to the wanted rate, else up to the table's end, else
// 256.
std::int64_t natural_steps(const RampArguments& arguments, const RampSetup& setup) {
  if (arguments.max_rate) {
    const double steps = *arguments.max_rate * *arguments.max_rate * step_angle(setup.steps_per_turn).value /
                         (2 * setup.acceleration.value);
    return static_cast<std::int64_t>(std::clamp(std::ceil(steps), 1.0, 1e8));
  }
  return arguments.table_size.value_or(256);
}

// --- numbers and pictures -------------------------------------------------------------------------------------------

int write_intervals(const RampRequest& request, const std::string& path) {
  Result<RampSequence, RampError> sequence = RampSequence::start(request);
  if (!sequence) return fail(exit_bad_program, sequence.error().message);
  Result<OutputFile, OutputError> file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);

  // Only a move that turns back has places that do not follow from n.
  const bool turns = request.reverse_after > 0;
  file->write(turns ? "n,c,t_end,place\n" : "n,c,t_end\n");
  std::string line;
  long double total = 0;  // keeps more digits than are printed, however many steps are added
  for (std::int64_t n = 0; !sequence->done() && !file->failed(); ++n) {
    const double interval = sequence->next();
    total += interval;
    line.clear();
    if (sequence->whole_ticks()) {
      fmt::format_to(std::back_inserter(line), "{},{:.0f},{:.0f}", n, interval, total);
    } else {
      fmt::format_to(std::back_inserter(line), "{},{:#.15g},{:#.15g}", n, interval, static_cast<double>(total));
    }
    if (turns) fmt::format_to(std::back_inserter(line), ",{}", sequence->place());
    line += "\n";
    file->write(line);
  }
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

int draw(const RampRequest& request, const std::string& path) {
  const Result<RampScene, RampError> scene = ramp_scene(request);
  if (!scene) return fail(exit_bad_program, scene.error().message);
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{
      .format = *picture_format_of(path), .program = ramp_title(request), .machine = ramp_words(request)};
  Status<OutputError> done = draw_ramp_picture(*scene, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

std::string wrong_number(const RampArguments& arguments) {
  struct Number {
    const char* option;
    std::optional<double> value;
    const char* unit;
  };
  const Number numbers[] = {{"--clock", arguments.clock, "Hz, e.g. 1000000"},
                            {"--accel", arguments.acceleration, "rad/s\u00B2, e.g. 50"},
                            {"--max-rate", arguments.max_rate, "steps/s, e.g. 2000"},
                            {"--start-rate", arguments.start_rate, "steps/s, e.g. 300"},
                            {"--jerk", arguments.jerk, "rad/s\u00B3, e.g. 1000"}};
  for (const Number& number : numbers) {
    if (!number.value || (std::isfinite(*number.value) && *number.value > 0)) continue;
    return fmt::format("{} {:g}: expected more than 0 {}", number.option, *number.value, number.unit);
  }
  const auto counts = {std::pair("--steps", arguments.steps), std::pair("--move", arguments.move),
                       std::pair("--stop-after", arguments.stop_after),
                       std::pair("--reverse-after", arguments.reverse_after)};
  for (const auto& [option, value] : counts) {
    if (!value || (*value >= 1 && *value <= RampRequest::most_steps)) continue;
    return fmt::format("{} {}: expected 1 to {} steps", option, *value, RampRequest::most_steps);
  }
  if (arguments.steps_per_turn && (*arguments.steps_per_turn < 1 || *arguments.steps_per_turn > 1'000'000'000)) {
    return fmt::format("--steps-per-rev {}: expected a whole number above 0, e.g. 200", *arguments.steps_per_turn);
  }
  for (const auto& [option, size] :
       {std::pair("--table-size", arguments.table_size), std::pair("--print-table", arguments.print_table)}) {
    if (!size || (*size >= 1 && *size <= RampSequence::largest_table)) continue;
    return fmt::format("{} {}: expected 1 to {} entries", option, *size, RampSequence::largest_table);
  }
  return {};
}

RampRequest ramp_request_of(const RampArguments& arguments) {
  RampRequest request;
  request.setup = {.clock = Hertz(*arguments.clock),
                   .steps_per_turn = *arguments.steps_per_turn,
                   .acceleration = {*arguments.acceleration}};
  if (arguments.method == "recursive") request.method = RampMethod::recursive;
  if (arguments.method == "table") request.method = RampMethod::table;
  if (arguments.method == "midpoint") request.method = RampMethod::midpoint;
  request.whole_move = arguments.move.has_value();
  request.steps = arguments.move    ? *arguments.move
                  : arguments.steps ? *arguments.steps
                                    : natural_steps(arguments, request.setup);
  request.whole_ticks = arguments.whole_ticks;
  request.rate = Hertz(arguments.max_rate.value_or(0));
  request.start = Hertz(arguments.start_rate.value_or(0));
  request.jerk = {arguments.jerk.value_or(0)};
  request.stop_after = arguments.stop_after.value_or(0);
  request.reverse_after = arguments.reverse_after.value_or(0);
  request.table_size = arguments.table_size.value_or(0);
  return request;
}

int ramp(const RampArguments& arguments) {
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const std::string missing = missing_options(arguments);
  if (!missing.empty()) return fail(exit_bad_program, "expected also " + missing + "; see passo ramp --help");
  const std::string wrong = wrong_number(arguments);
  if (!wrong.empty()) return fail(exit_bad_program, wrong);
  if (arguments.print_table) {
    if (arguments.picture.empty() && !arguments.json && !arguments.limit) return print_ramp_table(arguments);
    return fail(exit_bad_program, "--print-table cannot be combined with --picture, --limit or --json");
  }
  if (!arguments.format.empty()) return fail(exit_bad_program, "--format is for --print-table");
  if (arguments.limit) return ramp_limit(arguments);
  if (arguments.json) return fail(exit_bad_program, "--json is only for --limit; intervals are printed as CSV");
  if (arguments.steps && arguments.move) {
    return fail(exit_bad_program, "expected either --steps (a ramp) or --move (a whole move)");
  }
  for (const auto& [option, given] : {std::pair("--stop-after", arguments.stop_after.has_value()),
                                      std::pair("--reverse-after", arguments.reverse_after.has_value())}) {
    if (given && !arguments.move) return fail(exit_bad_program, fmt::format("{} is for a --move", option));
  }
  if (arguments.stop_after && arguments.reverse_after) {
    return fail(exit_bad_program, "--stop-after and --reverse-after cannot be combined");
  }
  const RampRequest request = ramp_request_of(arguments);
  if (!arguments.picture.empty()) {
    if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
    const int code = draw(request, arguments.picture);
    if (code != exit_done || arguments.output.empty()) return code;
  }
  return write_intervals(request, arguments.output);
}

}  // namespace passo
