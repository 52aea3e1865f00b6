// passo interpolate: one move in steps, pulse by pulse, by any of the classic methods. The result is shown as numbers
// or as a picture, for one method or for all methods side by side.
#include <charconv>
#include <cmath>
#include <cstdio>

#include "commands.hpp"
#include "interpolate_dialogue.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "point_after_point.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "pulse_table.hpp"
#include "study_moves.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/report/interpolation_picture.hpp"
#include "passo/study/faulty_listing.hpp"
#include "passo/study/ideal_path.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

template <class T>
using Parsed = Result<T, std::string>;

Parsed<Place> parse_place(const char* option, std::string_view text) {
  Place place;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view number = text.substr(0, comma);
    std::int64_t steps = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), steps);
    if (error != std::errc() || end != number.data() + number.size()) {
      return Failure{
          fmt::format("{}: expected whole steps separated by commas, e.g. 10,-4, found '{}'", option, number)};
    }
    place.push_back(steps);
    if (comma == text.size()) return place;
    text.remove_prefix(comma + 1);
  }
}

constexpr const char* rule_names[speed_rules] = {"beats", "roots", "exact"};

SpeedRule rule_of(const InterpolateArguments& arguments) {
  for (std::size_t rule = 0; rule < speed_rules; ++rule) {
    if (arguments.rule == rule_names[rule]) return static_cast<SpeedRule>(rule);
  }
  return SpeedRule::roots;
}

// --- numbers --------------------------------------------------------------------------------------------------------

int write_pulses(const Method& method, const StepMove& move, const PulseTable& table, const std::string& path) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  const Status<std::string> done = write_pulse_table(method, move, table, *file);
  if (!done) return fail(exit_bad_program, title(method) + " " + done.error());
  const Status<OutputError> written = file->commit();
  if (!written) return fail(exit_failed, written.error().message);
  if (right_method_of(method)) {
    std::fflush(stdout);
    fmt::print(stderr, "{}: {}\n", title(method), check_listing(method, move)->describe());
  }
  return exit_done;
}

// --- figures --------------------------------------------------------------------------------------------------------

Parsed<std::vector<StudiedMethod>> study(const std::vector<Method>& methods, const StepMove& move) {
  std::vector<StudiedMethod> studied;
  ProgressDisplay progress("interpolate");
  for (const Method& method : methods) {
    const auto watch = [&](double share) {
      progress.update((static_cast<double>(studied.size()) + share) / static_cast<double>(methods.size()));
    };
    const auto measures = measure(method, move, watch);
    if (!measures) return Failure{title(method) + " " + measures.error()};
    studied.push_back({.method = method, .measures = *measures});
  }
  return studied;
}

// In a picture the right method is shown beside a faulty listing.
std::vector<StudiedMethod> studied_for_picture(const std::vector<StudiedMethod>& studied, const StepMove& move) {
  const std::optional<Method> right = right_method_of(studied.front().method);
  if (!right) return studied;
  return {studied.front(), {.method = *right, .measures = *measure(*right, move)}};
}

void print_json(const std::vector<StudiedMethod>& studied, const StepMove& move, double um) {
  nlohmann::ordered_json all;
  all["from"] = move.from;
  all["to"] = move.to;
  all["length_steps"] = IdealPath(move).length();
  all["step_um"] = um;
  for (const StudiedMethod& one : studied) {
    const Measures& found = one.measures;
    nlohmann::ordered_json method = {{"method", title(one.method)},
                                     {"pulses", found.pulses},
                                     {"together", found.together},
                                     {"idle", found.idle},
                                     {"largest_deviation_steps", found.largest_deviation},
                                     {"mean_deviation_steps", found.mean_deviation},
                                     {"largest_deviation_um", found.largest_deviation * um},
                                     {"mean_deviation_um", found.mean_deviation * um}};
    for (std::size_t rule = 0; rule < speed_rules; ++rule) {
      method["speed"][rule_names[rule]] = {{"lag_steps", found.evenness[rule].lag},
                                           {"ratio", found.evenness[rule].ratio}};
    }
    if (const std::optional<Method> right = right_method_of(one.method)) {
      const auto check = check_listing(one.method, move);
      method["listing"] = {{"right_method", title(*right)},
                           {"wrong_pulses", check->wrong()},
                           {"first_wrong_pulse", check->first_wrong()},
                           {"end", check->place()}};
    }
    all["methods"].push_back(method);
  }
  fmt::print("{}\n", all.dump(2));
}

