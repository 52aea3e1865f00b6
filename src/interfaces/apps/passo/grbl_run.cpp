#include "grbl_run.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include "from_line.hpp"
#include "grbl_check.hpp"
#include "grbl_machine_connection.hpp"
#include "grbl_time_left.hpp"
#include "machine_connection.hpp"
#include "operator_prompt.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include "run_signals.hpp"
#include "tool_life.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/placed_tool_change.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/base/counted.hpp"
#include "passo/job/job_end.hpp"
#include "passo/link/await.hpp"
#include "passo/session/confirmed_place.hpp"

namespace passo {
namespace {

// The place of a simulated machine is counted; that of a Grbl machine is what it reports.
std::vector<double> place_of(const MachineSession& session, const MachineDescription& machine) {
  std::vector<double> place;
  for (const AxisDescription& axis : machine.axes) place.push_back(session.status().now_at[axis.axis]);
  return place;
}

// Homes the machine. Returns false, with a message and `code`, on failure.
bool home_first(GrblMachineConnection& opened, const std::string& board, std::optional<Axis> axis, int& code) {
  GrblMachineSession& session = opened.session();
  const auto ticket = session.request(request::Home{axis});
  Answered answered{.outcome = Outcome::failed};
  if (ticket) {
    opened.poll_until_done();
    answered = answer_of(session.take_changes(), *ticket);
  } else {
    answered.refused = ticket.error();
  }
  if (answered.outcome == Outcome::done) return true;
  const std::string words = answered.refused  ? describe(*answered.refused)
                            : session.fault() ? describe(*session.fault(), "")
                                              : answered.message();
  code = interrupted_by() != 0 ? exit_of_signal() : fail(exit_failed, fmt::format("{}: {}", board, words));
  return false;
}

// Returns whether the machine is idle and not locked; if not, with a message and `code`.
bool make_ready(GrblMachineConnection& opened, const RunArguments& arguments, int& code) {
  if (arguments.home && !home_first(opened, arguments.board, std::nullopt, code)) return false;
  if (!opened.session().is_locked()) return true;
  const std::string alarm = opened.session().sender().alarm_words();
  code = fail(exit_failed, fmt::format("{}: the machine is locked by an alarm{}{}{}. Home it with --home, or unlock "
                                       "it at its position with $X from another sender [grbl.locked]",
                                       arguments.board, alarm.empty() ? "" : " (", alarm, alarm.empty() ? "" : ")"));
  return false;
}

// Of each axis that the board has.
nlohmann::ordered_json place_json(const GrblMachineSession& session) {
  const Point place = session.sender().place().value_or(Point());
  nlohmann::ordered_json json;
  for (const char letter : session.board().axes) {
    if (const auto axis = axis_of(letter)) json[std::string(1, letter)] = place[*axis];
  }
  return json;
}

// `moves`: of the whole program. `trouble`: why it ended before its end; empty: it did not.
void print_json(Seconds time, const RunArguments& arguments, const GrblMachineSession& session, std::uint64_t moves,
                const std::string& trouble) {
  const GrblMachine& board = session.board();
  nlohmann::ordered_json all = {
      {"program", arguments.program.program},
      {"grbl",
       {{"firmware", board.firmware}, {"version", board.version}, {"receive_buffer", session.sender().buffer_size()}}},
      {"moves", moves},
      {"lines", session.lines_of_program()},
      {"time_s", time.value()},
      {"position_mm", place_json(session)},
      {"completed", trouble.empty()}};
  if (!trouble.empty()) all["trouble"] = trouble;
  if (!trouble.empty()) all["interrupted"] = interrupted_by() != 0;
  fmt::print("{}\n", all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print(Seconds time, const RunArguments& arguments, GrblMachineConnection& opened, const ProgramCheck& check) {
  const GrblMachineSession& session = opened.session();
  const GrblMachine& board = session.board();
  if (arguments.json) {
    print_json(time, arguments, session, check.moves, "");
  } else if (!arguments.quiet) {
    fmt::print(
        "{}: {} in {}, {:.1f} s; stopped at {} (machine). Steps were not counted, because {} {} does not report them\n",
        arguments.program.program, counted(check.moves, "move"), counted(session.lines_of_program(), "line"),
        time.value(), place_words(opened.session().sender()), board.firmware, board.version);
  }
}

// `time`: of the motion so far.
int end_broken_off(const RunArguments& arguments, GrblMachineConnection& opened, const Answered& answered, Seconds time,
                   std::uint64_t moves) {
  const GrblMachineSession& session = opened.session();
  std::string words = interrupted_by() != 0 ? "interrupted" : "held";
  if (session.fault()) {
    words = describe(*session.fault(), arguments.program.program);
  } else if (answered.refused) {
    words = describe(*answered.refused);
  } else if (answered.fault && answered.fault->fault == MachineFault::program_waits && interrupted_by() == 0) {
    words = filled(
        "{program} waits at {wait}, but there is no terminal to ask the operator: run it in a terminal, or with --yes "
        "when everything is prepared [run.waits]",
        answered.fault->arguments);
  } else if (answered.fault && interrupted_by() == 0) {
    words = fmt::format("{} [{}]", answered.fault->message(), answered.fault->code());
  }
  if (arguments.json) print_json(time, arguments, session, moves, words);
  const auto& report = session.sender().report();
  // The report may be from before the brake, if the machine has not answered any more.
  const int failed =
      fail(exit_failed, fmt::format("{}; the machine was last in state {} at {} (machine coordinates). A Grbl machine "
                                    "cannot resume exactly where it stopped: start at a line with --from-line",
                                    words, report ? report->state : "unknown", place_words(opened.session().sender())));
  return interrupted_by() != 0 ? exit_of_signal() : failed;
}

// Runs a program that was checked. Returns the exit code.
int stream(const RunArguments& arguments, GrblMachineConnection& opened, const MachineDescription& machine,
           request::Start start, const ProgramCheck& check, GrblTimeLeft& time_left, ScheduledChanges& changes,
           CutRecorder* cuts) {
  GrblMachineSession& session = opened.session();
  Diagnostics late;
  start.findings = &late;
  ProgressDisplay progress(arguments.program.program, !arguments.quiet);
  ProgramMessages messages(arguments.program.program, !arguments.quiet);
  start.watchers.operations = [&](const Operation& operation) { messages.show(operation, [&] { progress.clear(); }); };
  std::optional<Seconds> begun;
  start.watchers.path = [&](const PathItem&) {
    if (begun) return;
    begun = session.now();
    changes.begin(*begun);
  };
  if (cuts != nullptr) cuts->begin(start, "");
  OperatorPrompt prompt(arguments.program.program);
  Answered answered{.outcome = Outcome::failed};
  const auto ticket = session.request(std::move(start));
  if (!ticket) answered.refused = ticket.error();
  while (session.busy()) {
    const Seconds most = begun ? changes.act(session, [&] { return place_of(session, machine); }) : endless;
    opened.poll(std::min({most, GrblMachineSession::between_looks, prompt.poll(session)}));
    if (cuts != nullptr) cuts->poll(session.now().value());
    const MachineStatus status = session.status();
    if (status.progress) progress.update(*status.progress, time_left.left(status));
  }
  if (ticket) answered = answer_of(session.take_changes(), *ticket);
  end_cuts(cuts);
  if (prompt.gave_up()) answered = {.outcome = Outcome::failed, .fault = prompt.fault()};
  progress.clear();
  if (answered.outcome == Outcome::done) {
    print(session.now() - begun.value_or(session.now()), arguments, opened, check);
    return exit_done;
  }
  if (!session.fault()) show(late);
  return end_broken_off(arguments, opened, answered, session.now() - begun.value_or(session.now()), check.moves);
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
                InterpreterOptions options, ScheduledChanges& changes) {
  if (!leaves_spindle_to_grbl(machine)) return exit_bad_machine;
  int code = exit_done;
  brake_on_signals();
  const Seconds ahead(arguments.ahead.value_or(GrblSender::default_ahead.value()));
  const auto opened = GrblMachineConnection::open(arguments.board, machine, ahead, code);
  if (!opened || !make_ready(*opened, arguments, code)) return code;
  const GrblMachineSession& session = opened->session();
  if (const auto& objection = session.match().objection) {
    return fail(exit_failed, fmt::format("{}: {} [{}]", arguments.board, objection->text, objection->code));
  }
  options.start = session.status().position.place;
  set_offsets(options, session.board());
  Diagnostics findings;
  bool has_unplaced_change = false;
  auto lives = read_lives(arguments.program.tool_life, code);
  if (!lives) return code;
  CutForecast forecast(motion_limits(machine), std::move(*lives));
  const bool is_confirmed = is_place_confirmed(session);
  const ProgramCheck check = check_for_grbl(
      program, machine, options, GrblTarget::of(session.board()), findings,
      [&](const PathItem& item) { forecast.add(item); },
      [&](const Operation& operation) {
        if (!is_confirmed && is_placed_tool_change(operation, machine)) has_unplaced_change = true;
      });
  if (check.good) forecast.add_findings(arguments.program.program, findings);
  show(findings);
  if (!check.good) return exit_bad_program;
  if (has_unplaced_change) {
    const Sentence why = sentence_of_unplaced_tool_change();
    return fail(exit_failed, fmt::format("{}: {}. Use --home [{}]", arguments.board, why.text, why.code));
  }
  if (!arguments.quiet)
    note("the program starts at " + place_words(opened->session().sender()) +
         " (machine coordinates), with the offsets of the machine");
  const auto address = parse_board_address(arguments.board);
  const double rate = address ? grbl_bytes_per_second(*address, session.board()) : 0;
  GrblTimeLeft time_left(program.again(), machine, options, grbl_timing_of(session.board(), rate), check.nominal_time);
  request::Start start{.program = program.again(),
                       .options = options,
                       .nominal_time = check.nominal_time,
                       .waits_for_operator = !arguments.yes};
  if (arguments.start.line > 0) {
    const auto way = way_to_line(arguments, program, machine, options, code);
    if (!way) return code;
    start.from = way->at;
    start.lead_in = way->lead_in;
  }
  CountedCuts cuts;
  if ((code = cuts.open(arguments.program.tool_life, arguments.board)) != exit_done) return code;
  return stream(arguments, *opened, machine, std::move(start), check, time_left, changes, cuts.recorder());
}

int home_grbl(const HomeArguments& arguments, const MachineDescription& machine) {
  if (arguments.repeat > 1) {
    return fail(exit_bad_program,
                "--repeat is not possible with Grbl, which does not report where its switches closed [grbl.cannot]");
  }
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblMachineConnection::open(arguments.board, machine, GrblSender::default_ahead, code);
  if (!opened) return code;
  const std::optional<Axis> axis =
      arguments.axis.empty() ? std::nullopt : axis_of(static_cast<char>(std::toupper(arguments.axis.front())));
  const Seconds begun = opened->session().now();
  if (!home_first(*opened, arguments.board, axis, code)) return code;
  const double time = (opened->session().now() - begun).value();
  if (arguments.json) {
    const nlohmann::ordered_json all = {
        {"homed", true}, {"time_s", time}, {"position_mm", place_json(opened->session())}};
    fmt::print("{}\n", all.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("homed in {:.1f} s; stopped at {} (machine)\n", time, place_words(opened->session().sender()));
  }
  return exit_done;
}

}  // namespace passo
