#include "point_after_point.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>

#include "program_input.hpp"
#include "study_moves.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "passo/study/ideal_path.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

// What one move takes: its pulses by the number of axes that step, and the time of a pulse of one axis.
struct PointFigures {
  std::array<std::int64_t, most_axes + 1> pulses = {};  // [n]: pulses of n axes
  double way = 0;                                       // N1 + N2 √2 + N3 √3 …
};

Result<PointFigures, std::string> figures_of(const Method& method, const StepMove& move) {
  auto source = start(method, move);
  if (!source) return Failure{title(method) + " " + source.error()};
  PointFigures found;
  while (!(*source)->done()) {
    const Pulse pulse = (*source)->next();
    ++found.pulses[static_cast<std::size_t>(std::popcount(pulse.steps))];
    found.way += way_of(pulse);
  }
  return found;
}

double step_time(const PointFigures& figures, Seconds time) {
  return figures.way == 0 ? 0 : time.value() / figures.way;
}

void print_step_times(const std::vector<StepMove>& moves, const std::vector<PointFigures>& figures,
                      const std::vector<Seconds>& times) {
  const std::size_t axes = moves.front().axes();
  std::string text = "point";
  for (std::size_t axis = 0; axis < axes; ++axis) text += "," + axis_name(axis);
  text += ",length_steps,TPS_s";
  for (std::size_t n = 1; n <= axes; ++n) fmt::format_to(std::back_inserter(text), ",N{}", n);
  text += ",t_s\n";
  for (std::size_t i = 0; i < moves.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{:.9g},{:.9g}", i + 1, fmt::join(moves[i].to, ","),
                   IdealPath(moves[i]).length(), times[i].value());
    for (std::size_t n = 1; n <= axes; ++n) fmt::format_to(std::back_inserter(text), ",{}", figures[i].pulses[n]);
    fmt::format_to(std::back_inserter(text), ",{:.9g}\n", step_time(figures[i], times[i]));
  }
  fmt::print("{}", text);
}

void print_points_json(const Method& method, const std::vector<StepMove>& moves,
                       const std::vector<PointFigures>& figures, const std::vector<Seconds>& times) {
  nlohmann::ordered_json all = {{"method", title(method)}, {"from", moves.front().from}};
  double total = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    nlohmann::ordered_json point = {{"to", moves[i].to}, {"length_steps", IdealPath(moves[i]).length()}};
    if (!times.empty()) point["time_s"] = times[i].value();
    for (std::size_t n = 1; n <= moves[i].axes(); ++n) point[fmt::format("n{}", n)] = figures[i].pulses[n];
    if (!times.empty()) point["step_time_s"] = step_time(figures[i], times[i]);
    if (!times.empty()) total += times[i].value();
    all["points"].push_back(point);
  }
  if (!times.empty()) all["time_s"] = total;
  fmt::print("{}\n", all.dump(2));
}

int write_all_pulses(const Method& method, const std::vector<StepMove>& moves, const std::vector<Seconds>& times,
                     PulseTable table, const std::string& path) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    table.point = static_cast<int>(i) + 1;
    if (!times.empty()) table.time = times[i];
    const Status<std::string> done = write_pulse_table(method, moves[i], table, *file);
    if (!done) return fail(exit_bad_program, title(method) + " " + done.error());
    if (!times.empty()) table.begin = table.begin + times[i];
  }
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

}  // namespace

Result<std::vector<StepMove>, std::string> step_moves_of(const InterpolateArguments& arguments) {
  constexpr std::string_view gaps = " \t\n;";
  std::vector<StepMove> moves;
  InterpolateArguments one = arguments;
  for (std::size_t begin = arguments.to.find_first_not_of(gaps); begin < arguments.to.size();) {
    const std::size_t end = std::min(arguments.to.find_first_of(gaps, begin), arguments.to.size());
    one.to = arguments.to.substr(begin, end - begin);
    auto move = step_move_of(one);
    if (!move)
      return Failure{moves.empty() ? move.error() : fmt::format("point {}: {}", moves.size() + 1, move.error())};
    if (!moves.empty() && move->arc)
      return Failure{std::string("--center is for one move, but --to has several points")};
    one.from = fmt::format("{}", fmt::join(move->to, ","));
    moves.push_back(std::move(*move));
    begin = arguments.to.find_first_not_of(gaps, end);
  }
  if (moves.empty()) return Failure{std::string("--to: expected whole steps separated by commas, e.g. 10,-4")};
  return moves;
}

Result<std::vector<Seconds>, std::string> times_of(const InterpolateArguments& arguments,
                                                   const std::vector<StepMove>& moves) {
  double length = 0;
  for (const StepMove& move : moves) length += IdealPath(move).length();
  const auto first = time_of(arguments, moves.front());
  if (!first) return Failure{first.error()};
  std::vector<Seconds> times;
  if (!*first) return times;
  for (const StepMove& move : moves) {
    const double own = IdealPath(move).length();
    times.push_back(arguments.time ? Seconds(length == 0 ? 0 : *arguments.time * own / length)
                                   : **time_of(arguments, move));
  }
  return times;
}

int point_after_point(const InterpolateArguments& arguments, const Method& method, const std::vector<StepMove>& moves,
                      const PulseTable& table) {
  const auto times = times_of(arguments, moves);
  if (!times) return fail(exit_bad_program, times.error());
  if (!arguments.step_times && !arguments.json) return write_all_pulses(method, moves, *times, table, arguments.output);
  if (arguments.step_times && times->empty()) {
    return fail(exit_bad_program, "--step-times divides the time of each point, so it needs --time or --feed");
  }
  if (!arguments.output.empty() || arguments.beats || !arguments.rule.empty()) {
    return fail(exit_bad_program, "--output, --beats and --rule are for pulses, not for --step-times or --json");
  }
  std::vector<PointFigures> figures;
  for (const StepMove& move : moves) {
    const auto found = figures_of(method, move);
    if (!found) return fail(exit_bad_program, found.error());
    figures.push_back(*found);
  }
  if (arguments.json) {
    print_points_json(method, moves, figures, *times);
  } else {
    print_step_times(moves, figures, *times);
  }
  return exit_done;
}

}  // namespace passo
