// passo jog: axes of the virtual machine moved by hand, for as long as the lease is renewed.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/jog_line.hpp"
#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// A lease has to be longer than what is committed; and who does not renew one for so long is not there.
constexpr double shortest_lease = 0.1;
constexpr double longest_lease = 10;

// What the words "X+10 Y-3" or "X+ Y-" ask for.
struct JogWords {
  Point way;
  bool is_endless = false;
};

// Nothing where a word is none.
std::optional<JogWords> read_words(const std::vector<std::string>& texts, const MachineDescription& machine) {
  JogWords words;
  AxisSet given;
  int endless = 0;
  for (const std::string& text : texts) {
    const std::optional<Axis> axis = text.empty() ? std::nullopt : axis_of(text[0]);
    const auto is_it = [&](const AxisDescription& description) { return description.axis == axis; };
    if (!axis || std::ranges::none_of(machine.axes, is_it) || given.has(*axis)) return std::nullopt;
    given.add(*axis);
    std::string_view value = std::string_view(text).substr(1);
    if (value == "+" || value == "-") {
      words.way[*axis] = value == "+" ? 1 : -1;
      ++endless;
      continue;
    }
    if (value.starts_with('+')) value.remove_prefix(1);
    double& way = words.way[*axis];
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), way);
    const bool is_number = error == std::errc() && end == value.data() + value.size() && std::isfinite(way);
    if (value.empty() || !is_number) return std::nullopt;
  }
  words.is_endless = endless > 0;
  const bool mixed = words.is_endless && endless != static_cast<int>(texts.size());
  return mixed || !(length_of(words.way) > 0) ? std::nullopt : std::optional(words);
}

// By the steps that the motors made.
Point place_of(const VirtualMachine& machine, const MachineDescription& description) {
  const MachineCounts counts = machine.counts();
  Point place;
  for (std::size_t m = 0; m < description.axes.size(); ++m) {
    const AxisDescription& axis = description.axes[m];
    const auto steps = static_cast<double>(counts.motors[m].position);
    place[axis.axis] = (axis.inverted ? -steps : steps) / axis.steps_per_unit;
  }
  return place;
}

struct Ending {
  Point place;
  Seconds time{0};
  const char* why = "";  // distance, travel or lease
};

Ending jog_to_rest(const MachineDescription& description, const JogWords& words, const JogArguments& arguments) {
  VirtualMachine machine(static_cast<std::uint8_t>(description.axes.size()), description.board.clock,
                         description.board.highest_event_rate);
  const JogRequest request{.direction = words.way,
                           .speed = MmPerSecond(arguments.feed / seconds_per_minute),
                           .distance = Mm(words.is_endless ? 0 : length_of(words.way)),
                           .lease = Seconds(arguments.lease)};
  Jog jog(description, machine, Point(), request);
  while (jog.advance()) {
    if (!arguments.held || jog.drive().now() < Seconds(*arguments.held)) jog.renew();
  }
  constexpr double rounding = 1e-6;
  const bool is_there = distance(jog.place(), jog.target()) < rounding;
  const bool is_all = !words.is_endless && distance(jog.place(), words.way) < rounding;
  return {.place = place_of(machine, description),
          .time = jog.drive().now(),
          .why = is_all     ? "distance"
                 : is_there ? "travel"
                            : "lease"};
}

std::string_view in_words(std::string_view why) {
  if (why == "distance") return "the distance is done";
  return why == "travel" ? "the travel ends there" : "the lease was not renewed";
}

void print(const Ending& ending, const MachineDescription& machine, bool json) {
  if (json) {
    nlohmann::ordered_json place = nlohmann::ordered_json::object();
    for (const AxisDescription& axis : machine.axes) place[std::string{letter_of(axis.axis)}] = ending.place[axis.axis];
    const nlohmann::ordered_json all = {
        {"time_s", ending.time.value()}, {"ended_by", ending.why}, {"position_mm", place}};
    fmt::print("{}\n", all.dump(2));
    return;
  }
  fmt::print("at rest after {:.3f} s in", ending.time.value());
  for (const AxisDescription& axis : machine.axes)
    fmt::print(" {}{:.3f}", letter_of(axis.axis), ending.place[axis.axis]);
  fmt::print(" (machine): {}\n", in_words(ending.why));
}

}  // namespace

int jog(const JogArguments& arguments) {
  Diagnostics diagnostics;
  const std::optional<MachineDescription> machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  const std::optional<JogWords> words = read_words(arguments.moves, *machine);
  if (!words) {
    return fail(exit_bad_program,
                "expected axes that the machine has, each once and all with a distance (X+10 Y-3) or all without "
                "(X+ Y-: as far as the travel goes)");
  }
  if (!(std::isfinite(arguments.feed) && arguments.feed > 0)) {
    return fail(exit_bad_program, fmt::format("-F must be above 0 mm/min, not {:g}", arguments.feed));
  }
  if (!(arguments.lease >= shortest_lease && arguments.lease <= longest_lease)) {
    return fail(exit_bad_program, fmt::format("--lease must be {:g} to {:g} s, not {:g}", shortest_lease, longest_lease,
                                              arguments.lease));
  }
  if (arguments.held && !(std::isfinite(*arguments.held) && *arguments.held >= 0)) {
    return fail(exit_bad_program, fmt::format("--held must be 0 s or more, not {:g}", *arguments.held));
  }
  print(jog_to_rest(*machine, *words, arguments), *machine, arguments.json);
  return std::fflush(stdout) == 0 ? exit_done : fail(exit_failed, "cannot write to standard output");
}

}  // namespace passo
