// passo follower sim: a follower's image in its chip's emulator, fed with pulses and keys. What the windings, the relay
// and the LEDs do comes out as a table, as a trace or as a picture.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "board_opening.hpp"
#include "commands.hpp"
#include "follower_recording.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/emulator/emulated_follower.hpp"
#include "passo/report/signals.hpp"

namespace passo {
namespace {

constexpr double shortest_press = 0.1;  // s: longer than a contact must be steady
constexpr std::size_t most_changes = 2'000'000;

Nanoseconds nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

std::optional<double> seconds_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0) || value > 3600) return {};
  return value;
}

// "NAME@FROM" or "NAME@FROM:TO".
struct Held {
  std::string name;
  double from = 0;
  std::optional<double> to = {};
};
std::optional<Held> held_of(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos) return {};
  const std::string_view times = std::string_view(text).substr(at + 1);
  const std::size_t colon = times.find(':');
  const auto from = seconds_of(times.substr(0, colon));
  if (!from) return {};
  if (colon == std::string_view::npos) return Held{text.substr(0, at), *from};
  const auto to = seconds_of(times.substr(colon + 1));
  if (!to || *to <= *from) return {};
  return Held{text.substr(0, at), *from, *to};
}

void hold(std::vector<LineChange>& lines, const Held& held, const std::string& line) {
  lines.push_back({nanoseconds(held.from), line, true});
  if (held.to) lines.push_back({nanoseconds(*held.to), line, false});
}

bool is_line(const std::string& name) {
  const std::set<std::string> names = {"clock.x",     "clock.y", "clock.z", "direction.x", "direction.y",
                                       "direction.z", "relay",   "button",  "reset"};
  return names.contains(name);
}

// The axes of "XZ", in small letters.
std::optional<std::string> axes_of(const std::string& text) {
  std::string axes;
  for (const char letter : text) axes += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (axes.find_first_not_of("xyz") != std::string::npos) return {};
  return axes;
}

// A line that is held more than once at a time goes on with the first, and off with the last.
void merge(std::vector<LineChange>& lines) {
  std::map<std::string, int> holds;
  std::erase_if(lines, [&](const LineChange& change) {
    if (change.line == "reset") return false;
    return change.high ? ++holds[change.line] > 1 : --holds[change.line] > 0;
  });
}

using Lines = Result<std::vector<LineChange>, std::string>;

// What people and the machine do, and after it the pulses. `has_keys`: a recording presses keys.
Lines held_lines_of(const FollowerArguments& arguments, bool has_keys) {
  std::vector<LineChange> lines;
  const std::string no_keypad = "an Uno has no pins for a keypad and a tool button (docs/follower.md)";
  if (!arguments.keys.empty() && !has_keypad(arguments.follower)) return Failure{"--key: " + no_keypad};
  for (const std::string& text : arguments.keys) {
    auto held = held_of(text);
    if (!held || key_place("key." + held->name).row < 0) {
      return Failure{text + ": expected KEY@FROM or KEY@FROM:TO in seconds, e.g. 6@0.5:0.9; keys are 0 to 9, * and #"};
    }
    if (!held->to) held->to = held->from + shortest_press;
    hold(lines, *held, "key." + held->name);
  }
  const bool waits = arguments.follower.starts_with("first_board");
  const auto is_mode_key = [](const std::string& key) { return key.starts_with('*') || key.starts_with('#'); };
  if (waits && !has_keys && std::ranges::none_of(arguments.keys, is_mode_key))
    hold(lines, {.name = "*", .from = 0.05, .to = 0.05 + shortest_press}, "key.*");
  for (const std::string& text : arguments.lines) {
    auto held = held_of(text);
    if (held && held->name == "reset") held->to.reset();  // over at once
    if (!held || !is_line(held->name)) {
      return Failure{text +
                     ": expected LINE@FROM or LINE@FROM:TO in seconds; lines are clock.x, direction.x (also y, z), "
                     "relay, button and reset"};
    }
    if (held->name == "button" && !has_keypad(arguments.follower)) return Failure{"--line: " + no_keypad};
    hold(lines, *held, held->name);
  }
  return lines;
}

