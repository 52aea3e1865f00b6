#include "grbl_run.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "from_line.hpp"
#include "grbl_connection.hpp"
#include "operator_prompt.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/sender/grbl_program.hpp"

namespace passo {
namespace {

// Holds and overrides of the command line, at their times.
class TimedBytes {
 public:
  TimedBytes(const ScheduledChanges& changes, Seconds begun) : changes_(changes.all()), begun_(begun) {}
  // True: a hold has ended the run.
  bool look(GrblConnection& opened) {
    GrblSender& sender = opened.sender();
    const Seconds now = opened.now() - begun_;
    const bool rests = holds_ && sender.report() && sender.report()->state == "Hold" && sender.report()->detail <= 0;
    if (rests && ends_) return true;
    if (rests && !rested_) resume_at_ = now + pause_;
    rested_ = rested_ || rests;
    if (rested_ && now >= resume_at_) {
      sender.resume();
      holds_ = rested_ = false;
    }
    while (!holds_ && next_ < changes_.size() && changes_[next_].at <= now) {
      const auto& change = changes_[next_++];
      if (change.factor) {
        sender.override_feed(static_cast<int>(std::lround(*change.factor * 100)));
        continue;
      }
      sender.hold();
      holds_ = true;
      ends_ = !change.pause;
      pause_ = change.pause.value_or(Seconds(0));
    }
    return false;
  }

