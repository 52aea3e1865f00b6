// passo jog: axes moved by hand, for as long as the lease is renewed, or a key is held.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "commands.hpp"
#include "grbl_connection.hpp"
#include "jog_keys.hpp"
#include "machine_connection.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include "stop_words.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "passo/geometry/euclid.hpp"
#include "passo/link/await.hpp"

namespace passo {
namespace {

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
    if (value.starts_with("+-")) return std::nullopt;
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

struct Ending {
  Point place;
  Seconds time{0};
  const char* why = "";      // distance, travel or lease
  bool is_known = true;      // the place counts from machine zero, and not from where the machine stood before
  std::string failure = {};  // why it failed, with the code; empty: it did not
};

// The button is held: the lease is renewed, and a real machine is looked at more often than that.
constexpr Seconds between_renewals{0.02};

// `is_real`: the time of the session is that of the world.
Ending jog_to_rest(MachineSession& session, bool is_real, const JogWords& words, const JogArguments& arguments) {
  const KnownPosition from = session.status().position;
  const JogWay way{.direction = words.way,
                   .speed = MmPerSecond(arguments.feed / seconds_per_minute),
                   .distance = Mm(words.is_endless ? 0 : length_of(words.way))};
  const Seconds begun = session.now();
  const auto ticket = session.request(request::Jog{.way = way, .lease = Seconds(arguments.lease)});
  if (!ticket) {
    Ending refused;
    refused.failure = describe(ticket.error());
    return refused;
  }
  bool brakes = false;
  while (session.busy()) {
    if (interrupted_by() != 0 && !std::exchange(brakes, true)) {
      try_request(session, request::Stop{});
    }
    const bool holds = !arguments.held || session.now() - begun < Seconds(*arguments.held);
    if (holds && !brakes) try_request(session, request::RenewKeepAlive{});
    session.poll(is_real ? between_renewals : endless);
  }
  const Answered answered = answer_of(session.take_changes(), *ticket);
  const MachineStatus status = session.status();
  constexpr double rounding = 1e-3;
  const bool is_all = !words.is_endless && distance(status.position.place, from.place + words.way) < rounding;
  return {.place = status.position.place,
          .time = session.now() - begun,
          .why = is_all                              ? "distance"
                 : answered.outcome == Outcome::done ? "travel"
                                                     : "lease",
          .is_known = status.position.trust != Trust::unknown,
          .failure = answered.fault ? fmt::format("{} [{}]", answered.fault->message(), answered.fault->code()) : ""};
}

std::string_view in_words(std::string_view why) {
  if (why == "distance") return "distance completed";
  return why == "travel" ? "end of the travel" : "the keep-alive timeout expired";
}

void print(const Ending& ending, const MachineDescription& machine, bool json) {
  if (json) {
    nlohmann::ordered_json place = nlohmann::ordered_json::object();
    for (const AxisDescription& axis : machine.axes) place[std::string{letter_of(axis.axis)}] = ending.place[axis.axis];
    const nlohmann::ordered_json all = {{"time_s", ending.time.value()},
                                        {"ended_by", ending.why},
                                        {"position_mm", place},
                                        {"place_known", ending.is_known}};
    fmt::print("{}\n", all.dump(2));
    return;
  }
  fmt::print("stopped after {:.3f} s at", ending.time.value());
  for (const AxisDescription& axis : machine.axes)
    fmt::print(" {}{:.3f}", letter_of(axis.axis), ending.place[axis.axis]);
  fmt::print(" ({}): {}\n",
             ending.is_known ? "machine" : "its position is unknown; coordinates are relative to its first position",
             in_words(ending.why));
}

// What is wrong with the arguments, beside the moves.
std::optional<std::string> wrong_numbers(const JogArguments& arguments) {
  if (!(std::isfinite(arguments.feed) && arguments.feed > 0)) {
    return fmt::format("-F must be above 0 mm/min, not {:g}", arguments.feed);
  }
  constexpr double shortest = request::Jog::shortest_lease.value();
  constexpr double longest = request::Jog::longest_lease.value();
  if (!(arguments.lease >= shortest && arguments.lease <= longest)) {
    return fmt::format("--lease must be {:g} to {:g} s, not {:g}", shortest, longest, arguments.lease);
  }
  if (arguments.held && !(std::isfinite(*arguments.held) && *arguments.held >= 0)) {
    return fmt::format("--held must be 0 s or more, not {:g}", *arguments.held);
  }
  return {};
}

// Without words: by keys.
int jog_on_grbl(const JogArguments& arguments, const MachineDescription& machine,
                const std::optional<JogWords>& words) {
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblMachineConnection::open(arguments.board, machine, GrblSender::default_ahead, code);
  if (!opened) return code;
  GrblMachineSession& session = opened->session();
  if (!words) return jog_by_keys(session, true, machine, MmPerSecond(arguments.feed / seconds_per_minute));
  const Ending ending = jog_to_rest(session, true, *words, arguments);
  if (session.fault()) {
    return fail(exit_failed, fmt::format("{}: {}", arguments.board, describe(*session.fault(), "")));
  }
  if (!ending.failure.empty()) return fail(exit_failed, ending.failure);
  print(ending, machine, arguments.json);
  return interrupted_by() != 0 ? 128 + interrupted_by() : exit_done;
}

}  // namespace

int jog(const JogArguments& arguments) {
  Diagnostics diagnostics;
  const std::optional<MachineDescription> machine =
      load_machine_file(arguments.machine, diagnostics, use_with(arguments.board));
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  const bool by_keys = arguments.moves.empty() && is_terminal(STDIN_FILENO) && is_terminal(STDOUT_FILENO);
  const std::optional<JogWords> words = by_keys ? JogWords() : read_words(arguments.moves, *machine);
  if (!words) {
    return fail(exit_bad_program,
                "expected axes of the machine, each once, all with a distance (e.g. X+10 Y-3) or all without (e.g. X+ "
                "Y-, to the end of the travel); in a terminal none, to jog by keyboard");
  }
  if (const auto wrong = wrong_numbers(arguments)) return fail(exit_bad_program, *wrong);
  int code = exit_done;
  outlive_readers();
  if (names_grbl_machine(arguments.board)) return jog_on_grbl(arguments, *machine, by_keys ? std::nullopt : words);
  const auto opened = MachineConnection::open(*machine, {.board = arguments.board}, code);
  if (!opened) return code;
  brake_on_signals();
  if (!opened->greet(opened->any_greeting(), code)) return code;
  if (by_keys) {
    return jog_by_keys(opened->session(), opened->has_board(), *machine,
                       MmPerSecond(arguments.feed / seconds_per_minute));
  }
  const Ending ending = jog_to_rest(opened->session(), opened->has_board(), *words, arguments);
  if (opened->session().status().trouble == LinkError::stopped) {
    return fail(exit_failed, "the board: " + stop_words(*opened, *machine));
  }
  if (opened->session().status().trouble == LinkError::stood_still) {
    return fail(exit_failed, "the board: " + slip_words(*opened, *machine));
  }
  if (!ending.failure.empty()) return fail(exit_failed, ending.failure);
  if (const auto differs = opened->compare()) return fail(exit_failed, "the board: " + *differs);
  print(ending, *machine, arguments.json);
  return interrupted_by() != 0 ? 128 + interrupted_by() : exit_done;
}

}  // namespace passo