// The pulses of --clock.
Status<std::string> add_pulses(const FollowerArguments& arguments, double time, std::vector<LineChange>& lines) {
  const auto axes = axes_of(arguments.axes);
  const auto down = axes_of(arguments.down);
  if (!axes || !down) return Failure{std::string("--axes, --down: expected letters of XYZ")};
  for (const char axis : *down) lines.push_back({0, std::string("direction.") + axis, true});
  if (arguments.clock <= 0) return Unit{};
  if (arguments.from >= time) {
    return Failure{
        fmt::format("--clock: the first pulse would come at {} s (--from), after the end of the run at {} s (--time)",
                    arguments.from, time)};
  }
  const auto pulses = static_cast<std::int64_t>(std::ceil((time - arguments.from) * arguments.clock));
  if (pulses * 2 * std::ssize(*axes) > std::int64_t{most_changes}) {
    return Failure{fmt::format("more than {} edges: choose a lower --clock or a shorter --time", most_changes)};
  }
  for (std::int64_t pulse = 0; pulse < pulses; ++pulse) {
    const double begin = arguments.from + static_cast<double>(pulse) / arguments.clock;
    for (const char axis : *axes) {
      hold(lines, {.name = {}, .from = begin, .to = begin + 0.5 / arguments.clock}, std::string("clock.") + axis);
    }
  }
  return Unit{};
}

// All that goes in, and the end of the run.
struct Played {
  std::vector<LineChange> lines = {};
  Nanoseconds end = 0;
};
Result<Played, std::string> played_by(const FollowerArguments& arguments) {
  constexpr Nanoseconds after_recording = 100'000'000;
  constexpr Nanoseconds longest = 600'000'000'000;
  FollowerRecording recording;
  if (!arguments.input.empty()) {
    auto read = read_follower_recording(arguments, most_changes);
    if (!read) return Failure{read.error()};
    recording = *std::move(read);
    if (!arguments.time && recording.end > longest - after_recording) {
      return Failure{
          fmt::format("--input: {} lasts {:.1f} s; a run lasts at most 600 s: play its beginning with --time",
                      arguments.input, static_cast<double>(recording.end) * 1e-9)};
    }
  }
  Lines held = held_lines_of(arguments, recording.has_keys);
  if (!held) return Failure{held.error()};
  Played played{.lines = *std::move(held), .end = nanoseconds(arguments.time.value_or(1))};
  if (!arguments.input.empty() && !arguments.time) played.end = recording.end + after_recording;
  const Status<std::string> pulses = add_pulses(arguments, static_cast<double>(played.end) * 1e-9, played.lines);
  if (!pulses) return Failure{pulses.error()};
  played.lines.insert(played.lines.end(), recording.lines.begin(), recording.lines.end());
  std::ranges::stable_sort(played.lines, {}, &LineChange::at);
  merge(played.lines);
  return played;
}

std::string heading_of(const std::string& output) {
  if (output.starts_with("windings.")) return std::string(1, static_cast<char>(output.back() - 'x' + 'X')) + " F1-F4";
  if (output.starts_with("indicator.")) return output == "indicator.relay" ? "tool LED" : output.substr(10) + " LED";
  if (output.starts_with("led.")) return output == "led.0" ? "RB0" : "RD" + output.substr(4);
  return output;
}

// A row for each time at which an output changes or a person presses or lets go something.
void print_table(const std::vector<std::string>& outputs, const std::vector<LineChange>& lines,
                 const FollowerRun& run) {
  std::map<Nanoseconds, std::vector<const OutputChange*>> rows;
  std::map<Nanoseconds, std::vector<const LineChange*>> presses;
  rows[0];
  for (const OutputChange& change : run.changes) rows[change.at].push_back(&change);
  for (const LineChange& change : lines) {
    if (change.line.starts_with("clock.") || change.line.starts_with("direction.")) continue;
    rows[change.at];
    presses[change.at].push_back(&change);
  }
  std::map<std::string, std::string> values;
  std::set<std::string> down;
  std::string header = fmt::format("{:>11}", "time, s");
  for (const std::string& output : outputs) {
    values[output] = output.starts_with("windings.") ? "0000" : "0";
    header += fmt::format("  {}", heading_of(output));
  }
  fmt::print("{}  keys and lines\n", header);
  for (const auto& [at, changes] : rows) {
    for (const OutputChange* change : changes) values[change->output] = change->value;
    std::string reset;
    for (const LineChange* press : presses[at]) {
      const std::string name = press->line.starts_with("key.") ? press->line.substr(4) : press->line;
      if (name == "reset") {
        reset = " reset";
      } else if (press->high) {
        down.insert(name);
      } else {
        down.erase(name);
      }
    }
    std::string row = fmt::format("{:>11.6f}", static_cast<double>(at) * 1e-9);
    for (const std::string& output : outputs) {
      const bool winding = output.starts_with("windings.");
      const std::string shown = winding ? values[output] : values[output] == "1" ? "on" : "-";
      row += fmt::format("  {:<{}}", shown, heading_of(output).size());
    }
    row += fmt::format("  {}{}", fmt::join(down, " "), reset);
    fmt::print("{}\n", row.substr(0, row.find_last_not_of(' ') + 1));
  }
}

