#include "follower_recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/base/lower_case.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/report/signals_reader.hpp"

namespace passo {
namespace {

constexpr Nanoseconds longest_lead = 1'000'000;  // of a direction before its edge

// The names that Passo's own traces and those of others use, in small letters.
std::optional<std::string> usual_line_of(std::string name) {
  name = lower_case(std::move(name));
  std::ranges::replace(name, '.', '_');
  std::ranges::replace(name, '-', '_');
  for (const char axis : {'x', 'y', 'z'}) {
    for (const char* word : {"clock", "step", "clk", "direction", "dir"}) {
      if (name != fmt::format("{}_{}", word, axis) && name != fmt::format("{}_{}", axis, word)) continue;
      return fmt::format("{}.{}", word[0] == 'd' ? "direction" : "clock", axis);
    }
  }
  if (name == "relay" || name == "spindle" || name == "tool") return "relay";
  if (name == "button" || name == "reset") return name;
  if (name == "key_star") return "key.*";
  if (name == "key_hash") return "key.#";
  if (name.size() == 5 && name.starts_with("key_") && name[4] >= '0' && name[4] <= '9') return "key." + name.substr(4);
  return {};
}

// The lines that the user gave a signal, by the signal's name: --signal LINE=NAME.
using GivenNames = std::map<std::string, std::string>;
Result<GivenNames, std::string> given_names_of(const std::vector<std::string>& texts) {
  GivenNames names;
  for (const std::string& text : texts) {
    const std::size_t equal = text.find('=');
    const std::string line = text.substr(0, equal);
    const bool is_signal = line == "relay" || line == "button" || line == "reset" ||
                           ((line.starts_with("clock.") || line.starts_with("direction.")) && usual_line_of(line)) ||
                           key_place(line).row >= 0;
    if (equal == std::string::npos || equal + 1 == text.size() || !is_signal) {
      return Failure{
          fmt::format("--signal {}: expected LINE=NAME, e.g. clock.x=D0; lines are clock.x, direction.x "
                      "(also y, z), relay, button, reset and key.5",
                      text)};
    }
    names[text.substr(equal + 1)] = line;
  }
  return names;
}

// Which signal of the file is which line. A given name replaces the usual one of the same line.
class LineNames {
 public:
  explicit LineNames(GivenNames given) : given_(std::move(given)) {}
  std::optional<std::string> line_of(const std::string& name) const {
    if (const auto given = given_.find(name); given != given_.end()) return given->second;
    const auto usual = usual_line_of(name);
    const auto is_given = [&](const auto& pair) { return pair.second == usual; };
    return usual && std::ranges::none_of(given_, is_given) ? usual : std::nullopt;
  }
  const GivenNames& given() const { return given_; }