 private:
  const std::vector<ScheduledChanges::Change>& changes_;
  Seconds begun_;
  std::size_t next_ = 0;
  bool holds_ = false;
  bool ends_ = false;    // the hold ends the run
  bool rested_ = false;  // in the hold
  Seconds pause_{0};
  Seconds resume_at_{0};
};

// The machine is idle, in known modes. False, with a message and `code`.
bool make_ready(GrblConnection& opened, const std::string& board, bool homes, int& code) {
  GrblSender& sender = opened.sender();
  if (homes && !opened.home(code)) return false;
  if (sender.report()->state == "Alarm") {
    const std::string alarm = sender.alarm_words();
    code = fail(exit_failed, fmt::format("{}: the machine is locked by an alarm{}{}{}. Home it with --home, or unlock "
                                         "it at its position with $X from another sender [grbl.locked]",
                                         board, alarm.empty() ? "" : " (", alarm, alarm.empty() ? "" : ")"));
    return false;
  }
  for (const char* line : {"G21G90G94G17G40G49G54", "M5", "M9"}) sender.add(line);
  sender.ask_for_offsets();
  if (!opened.poll_until_rest()) {
    code = opened.give_up();
    return false;
  }
  if (sender.place()) return true;
  code = fail(exit_failed, board + ": the machine's status reports have no position; $10=1 adds it [grbl.no-place]");
  return false;
}

// The program is checked before anything moves.
ProgramCheck told_check(const ProgramReader& program, const MachineDescription& machine,
                        const InterpreterOptions& options, const GrblTarget& target) {
  Diagnostics findings;
  const ProgramCheck check = check_for_grbl(program, machine, options, target, findings);
  show(findings);
  return check;
}

// Gives the sender lines, as many as it wants, up to the next stop.
void feed(GrblSender& sender, GrblProgram& lines) {
  while (sender.wants_lines()) {
    const auto line = lines.next();
    if (!line) return;
    sender.add(line->text, line->line, line->silence);
  }
}

struct GrblRunResult {
  Seconds time{0};
  std::uint64_t lines = 0;
};

// Of each axis that the machine has.
nlohmann::ordered_json place_json(const GrblMachine& machine, const Point& place) {
  nlohmann::ordered_json json;
  for (const char letter : machine.axes) {
    if (const auto axis = axis_of(letter)) json[std::string(1, letter)] = place[*axis];
  }
  return json;
}

void print(const GrblRunResult& result, const RunArguments& arguments, const GrblConnection& opened,
           const ProgramCheck& check) {
  const Point place = opened.sender().place().value_or(Point());
  const GrblMachine& machine = opened.sender().machine();
  if (arguments.json) {
    const nlohmann::ordered_json all = {{"program", arguments.program.program},
                                        {"grbl",
                                         {{"firmware", machine.firmware},
                                          {"version", machine.version},
                                          {"receive_buffer", opened.sender().buffer_size()}}},
                                        {"moves", check.moves},
                                        {"lines", result.lines},
                                        {"time_s", result.time.value()},
                                        {"position_mm", place_json(machine, place)}};
    fmt::print("{}\n", all.dump(2));
  } else if (!arguments.quiet) {
    fmt::print(
        "{}: {} in {}, {:.1f} s; stopped at {} (machine). Steps were not counted, because {} {} does not report them\n",
        arguments.program.program, counted(check.moves, "move"), counted(result.lines, "line"), result.time.value(),
        opened.place_words(), machine.firmware, machine.version);
  }
}

// `waits`: the stop at which nobody can be asked, if there is one.
int end_broken_off(const RunArguments& arguments, GrblConnection& opened, const std::optional<OperatorWait>& waits) {
  const GrblSender& sender = opened.sender();
  std::string words = interrupted_by() != 0 ? "interrupted" : "held";
  if (sender.fault()) {
    words = describe(*sender.fault(), arguments.program.program);
  } else if (waits && interrupted_by() == 0) {
    words = fmt::format(
        "{} waits at {}, but there is no terminal to ask the operator: run it in a terminal, or with --yes when "
        "everything is prepared [run.waits]",
        arguments.program.program, describe(*waits));
  }
  // The report may be from before the brake, if the machine has not answered any more.
  const int failed =
      fail(exit_failed, fmt::format("{}; the machine was last in state {} at {} (machine coordinates). A Grbl machine "
                                    "cannot resume exactly where it stopped: start at a line with --from-line",
                                    words, sender.report()->state, opened.place_words()));
  return interrupted_by() != 0 ? exit_of_signal() : failed;
}

int stream(const RunArguments& arguments, GrblConnection& opened, GrblProgram& lines, const ProgramCheck& check,
           const ScheduledChanges& changes) {
  GrblSender& sender = opened.sender();
  ProgressDisplay progress(arguments.program.program, !arguments.quiet);
  ProgramMessages messages(arguments.program.program, !arguments.quiet);
  lines.hear([&](const Operation& operation) { messages.show(operation, [&] { progress.clear(); }); });
  OperatorPrompt prompt(arguments.program.program);
  const Seconds begun = opened.now();
  const std::uint64_t lines_before = sender.lines_sent();
  TimedBytes timed(changes, begun);
  while (!(lines.ended() && !lines.stop() && sender.at_rest()) && !sender.stopped()) {
    feed(sender, lines);
    opened.poll(GrblConnection::between_looks);
    if (interrupted_by() != 0 || timed.look(opened)) sender.stop();
    if (const std::string_view wait = opened.news_of_wait(); !wait.empty()) {
      progress.clear();
      note(std::string(wait));
    }
    if (check.nominal_time > Seconds(0)) progress.update(std::min(1.0, lines.nominal_time() / check.nominal_time));
    if (!lines.stop() || !sender.at_rest()) continue;
    progress.clear();
    if (!asks_operator()) {
      sender.stop();
    } else if (prompt.hears_enter(*lines.stop())) {
      prompt = OperatorPrompt(arguments.program.program);
      lines.go_on();
    }
  }
  progress.clear();
  if (sender.stopped() || sender.fault()) return end_broken_off(arguments, opened, lines.stop());
  print({.time = opened.now() - begun, .lines = sender.lines_sent() - lines_before}, arguments, opened, check);
  return exit_done;
}

}  // namespace

bool suits_grbl(const RunArguments& arguments) {
  const char* words = nullptr;
  if (arguments.resume || !arguments.journal.empty()) {
    words =
        "--resume and --journal are not possible with Grbl, which does not report step counts; start at a line with "
        "--from-line [grbl.cannot]";
  } else if (arguments.from_here) {
    words =
        "--from-here is not possible with Grbl, which keeps its own position: home the machine, or set its work zero "
        "[grbl.cannot]";
  } else if (arguments.start.pass > 0 || arguments.start.after > 0) {
    words =
        "--pass and --after are not possible with Grbl, which can only start at a line that runs once [grbl.cannot]";
  } else if (!arguments.pictures.empty() || !arguments.traces.empty() || !arguments.report.empty() ||
             !arguments.log.empty()) {
    words =
        "--picture, --trace, --report and --log are not possible with Grbl, which plans its own motion; use passo run "
        "without --board for them [grbl.cannot]";
  } else if (!arguments.changes.adaptive_feed.empty()) {
    words = "--adaptive-feed is not possible with Grbl, which does not know M52; use --override [grbl.cannot]";
  }
  if (words != nullptr) fail(exit_bad_program, words);
  return words == nullptr;
}

int run_on_grbl(const RunArguments& arguments, const MachineDescription& machine, ProgramReader program,
                InterpreterOptions options, const ScheduledChanges& changes) {
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblConnection::open(arguments.board, code);
  if (!opened || !make_ready(*opened, arguments.board, arguments.home, code)) return code;
  const GrblSender& sender = opened->sender();
  options.start = *sender.place();
  set_offsets(options, sender.machine());
  const GrblTarget target = GrblTarget::of(sender.machine());
  const ProgramCheck check = told_check(program, machine, options, target);
  if (!check.good) return exit_bad_program;
  if (!arguments.quiet)
    note("the program starts at " + opened->place_words() + " (machine coordinates), with the offsets of the machine");
  GrblProgram lines(program, machine, options, target, !arguments.yes);
  if (arguments.start.line > 0) {
    const auto way = way_to_line(arguments, program, machine, options, code);
    if (!way) return code;
    lines.begin_at(*way);
  }
  opened->sender().follow(target.zero, Seconds(arguments.ahead.value_or(GrblSender::default_ahead.value())));
  return stream(arguments, *opened, lines, check, changes);
}

int home_grbl(const HomeArguments& arguments) {
  if (arguments.repeat > 1) {
    return fail(exit_bad_program,
                "--repeat is not possible with Grbl, which does not report where its switches closed [grbl.cannot]");
  }
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblConnection::open(arguments.board, code);
  if (!opened) return code;
  const Seconds begun = opened->now();
  const std::optional<Axis> axis =
      arguments.axis.empty() ? std::nullopt : axis_of(static_cast<char>(std::toupper(arguments.axis.front())));
  if (!opened->home(code, axis)) return code;
  const Point place = opened->sender().place().value_or(Point());
  const double time = (opened->now() - begun).value();
  if (arguments.json) {
    const nlohmann::ordered_json all = {
        {"homed", true}, {"time_s", time}, {"position_mm", place_json(opened->sender().machine(), place)}};
    fmt::print("{}\n", all.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("homed in {:.1f} s; stopped at {} (machine)\n", time, opened->place_words());
  }
  return exit_done;
}

}  // namespace passo