// In waves a name is a word: GTKWave takes * and # amiss.
std::string wave_name(const std::string& line) {
  if (line == "key.*") return "key_star";
  if (line == "key.#") return "key_hash";
  std::string name = line;
  std::ranges::replace(name, '.', '_');
  return name;
}

Signals signals_of(const std::vector<std::string>& outputs, const std::vector<LineChange>& lines,
                   const FollowerRun& run, Nanoseconds end) {
  Signals signals{.title = "follower", .signals = {}, .end = end};
  std::map<std::string, std::size_t> places;
  const auto signal = [&](const std::string& name) -> Signal& {
    const auto [place, is_new] = places.try_emplace(name, signals.signals.size());
    if (is_new) signals.signals.push_back({name});
    return signals.signals[place->second];
  };
  for (const LineChange& change : lines) {
    std::vector<SignalChange>& known = signal(wave_name(change.line)).changes;
    known.push_back({change.at, change.high});
    if (change.line == "reset") known.push_back({change.at + 1'000'000, false});  // over at once, but to be seen
  }
  const auto winding = [](const std::string& output, std::size_t f) {
    return fmt::format("{}_F{}", output.back(), f + 1);
  };
  for (const std::string& output : outputs) {
    if (!output.starts_with("windings.")) {
      signal(output == "relay" ? "relay_out" : wave_name(output));
      continue;
    }
    for (std::size_t f = 0; f < 4; ++f) signal(winding(output, f));
  }
  for (const OutputChange& change : run.changes) {
    if (!change.output.starts_with("windings.")) {
      const std::string name = change.output == "relay" ? "relay_out" : wave_name(change.output);
      signal(name).changes.push_back({change.at, change.value == "1"});
      continue;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      std::vector<SignalChange>& known = signal(winding(change.output, f)).changes;
      const bool high = change.value[f] == '1';
      if ((!known.empty() && known.back().high) != high) known.push_back({change.at, high});
    }
  }
  return signals;
}

int write_trace(const Signals& signals, const std::string& path) {
  auto file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  if (path.ends_with(".vcd")) {
    write_signals_vcd(signals, *file);
  } else {
    write_signals_csv(signals, *file);
  }
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// Lanes without any change say nothing.
int draw(const FollowerArguments& arguments, Signals signals) {
  std::erase_if(signals.signals, [](const Signal& one) { return one.changes.empty(); });
  if (signals.count_of_changes() > Signals::most_drawn_changes) {
    return fail(exit_bad_program, fmt::format("--picture: {} changes are too many to draw; at most {} are possible",
                                              signals.count_of_changes(), Signals::most_drawn_changes));
  }
  auto file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = *picture_format_of(arguments.picture),
                               .program = "Follower, " + arguments.follower,
                               .machine = "filled: the line is high, the winding carries current, the LED is lit"};
  Status<OutputError> done = draw_signals(signals, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int follower_sim(const FollowerArguments& arguments) {
  for (const std::string& path : arguments.traces) {
    if (!is_trace_name(path)) return fail(exit_bad_program, path + ": the name of a trace must end with .vcd or .csv");
  }
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  const auto played = played_by(arguments);
  if (!played) return fail(exit_bad_program, played.error());
  const std::vector<LineChange>& lines = played->lines;
  const std::filesystem::path image =
      arguments.image.empty() ? built_follower(arguments.follower) : std::filesystem::path(arguments.image);
  if (!std::filesystem::exists(image)) {
    return fail(exit_failed,
                arguments.image.empty() ? message_of_missing(image) : arguments.image + ": there is no such file");
  }
  const auto run = run_follower(arguments.follower, image, lines, played->end);
  if (!run) return fail(exit_failed, run.error());
  const std::vector<std::string> outputs = outputs_of_follower(arguments.follower);
  if (arguments.traces.empty() && arguments.picture.empty()) print_table(outputs, lines, *run);
  if (!arguments.input.empty()) fmt::print("{}", compared_steps(arguments.follower, lines, *run));
  const Signals signals = signals_of(outputs, lines, *run, played->end);
  for (const std::string& path : arguments.traces) {
    if (const int code = write_trace(signals, path); code != exit_done) return code;
  }
  return arguments.picture.empty() ? exit_done : draw(arguments, signals);
}

}  // namespace passo