 private:
  GivenNames given_;
};

std::string names_of(const Signals& signals) {
  constexpr std::size_t most_named = 24;
  std::vector<std::string> names;
  for (const Signal& signal : signals.signals) names.push_back(signal.name);
  const std::size_t more = names.size() > most_named ? names.size() - most_named : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

using Changes = std::vector<SignalChange>;

// A pulse that is shorter gets this length, but at most half the time to the next one.
void lengthen_pulses(Changes& clock, Nanoseconds pulse) {
  for (std::size_t i = 0; i + 1 < clock.size(); ++i) {
    if (!clock[i].high) continue;
    Nanoseconds fall = clock[i].at + pulse;
    if (i + 2 < clock.size()) fall = std::min(fall, clock[i].at + (clock[i + 2].at - clock[i].at) / 2);
    clock[i + 1].at = std::max(clock[i + 1].at, fall);
  }
}

// The traces of a run change a direction at the time of the first step in that direction. A follower goes by the level
// before the edge, so the change comes in the middle of the pause before it.
void lead_directions(Changes& directions, const Changes& clock) {
  for (SignalChange& direction : directions) {
    const auto edge = std::ranges::lower_bound(clock, direction.at, {}, &SignalChange::at);
    if (edge == clock.end() || edge->at != direction.at || !edge->high) continue;
    const Nanoseconds before = edge == clock.begin() ? 0 : std::prev(edge)->at;
    direction.at -= std::min((edge->at - before) / 2, longest_lead);
  }
}

using ByLine = std::map<std::string, Changes>;
Result<ByLine, std::string> lines_by_name(const std::string& path, Signals& signals, const LineNames& names) {
  ByLine lines;
  std::map<std::string, std::string> taken;
  for (Signal& signal : signals.signals) {
    const auto line = names.line_of(signal.name);
    if (!line) continue;
    if (const auto [other, is_new] = taken.try_emplace(*line, signal.name); !is_new) {
      return Failure{fmt::format("{}: {} and {} are both the line {}; choose with --signal {}=NAME", path,
                                 other->second, signal.name, *line, *line)};
    }
    lines[*line] = std::move(signal.changes);
  }
  for (const auto& [name, line] : names.given()) {
    if (taken.contains(line)) continue;
    return Failure{
        fmt::format("--signal {}={}: {} has no such signal; it has {}", line, name, path, names_of(signals))};
  }
  if (lines.empty()) {
    return Failure{
        fmt::format("{}: expected signals such as X_step and X_dir, or clock_x and direction_x; it has {}. "
                    "Name them with --signal, e.g. --signal clock.x=D0",
                    path, names_of(signals))};
  }
  return lines;
}

struct Travel {
  std::int64_t up = 0;
  std::int64_t down = 0;
};

Travel pulses_of(const std::vector<LineChange>& lines, char axis) {
  const std::string clock = std::string("clock.") + axis;
  const std::string direction = std::string("direction.") + axis;
  Travel travel;
  bool goes_down = false;
  for (const LineChange& change : lines) {
    if (change.line == direction) goes_down = change.high;
    if (change.line == clock && change.high) ++(goes_down ? travel.down : travel.up);
  }
  return travel;
}

Travel steps_of(const FollowerRun& run, const Excitation& drive, char axis) {
  const int places = 4 * drive.steps_per_full_step();
  const std::string output = std::string("windings.") + axis;
  Travel travel;
  int place = 0;
  for (const OutputChange& change : run.changes) {
    if (change.output != output) continue;
    int to = 0;  // also after a reset, without current
    while (to < places && winding_text(drive.at(to).pattern) != change.value) ++to;
    if (to == places) to = change.value == "0000" ? 0 : place;
    const int turn = (to - place + places) % places;
    if (change.value != "0000" && turn == 1) ++travel.up;
    if (change.value != "0000" && turn == places - 1) ++travel.down;
    place = to;
  }
  return travel;
}

Excitation drive_of(std::string_view follower) {
  const bool half = follower.ends_with("half_step");
  return *Excitation::named(half ? "half-step" : follower.ends_with("wave") ? "wave" : "two-on");
}

// The shortest level of a clock line, in microseconds.
double shortest_level(const std::vector<LineChange>& lines) {
  std::map<std::string, Nanoseconds> last;
  Nanoseconds shortest = 0;
  for (const LineChange& change : lines) {
    if (!change.line.starts_with("clock.")) continue;
    const auto [before, is_first] = last.try_emplace(change.line, change.at);
    if (!is_first && (shortest == 0 || change.at - before->second < shortest)) shortest = change.at - before->second;
    before->second = change.at;
  }
  return static_cast<double>(shortest) * 1e-3;
}

}  // namespace

Result<FollowerRecording, std::string> read_follower_recording(const FollowerArguments& arguments,
                                                               std::size_t most_changes) {
  auto given = given_names_of(arguments.signals);
  if (!given) return Failure{given.error()};
  const LineNames names(*std::move(given));
  const Nanoseconds from = std::llround(arguments.from * 1e9);
  SignalsToRead what{.wanted = [&](std::string_view name) { return names.line_of(std::string(name)).has_value(); },
                     .most_changes = most_changes};
  if (arguments.time) what.until = std::llround(*arguments.time * 1e9) - from;
  if (what.until <= 0) {
    return Failure{
        fmt::format("--input: the recording would begin at {} s (--from), after the end of the run at {} s (--time)",
                    arguments.from, *arguments.time)};
  }
  auto signals = read_signals(arguments.input, what);
  if (!signals) return Failure{signals.error()};
  auto lines = lines_by_name(arguments.input, *signals, names);
  if (!lines) return Failure{lines.error()};
  FollowerRecording recording{.lines = {}, .end = from + signals->end};
  for (const char axis : {'x', 'y', 'z'}) {
    Changes& clock = (*lines)[std::string("clock.") + axis];
    lead_directions((*lines)[std::string("direction.") + axis], clock);
    lengthen_pulses(clock, std::llround(arguments.pulse * 1e3));
  }
  for (const auto& [line, changes] : *lines) {
    if (line.starts_with("key.") && !changes.empty()) recording.has_keys = true;
    for (const SignalChange& change : changes) {
      if (line != "reset" || change.high) recording.lines.push_back({from + change.at, line, change.high});
    }
  }
  std::ranges::stable_sort(recording.lines, {}, &LineChange::at);
  return recording;
}

std::string compared_steps(std::string_view follower, const std::vector<LineChange>& lines, const FollowerRun& run) {
  const Excitation drive = drive_of(follower);
  std::string text =
      fmt::format("{:>5}  {:>9}  {:>9}  {:>9}  {:>9}\n", "motor", "pulses up", "down", "steps up", "down");
  bool some_lost = false;
  for (const char axis : {'x', 'y', 'z'}) {
    const Travel pulses = pulses_of(lines, axis);
    const Travel steps = steps_of(run, drive, axis);
    if (pulses.up + pulses.down + steps.up + steps.down == 0) continue;
    const bool agrees = pulses.up == steps.up && pulses.down == steps.down;
    some_lost = some_lost || !agrees;
    text += fmt::format("{:>5}  {:>9}  {:>9}  {:>9}  {:>9}{}\n", static_cast<char>(axis - 'x' + 'X'), pulses.up,
                        pulses.down, steps.up, steps.down, agrees ? "" : "  differ");
  }
  if (some_lost) {
    text += fmt::format(
        "The shortest level of a clock line lasts {} us. docs/follower.md says how long {} needs to see it; "
        "--pulse lengthens pulses.\n",
        sensible_number(shortest_level(lines)), follower);
  }
  return text;
}

}  // namespace passo