void print_table(const std::vector<StudiedMethod>& studied, const StepMove& move, double um) {
  fmt::print("{:.6g} steps of {:.4g} µm on the ideal path\n\n", IdealPath(move).length(), um);
  fmt::print("{:<20} {:>17} {:>17} {:>10} {:>10} {:>10}  {:>20}  {:>17}\n", "", "largest deviation", "mean deviation",
             "pulses", "together", "idle", "largest unevenness", "fastest : slowest");
  fmt::print("{:<20} {:>8} {:>8} {:>8} {:>8} {:>32}  {:>6} {:>6} {:>6}  {:>5} {:>5} {:>5}\n", "method", "steps", "µm",
             "steps", "µm", "", "beats", "roots", "exact", "beats", "roots", "exact");
  for (const StudiedMethod& one : studied) {
    const Measures& found = one.measures;
    fmt::print("{:<20} {:>8.3f} {:>8.2f} {:>8.3f} {:>8.2f} {:>10} {:>10} {:>10} ", title(one.method),
               found.largest_deviation, found.largest_deviation * um, found.mean_deviation, found.mean_deviation * um,
               found.pulses, found.together, found.idle);
    for (const Evenness& evenness : found.evenness) fmt::print(" {:>6.2f}", evenness.lag);
    fmt::print(" ");
    for (const Evenness& evenness : found.evenness) fmt::print(" {:>5.2f}", evenness.ratio);
    fmt::print("\n");
  }
  fmt::print(
      "\ntogether: pulses in which several axes step; idle: pulses without a step. Evenness of speed with equal\n"
      "pulses (beats), pulses as long as the root of their axes (roots), or as the ideal path needs\n"
      "(exact): the largest lead or lag of the tool in steps, and the ratio of its fastest to its slowest step.\n");
}

int draw(const std::vector<StudiedMethod>& studied, const StepMove& move, const std::string& path) {
  const std::optional<PictureFormat> format = picture_format_of(path);
  if (const std::string why = refuse_picture(path); !why.empty()) return fail(exit_bad_program, why);
  for (const StudiedMethod& one : studied) {
    if (one.measures.pulses <= most_pictured_pulses) continue;
    return fail(exit_bad_program, fmt::format("--picture: {} pulses are too many to draw; at most {} are possible",
                                              one.measures.pulses, most_pictured_pulses));
  }
  auto file = OutputFile::open(path);
  Status<OutputError> done = Unit{};
  if (file) {
    done = draw_interpolation(move, studied, *format, *file);
    if (done) done = file->commit();
  } else {
    done = Failure{file.error()};
  }
  if (done) return exit_done;
  fmt::print(stderr, "passo: error: {}\n", done.error().message);
  return exit_failed;
}

// Only the method can be chosen for the dialogue.
bool is_dialogue(const InterpolateArguments& a) {
  return a.from.empty() && a.center.empty() && !a.clockwise && a.end.empty() && !a.compare && !a.beats && !a.time &&
         !a.feed && !a.step_times && a.rule.empty() && a.picture.empty() && a.output.empty() && !a.json;
}

}  // namespace

Result<StepMove, std::string> step_move_of(const InterpolateArguments& arguments) {
  const Parsed<Place> to = parse_place("--to", arguments.to);
  if (!to) return Failure{to.error()};
  StepMove move{.from = Place(to->size(), 0), .to = *to, .arc = {}};
  if (!arguments.from.empty()) {
    const Parsed<Place> from = parse_place("--from", arguments.from);
    if (!from) return Failure{from.error()};
    move.from = *from;
  }
  if (!arguments.center.empty()) {
    const Parsed<Place> centre = parse_place("--center", arguments.center);
    if (!centre) return Failure{centre.error()};
    move.arc = StepMove::Arc{.centre = *centre, .clockwise = arguments.clockwise};
  } else if (arguments.clockwise) {
    return Failure{std::string("--cw is for an arc, so it needs --center")};
  }
  const Status<std::string> status = check(move);
  if (!status) return Failure{"the move " + status.error()};
  return move;
}

