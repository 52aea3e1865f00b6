#include "pulse_table.hpp"

#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/study/ideal_path.hpp"
#include "passo/study/pulse_details.hpp"

namespace passo {
namespace {

struct Counted {
  std::int64_t pulses = 0;
  double way = 0;
};

Counted count(PulseSource& source) {
  Counted counted;
  for (; !source.done(); ++counted.pulses) counted.way += way_of(source.next());
  return counted;
}

std::string header(const PulseSource& source, const StepMove& move, const PulseTable& table,
                   const PulseDetails& beats) {
  std::vector<std::string> names = {"pulse"};
  if (table.point > 0) names.insert(names.begin(), "point");
  const auto add = [&](const std::vector<std::string>& more) { names.insert(names.end(), more.begin(), more.end()); };
  if (table.beats) add(beats.judge_names());
  if (table.beats) names.emplace_back("feed");
  for (std::size_t axis = 0; axis < move.axes(); ++axis) names.push_back(axis_name(axis));
  add(source.decision_names());
  if (table.beats) add(beats.end_names());
  if (table.time) add({"duration", "t_end"});
  return fmt::format("{}\n", fmt::join(names, ","));
}

// There may be no cells at all, e.g. no decision of a faulty listing.
void add_cells(const std::vector<std::string>& cells, std::string& line) {
  for (const std::string& cell : cells) line += "," + cell;
}

}  // namespace

Status<std::string> write_pulse_table(const Method& method, const StepMove& move, const PulseTable& table,
                                      OutputFile& file) {
  auto source = start(method, move);
  if (!source) return Failure{source.error()};
  Counted whole;
  if (table.beats || table.time) whole = count(**start(method, move));
  const PulseDetails beats(method, move, whole.pulses);
  SpeedClock clock(table.rule, whole.pulses, whole.way);
  IdealPath path(move);
  if (table.point <= 1) file.write(header(**source, move, table, beats));

  Place place = move.from;
  std::vector<std::int64_t> values;
  (*source)->decisions(values);
  std::string line;
  double before = 0;
  for (std::int64_t k = 1; !(*source)->done() && !file.failed(); ++k) {
    line = table.point > 0 ? fmt::format("{},{}", table.point, k) : fmt::format("{}", k);
    if (table.beats) add_cells(beats.judge(k, place, values), line);
    const Pulse pulse = (*source)->next();
    apply(pulse, place);
    (*source)->decisions(values);
    if (table.beats) line += "," + PulseDetails::feed(pulse);
    fmt::format_to(std::back_inserter(line), ",{}", fmt::join(place, ","));
    if (!values.empty()) fmt::format_to(std::back_inserter(line), ",{}", fmt::join(values, ","));
    if (table.beats) add_cells(beats.end(k, place), line);
    if (table.time) {
      const double now = clock.after({.pulse = pulse, .place = place, .progress = path.progress(place)});
      const double seconds = table.time->value();
      fmt::format_to(std::back_inserter(line), ",{:.9g},{:.9g}", (now - before) * seconds,
                     table.begin.value() + now * seconds);
      before = now;
    }
    line += "\n";
    file.write(line);
  }
  return Unit{};
}

}  // namespace passo
