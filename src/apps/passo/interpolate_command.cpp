// passo interpolate: one move in steps, pulse by pulse, by any of the classic methods. The result is shown as numbers
// or as a picture, for one method or for all methods side by side.
#include <charconv>
#include <cstdio>
#include <iterator>

#include "commands.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/report/interpolation_picture.hpp"
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
          fmt::format("{}: expected whole steps separated by commas, as in 10,-4, found '{}'", option, number)};
    }
    place.push_back(steps);
    if (comma == text.size()) return place;
    text.remove_prefix(comma + 1);
  }
}

Parsed<StepMove> parse_move(const InterpolateArguments& arguments) {
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
    return Failure{std::string("--cw is for an arc: it wants --center")};
  }
  const Status<std::string> status = check(move);
  if (!status) return Failure{"the move " + status.error()};
  return move;
}

Parsed<Method> parse_method(const InterpolateArguments& arguments) {
  const std::optional<MethodName> name = method_named(arguments.method);
  if (!name) {
    return Failure{fmt::format("--method: '{}' is none of {}", arguments.method, fmt::join(method_names(), ", "))};
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

// --- numbers --------------------------------------------------------------------------------------------------------

int write_pulses(const Method& method, const StepMove& move, const std::string& path) {
  auto source = start(method, move);
  if (!source) return fail(exit_bad_program, title(method) + " " + source.error());
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) {
    fmt::print(stderr, "passo: error: {}\n", file.error().message);
    return exit_failed;
  }
  std::string line = "pulse";
  for (std::size_t axis = 0; axis < move.axes(); ++axis) line += "," + axis_name(axis);
  for (const std::string& name : (*source)->decision_names()) line += "," + name;
  line += "\n";
  file->write(line);

  Place place = move.from;
  std::vector<std::int64_t> values;
  for (std::int64_t pulse = 1; !(*source)->done() && !file->failed(); ++pulse) {
    apply((*source)->next(), place);
    (*source)->decisions(values);
    line.clear();
    fmt::format_to(std::back_inserter(line), "{},{},{}\n", pulse, fmt::join(place, ","), fmt::join(values, ","));
    file->write(line);
  }
  const Status<OutputError> written = file->commit();
  if (written) return exit_done;
  fmt::print(stderr, "passo: error: {}\n", written.error().message);
  return exit_failed;
}

// --- figures --------------------------------------------------------------------------------------------------------

constexpr const char* rule_names[speed_rules] = {"beats", "roots", "exact"};

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
    all["methods"].push_back(method);
  }
  fmt::print("{}\n", all.dump(2));
}

void print_table(const std::vector<StudiedMethod>& studied, const StepMove& move, double um) {
  fmt::print("{:.6g} steps of {:.4g} µm on the ideal path\n\n", IdealPath(move).length(), um);
  fmt::print("{:<20} {:>17} {:>17} {:>10} {:>10} {:>10}  {:>20}  {:>17}\n", "", "largest deviation", "mean deviation",
             "pulses", "together", "idle", "farthest from even", "fastest : slowest");
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
      "\ntogether: pulses in which several axes step; idle: in which none does. Evenness of speed, where each\n"
      "pulse lasts as long as any other (beats), the root of its axes (roots), as long as the ideal path needs\n"
      "(exact): steps that the tool is ahead or behind at most, and its fastest step over its slowest.\n");
}

int draw(const std::vector<StudiedMethod>& studied, const StepMove& move, const std::string& path) {
  const std::optional<PictureFormat> format = picture_format_of(path);
  if (!format) return fail(exit_bad_program, fmt::format("--picture: '{}' should end in .svg or .png", path));
  for (const StudiedMethod& one : studied) {
    if (one.measures.pulses <= most_pictured_pulses) continue;
    return fail(exit_bad_program, fmt::format("--picture: {} pulses are too many to be seen; {} are the most",
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

}  // namespace

int interpolate(const InterpolateArguments& arguments) {
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const Parsed<StepMove> move = parse_move(arguments);
  if (!move) return fail(exit_bad_program, move.error());
  if (!(arguments.steps_per_mm > 0)) return fail(exit_bad_program, "--steps-per-mm: expected a number above 0");
  std::vector<Method> methods;
  if (arguments.compare) {
    if (!arguments.method.empty()) return fail(exit_bad_program, "--compare takes every method: leave --method out");
    methods = methods_for(*move);
  } else {
    if (arguments.method.empty()) return fail(exit_bad_program, "expected --method NAME, or --compare");
    const Parsed<Method> method = parse_method(arguments);
    if (!method) return fail(exit_bad_program, method.error());
    methods = {*method};
  }
  const bool figures = arguments.compare || arguments.json;
  if (figures && !arguments.output.empty()) return fail(exit_bad_program, "--output is for the pulses of one method");
  if (!figures && arguments.picture.empty()) return write_pulses(methods[0], *move, arguments.output);

  const Parsed<std::vector<StudiedMethod>> studied = study(methods, *move);
  if (!studied) return fail(exit_bad_program, studied.error());
  if (!arguments.picture.empty()) {
    const int code = draw(*studied, *move, arguments.picture);
    if (code != exit_done) return code;
  }
  const double um = 1000 / arguments.steps_per_mm;
  if (arguments.json) print_json(*studied, *move, um);
  if (arguments.compare && !arguments.json) print_table(*studied, *move, um);
  return exit_done;
}

}  // namespace passo