Result<Method, std::string> method_of(const InterpolateArguments& arguments) {
  const std::string named = arguments.method.empty() ? "bresenham" : arguments.method;
  const std::optional<MethodName> name = method_named(named, !arguments.center.empty());
  if (!name) {
    return Failure{
        fmt::format("--method: '{}' is not one of {}, bresenham", arguments.method, fmt::join(method_names(), ", "))};
  }
  Method method{.name = *name, .half_loaded = arguments.half_loaded};
  if (*name != MethodName::dda && (arguments.half_loaded || arguments.register_bits != 0)) {
    return Failure{std::string("--half-loaded and --register-bits are for --method dda")};
  }
  if (arguments.register_bits != 0) {
    if (!arguments.center.empty()) return Failure{std::string("--register-bits is for lines")};
    method.register_bits = static_cast<std::uint8_t>(std::clamp(arguments.register_bits, 0, 255));
  }
  if (arguments.end == "coordinates") method.end_judging = EndJudging::coordinates;
  if (arguments.end == "projection") method.end_judging = EndJudging::projection;
  if (!arguments.end.empty() && *name != MethodName::point_comparison) {
    return Failure{std::string("--end is for --method point-comparison")};
  }
  return method;
}

Result<std::optional<Seconds>, std::string> time_of(const InterpolateArguments& arguments, const StepMove& move) {
  if (arguments.time && arguments.feed)
    return Failure{std::string("--time and --feed both set the duration: give only one of them")};
  for (const auto& [option, value] : {std::pair("--time", arguments.time), std::pair("--feed", arguments.feed)}) {
    if (value && !(std::isfinite(*value) && *value > 0)) {
      return Failure{fmt::format("{}: expected a number above 0, found {:g}", option, *value)};
    }
  }
  if (!arguments.time && !arguments.feed) {
    if (!arguments.rule.empty()) return Failure{std::string("--rule is for durations, so it needs --time or --feed")};
    return std::optional<Seconds>();
  }
  if (arguments.time) return std::optional(Seconds(*arguments.time));
  const double length_mm = IdealPath(move).length() / arguments.steps_per_mm;
  return std::optional(Seconds(length_mm / *arguments.feed * seconds_per_minute));
}

namespace {

// What to do with one move: its pulses, its figures, its picture.
int interpolate_move(const InterpolateArguments& arguments, const std::vector<Method>& methods, const StepMove& move) {
  const Parsed<std::optional<Seconds>> time = time_of(arguments, move);
  if (!time) return fail(exit_bad_program, time.error());
  const PulseTable table{.beats = arguments.beats, .time = *time, .rule = rule_of(arguments)};
  const bool figures = arguments.compare || arguments.json;
  if (figures && (!arguments.output.empty() || table.beats || table.time)) {
    return fail(exit_bad_program, "--output, --beats, --time and --feed are for the pulses of one method");
  }
  if (!figures && arguments.picture.empty()) return write_pulses(methods[0], move, table, arguments.output);

  const Parsed<std::vector<StudiedMethod>> studied = study(methods, move);
  if (!studied) return fail(exit_bad_program, studied.error());
  if (!arguments.picture.empty()) {
    const int code = draw(studied_for_picture(*studied, move), move, arguments.picture);
    // A picture is an answer by itself. The pulses are written too only if a file for them is named.
    if (code == exit_done && !arguments.output.empty()) {
      return write_pulses(methods[0], move, table, arguments.output);
    }
    if (code != exit_done) return code;
  }
  const double um = 1000 / arguments.steps_per_mm;
  if (arguments.json) print_json(*studied, move, um);
  if (arguments.compare && !arguments.json) print_table(*studied, move, um);
  return exit_done;
}

}  // namespace

int interpolate(const InterpolateArguments& arguments) {
  if (arguments.to.empty()) {
    return is_dialogue(arguments) ? interpolate_dialogue(arguments)
                                  : fail(exit_bad_program, "--to is missing: expected the end of the move, X,Y[,Z...]");
  }
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const Parsed<std::vector<StepMove>> moves = step_moves_of(arguments);
  if (!moves) return fail(exit_bad_program, moves.error());
  if (!(arguments.steps_per_mm > 0)) return fail(exit_bad_program, "--steps-per-mm: expected a number above 0");
  const bool points =
      moves->size() > 1 || arguments.step_times || (arguments.json && (arguments.time || arguments.feed));
  if (points && (arguments.compare || !arguments.picture.empty())) {
    return fail(exit_bad_program,
                "--compare and --picture are for one point, without --step-times and without the times of --json");
  }
  if (arguments.compare) {
    if (!arguments.method.empty())
      return fail(exit_bad_program, "--compare uses all methods, so it cannot be combined with --method");
    return interpolate_move(arguments, methods_for(moves->front()), moves->front());
  }
  const Parsed<Method> method = method_of(arguments);
  if (!method) return fail(exit_bad_program, method.error());
  if (!points) return interpolate_move(arguments, {*method}, moves->front());
  return point_after_point(arguments, *method, *moves,
                           {.beats = arguments.beats, .time = {}, .rule = rule_of(arguments)});
}

}  // namespace passo
