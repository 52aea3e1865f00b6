// passo run: checks the program, runs it on the machine, and writes the files that were asked for.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "board_summary.hpp"
#include "commands.hpp"
#include "disturb_option.hpp"
#include "from_line.hpp"
#include "grbl_connection.hpp"
#include "grbl_run.hpp"
#include "homing_run.hpp"
#include "link_delay.hpp"
#include "link_monitor.hpp"
#include "machine_connection.hpp"
#include "motor_watch.hpp"
#include "operator_prompt.hpp"
#include "port_run.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include "resumable_run.hpp"
#include "run_arguments.hpp"
#include "run_outputs.hpp"
#include "run_signals.hpp"
#include "scheduled_changes.hpp"
#include "stop_words.hpp"
#include "tool_life.hpp"
#include "touch_option.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/geometry/euclid.hpp"
#include "passo/job/cut_recorder.hpp"
#include "passo/journal/path_fingerprint.hpp"
#include "passo/link/await.hpp"
#include "passo/report/link_peak_rate.hpp"
#include "passo/report/summary.hpp"
#include "passo/report/summary_builder.hpp"

namespace passo {
namespace {

// The clock for the progress line is read once in so many turns.
constexpr unsigned turns_between_looks = 1024;

void stop(BoardMachineSession& session) {
  try_request(session, request::Stop{});
}

// Tells how often the board had to brake by itself.
void tell_tails(const BoardMachineSession& session) {
  const int rests = session.ledger()->recoveries();
  if (rests == 0) return;
  fmt::print(
      stderr,
      "passo: motion reached the board too late, {}: the machine stopped on the path, and continued from there\n",
      rests == 1 ? "once" : fmt::format("{} times", rests));
}

// A board that cannot make its events in time lets the motors stand still amid motion, without braking. The time up to
// the rest counts all standstills.
void note_slip(RunSummary& summary, MachineConnection& opened, const MachineDescription& machine,
               const LatestMotion& motion, Seconds began) {
  if (opened.session().status().trouble != LinkError::stood_still) return;
  summary.board->stood_still = true;
  summary.board->stood_still_line = line_of_standstill(opened, machine, motion);
  summary.board->end = opened.session().now() - began;
  summary.board->without_line.reset();
}

std::vector<Axis> axes_of(const MachineDescription& machine) {
  std::vector<Axis> axes;
  for (const AxisDescription& axis : machine.axes) axes.push_back(axis.axis);
  return axes;
}

std::vector<double> along(const MachineDescription& machine, const Point& place) {
  std::vector<double> values;
  for (const AxisDescription& axis : machine.axes) values.push_back(place[axis.axis]);
  return values;
}

void count(const ProbeOutcome& outcome, const MachineDescription& machine, ProbeSummary& probes) {
  ++probes.moves;
  if (outcome.touched) ++probes.touched;
  probes.last_touched = outcome.touched;
  probes.last_contact = along(machine, outcome.contact);
  probes.last_rest = along(machine, outcome.rest);
  probes.farthest_overrun = std::max(probes.farthest_overrun, Mm(length_of(outcome.rest - outcome.contact)));
}

// The files of the command line. A run writes the tool table and the parameter file when it has read them.
bool files_are_apart(const RunArguments& arguments, const InterpreterOptions& options) {
  NamedFiles files = files_of(arguments.program, options);
  files.reads("the machine file", arguments.machine);
  files.reads("--adaptive-feed", arguments.changes.adaptive_feed);
  for (const std::string& path : arguments.pictures) files.writes("--picture", path);
  for (const std::string& path : arguments.traces) files.writes("--trace", path);
  files.writes("--log", arguments.log);
  files.writes("--report", arguments.report);
  files.writes("--true-path", arguments.motors.true_path);
  if (keeps_journal(arguments)) files.writes("--journal", ResumableRun::journal_of(arguments));
  return files.are_apart();
}

// Where the program begins. Empty, with a message and `code`: nobody knows.
std::optional<Point> start_of(const RunArguments& arguments, const MachineDescription& machine,
                              MachineConnection& opened, const ResumableRun* resumable, int& code) {
  if (resumable != nullptr && resumable->start()) return resumable->start();
  const auto known = opened.place();
  Point start = known ? known->place : Point();
  if (arguments.from_here) {
    if (known && known->trust == Trust::homed) {
      note("the machine was homed, and was at " + place_words(machine, start) + "; that is now machine zero");
    }
    start = Point();
    opened.start_at({.place = start, .trust = Trust::commanded});
  } else if (!known && !(arguments.home && machine.homing.size() == machine.axes.size())) {
    code = fail(
        exit_failed,
        fmt::format("{}: the machine position is unknown: {}. Home the machine with --home, confirm that it is at "
                    "machine zero with --from-here, or continue an interrupted job with --resume [run.place-unknown]",
                    arguments.board, message_of(known.error())));
    return {};
  }
  if (arguments.home) return home_rest(machine, start);
  if (start != Point() && !arguments.quiet)
    note("the program starts at " + place_words(machine, start) + " (machine coordinates)");
  return start;
}

// All that a run needs.
struct Run {
  const RunArguments& arguments;
  const MachineDescription& machine;
  const ProgramCheck& check;
  MachineConnection& opened;
  ScheduledChanges& changes;
  RunOutputs& outputs;
  LatestMotion& motion;
  PortRun* port = nullptr;                   // null: the run does not go through a parallel port
  std::optional<Seconds> without_line = {};  // the planned time
  CutRecorder* cuts = nullptr;               // null: what tools cut is not counted
  std::string journal_run = {};              // run_of() the journal; empty: there is none
};

// Empty where the time over the line and the planned time are not of the same motion.
std::optional<Seconds> time_without_line(const ResumableRun::Subject& subject, const ProgramReader& program,
                                         const MachineConnection& opened, const ScheduledChanges& changes) {
  const bool has_line = opened.has_board() || !subject.arguments.cable_cut.empty();
  if (!has_line || subject.way || subject.check.probes || subject.arguments.resume || changes.any()) return {};
  return planned_time(program.again(), subject.machine, subject.options, subject.check);
}

// The time up to which the motors have turned.
Seconds turned_until(const Run& run) {
  return run.port != nullptr ? run.port->played() : run.opened.session().now();
}

// Runs the program to its end and returns the summary. `answered` is set to the outcome.
RunSummary play(const Run& run, request::Start start, Answered& answered) {
  BoardMachineSession& session = run.opened.session();
  const MachineDescription& machine = run.machine;
  SummaryBuilder builder(axes_of(machine));
  ProbeSummary probes;
  ProgressDisplay progress(run.arguments.program.program, !run.arguments.quiet);
  ProgramMessages messages(run.arguments.program.program, !run.arguments.quiet);
  std::optional<MotorWatch> motors;
  if (run.opened.rotors() != nullptr) motors.emplace(*run.opened.rotors(), machine, session.now());
  start.watchers.operations = [&](const Operation& operation) {
    builder.watch_operation(operation);
    messages.show(operation, [&] { progress.clear(); });
  };
  start.watchers.path = [&](const PathItem& item) { builder.watch_path(item); };
  start.watchers.motion = [&](const MotionItem& item) {
    const auto* move = std::get_if<PlannedMove>(&item);
    builder.watch(item, move != nullptr ? move->segment.work_zero : Point());
  };
  start.watchers.planned = [&](const MotionItem& item) {
    run.motion.watch(item);
    if (motors) motors->plan(item);
    if (run.port != nullptr) run.port->plan(item);
  };
  if (run.cuts != nullptr) run.cuts->begin(start, run.journal_run);
  start.watchers.probe = [&, keep = start.watchers.probe](const ProbeOutcome& outcome) {
    if (keep) keep(outcome);
    count(outcome, machine, probes);
  };
  run.outputs.watch(run.opened.machine(), start.watchers);
  run.opened.follow(start.watchers, start.stands.value_or(session.status().position.place));
  const BoardBefore before = board_before(run.opened);
  const Seconds began = session.now();
  TailWatch tails;
  LinkPeakRate load;
  LinkMonitor line = link_monitor();
  const Seconds longest_turn = run.opened.is_on_a_line() ? LinkMonitor::between_looks : endless;
  OperatorPrompt prompt(run.arguments.program.program);
  const auto place = [&] { return place_of(run.opened.machine(), machine); };
  run.changes.begin(session.now());
  const auto ticket = session.request(std::move(start));
  if (!ticket) {
    answered = {.outcome = Outcome::failed, .refused = ticket.error()};
  } else {
    bool brakes = false;
    for (unsigned turns = 0; session.busy(); ++turns) {
      const bool is_broken = run.port != nullptr && !run.port->poll();
      const bool must_stop = interrupted_by() != 0 || run.outputs.failed() || is_broken;
      if (must_stop && !std::exchange(brakes, true)) stop(session);
      const Seconds most = run.changes.any() ? run.changes.act(session, place) : endless;
      session.poll(std::min({most, longest_turn, prompt.poll(session)}));
      if (run.opened.is_on_a_line()) line.update(session.board());
      if (!run.opened.has_board()) tails.update(session, run.opened.machine(), machine);
      load.update(session.now(), run.opened.bytes_sent());
      if (run.cuts != nullptr) run.cuts->poll(session.now().value());
      if (motors) motors->poll(turned_until(run));
      if (turns % turns_between_looks == 0) progress.update(session.program()->nominal_time() / run.check.nominal_time);
    }
    answered = answer_of(session.take_changes(), *ticket);
  }
  progress.clear();
  run.opened.catch_up();
  end_cuts(run.cuts);
  RunSummary summary = builder.summary();
  summary.program = run.arguments.program.program;
  summary.machine = machine.name;
  add_board(summary, run.opened, machine, before);
  summary.board->busiest_second = load.busiest();
  summary.board->without_line = run.without_line;
  note_slip(summary, run.opened, machine, run.motion, began);
  summary.holds = run.changes.holds();
  if (probes.moves > 0) summary.probes = probes;
  summary.tails = tails.tails();
  if (run.port != nullptr) run.port->finish();
  if (motors) summary.physics = motors->finish(turned_until(run));
  if (run.port != nullptr) summary.board->port = run.port->summary();
  if (prompt.gave_up()) answered = {.outcome = Outcome::failed, .fault = prompt.fault()};
  return summary;
}

// Says why a run ended before its program did, and where the machine rests.
std::string stopped_words(const Answered& answered, const RunSummary& summary) {
  std::string words = interrupted_by() != 0 ? "interrupted; " : answered.message() + "; ";
  words += "the machine is stopped at";
  for (const AxisSummary& axis : summary.axes) words += fmt::format(" {}{:.3f}", letter_of(axis.axis), axis.position);
  return words + " (machine coordinates), and nothing was written";
}

// Homes the machine before the program. Returns the exit code.
int home_first(MachineConnection& machine, bool shows) {
  const HomingReport report = home_machine(machine, shows);
  if (report.code.empty()) return exit_done;
  const int failed = fail(exit_failed, describe(report));
  return interrupted_by() != 0 ? 128 + interrupted_by() : failed;
}

// Makes the machine ready, homes it if that is asked for, and begins the journal. From here on Ctrl-C brakes. Returns
// the exit code.
int make_ready(const ResumableRun::Subject& subject, const ProgramReader& program, MachineConnection& machine,
               ResumableRun* resumable) {
  const RunArguments& arguments = subject.arguments;
  int code = exit_done;
  brake_on_signals();
  // With --resume the machine is not homed again, because it was homed before the job began.
  const bool homes = arguments.home && !arguments.resume;
  if ((homes || resumable == nullptr) && !machine.greet(machine.any_greeting(), code)) return code;
  if (homes) {
    code = home_first(machine, !arguments.quiet);
    machine.keep_place();
  }
  if (code == exit_done && resumable != nullptr && !resumable->begin(machine, program, subject, code)) return code;
  if (code != exit_done) return code;
  // Only from the greeting does the board know at which level a switch is closed.
  if (const auto closed = machine.session().closed_limit()) {
    code = fail(exit_failed, describe(*closed));
    if (resumable != nullptr) resumable->end(machine.session(), {.outcome = Outcome::failed, .refused = *closed});
  }
  return code;
}

void print(const RunSummary& summary, const RunArguments& arguments) {
  if (arguments.json) {
    std::fputs(to_json(summary).c_str(), stdout);
  } else if (!arguments.quiet) {
    std::fputs(to_text(summary, shows_colours(STDOUT_FILENO)).c_str(), stdout);
  }
}

// A virtual probe finds only what --touch puts there. Without it, a probe move comes to its end.
void tell_of_touch(const RunArguments& arguments, const Diagnostics& findings) {
  const auto is_untouched = [](const Diagnostic& finding) { return finding.code == "gcode.probe-untouched"; };
  if (keeps_journal(arguments) || !arguments.touches.empty() || std::ranges::none_of(findings.all(), is_untouched)) {
    return;
  }
  fmt::print(stderr,
             "passo: note: the simulated probe has nothing to touch. Add an object with --touch, e.g. --touch Z:-1.5 "
             "(a plate) or --touch X10:60,Y10:50,Z:-2 (a block)\n");
}

// What is left to say and to write when a program has ended. Returns the exit code.
int end_run(const Run& run, const Answered& answered, const RunSummary& summary, const Diagnostics& late,
            LengthUnits machine_units) {
  BoardMachineSession& session = run.opened.session();
  if (session.status().trouble == LinkError::stopped) {
    const std::uint32_t line = summary.physics ? summary.physics->fault_line : 0;
    return fail(exit_failed,
                "the board: " + stop_words(run.opened, run.machine, run.arguments.program.program, run.motion, line));
  }
  if (session.status().trouble == LinkError::stood_still) {
    print(summary, run.arguments);
    return fail(exit_failed, "the board: " + slip_words(run.opened, run.machine, run.arguments.program.program,
                                                        summary.board->stood_still_line));
  }
  if (session.status().trouble) return fail(exit_failed, "the board: " + session.trouble_words());
  if (answered.fault && is_of_board(answered.fault->fault)) {
    return fail(exit_failed, "the board: " + answered.message());
  }
  if (run.port != nullptr && !run.port->error().empty()) return fail(exit_failed, "the board: " + run.port->error());
  if (const auto words = run.opened.compare()) return fail(exit_failed, "the board: " + *words);
  if (run.opened.has_board()) tell_tails(session);
  if (answered.outcome == Outcome::failed || interrupted_by() != 0) {
    show(late);
    tell_of_touch(run.arguments, late);
    const int failed = fail(exit_failed, stopped_words(answered, summary));
    return interrupted_by() != 0 ? 128 + interrupted_by() : failed;
  }
  const Status<OutputError> written =
      run.outputs.commit(summary, session.program()->saved_parameters(), session.program()->tools(), machine_units);
  if (!written) return fail(exit_failed, written.error().message);
  print(summary, run.arguments);
  if (summary.board->port && summary.board->port->lost_pulses() != 0) {
    return fail(exit_failed, "the PIC did not sample every pulse, and the part would be scrap [run.pulses-lost]");
  }
  if (!summary.physics || !summary.physics->lost()) return exit_done;
  return fail(exit_failed, "the motors lost steps, and the part would be scrap [run.steps-lost]");
}

// Runs a program that was checked, on a machine that has not been greeted. Returns the exit code.
int run_checked(const ResumableRun::Subject& subject, ProgramReader program, MachineConnection& opened,
                ResumableRun* resumable, ScheduledChanges& changes, const ProgramStops& stops, CutRecorder* cuts) {
  const RunArguments& arguments = subject.arguments;
  const std::string tools =
      subject.check.tools_change ? tool_table_file(arguments.program, subject.options) : std::string();
  Result<RunOutputs, OutputError> outputs =
      RunOutputs::open(arguments, subject.machine, parameter_file(arguments.program, subject.options), tools);
  if (!outputs) return fail(exit_failed, outputs.error().message);
  int code = make_ready(subject, program, opened, resumable);
  if (code != exit_done) return code;
  std::unique_ptr<PortRun> port;
  if (is_on_port(arguments.board)) port = PortRun::start(subject.machine, opened, code);
  if (code != exit_done) return code;
  if (port && outputs->true_path() != nullptr) port->record_path(*outputs->true_path());

  Diagnostics late;
  const std::optional<Seconds> without_line = time_without_line(subject, program, opened, changes);
  request::Start start{.program = std::move(program),
                       .options = subject.options,
                       .nominal_time = subject.check.nominal_time,
                       .waits_for_operator = !arguments.yes && (keeps_journal(arguments) || asks_operator()),
                       .live = changes.any(),
                       .findings = &late};
  if (subject.way) {
    start.from = subject.way->at;
    start.lead_in = subject.way->lead_in;
  }
  if (resumable != nullptr) resumable->add_to(start);
  if (!start.waits_for_operator && !arguments.yes) tell_stops(stops, arguments);
  Answered answered;
  LatestMotion motion;
  const Run run{arguments,
                subject.machine,
                subject.check,
                opened,
                changes,
                *outputs,
                motion,
                port.get(),
                without_line,
                cuts,
                resumable != nullptr ? resumable->run() : std::string()};
  const RunSummary summary = play(run, std::move(start), answered);
  if (resumable != nullptr) resumable->end(opened.session(), answered);
  return end_run(run, answered, summary, late, subject.options.machine_units);
}

// Opens the machine, checks the program from where the machine stands, and runs the program. Returns the exit code.
int run_program(const RunArguments& arguments, const MachineDescription& machine, const MachineWish& wish,
                ProgramReader program, InterpreterOptions options, ScheduledChanges& changes) {
  int code = exit_done;
  std::unique_ptr<ResumableRun> resumable;
  if (keeps_journal(arguments)) resumable = ResumableRun::open(arguments, code);
  if (code != exit_done) return code;
  const auto opened = MachineConnection::open(machine, wish, code);
  if (!opened) return code;
  const std::optional<Point> begins_at = start_of(arguments, machine, *opened, resumable.get(), code);
  if (!begins_at) return code;
  options.start = *begins_at;

  Diagnostics findings;
  PathFingerprint path;
  ProgramStops stops;
  auto lives = read_lives(arguments.program.tool_life, code);
  if (!lives) return code;
  CutForecast forecast(motion_limits(machine), std::move(*lives));
  const auto watch_path = [&](const PathItem& item) {
    if (resumable) path.add(item);
    stops.watch(item);
    forecast.add(item);
  };
  const auto watch_operations = [&](const Operation& operation) { stops.watch(operation, options.tools); };
  const ProgramCheck check = check_program(program.again(), machine, options, findings, watch_path, watch_operations);
  if (check.good) forecast.add_findings(arguments.program.program, findings);
  show(findings);
  if (!check.good) return exit_bad_program;
  if (check.probes && is_on_port(arguments.board)) {
    return fail(exit_bad_program, "the program probes, and the port of sim:first_board has no inputs [port.no-inputs]");
  }
  std::optional<Reentry> way;
  if (arguments.start.line > 0 && !(way = way_to_line(arguments, program, machine, options, code))) return code;
  const ResumableRun::Subject subject{arguments, machine, options, check, path.value(), way};
  if (resumable && !resumable->suits(subject, code)) return code;
  CountedCuts cuts;
  if (counts_tools(arguments)) code = cuts.open(arguments.program.tool_life, ResumableRun::journal_of(arguments));
  if (code != exit_done) return code;
  if (resumable && cuts.recorder()) resumable->count_into(*cuts.recorder());
  return run_checked(subject, std::move(program), *opened, resumable.get(), changes, stops, cuts.recorder());
}

}  // namespace

int run(const RunArguments& arguments) {
  if (!names_are_good(arguments)) return exit_bad_program;
  std::optional<ScheduledChanges> changes = ScheduledChanges::read(arguments.changes);
  std::optional<CableCut> cut;
  if (!changes) return exit_bad_program;
  if (!arguments.cable_cut.empty() && !(cut = read_cable_cut(arguments.cable_cut))) return exit_bad_program;
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics, use_with(arguments.board));
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  const std::optional<std::vector<Touchable>> things = read_touch_options(arguments.touches, *machine);
  const auto disturbances = read_disturbances(arguments.motors.disturbances, *machine);
  if (!things || !disturbances) return exit_bad_program;
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  options->main_passes = arguments.passes;
  if (names_grbl_machine(arguments.board)) {
    if (!suits_grbl(arguments) || !suits_the_board(arguments)) return exit_bad_program;
    return run_on_grbl(arguments, *machine, std::move(*program), std::move(*options), *changes);
  }
  if (arguments.home && machine->homing.empty()) {
    return fail(exit_bad_machine, words_without_homing(arguments.machine));
  }
  if (!suits_the_board(arguments) || !files_are_apart(arguments, *options)) return exit_bad_program;

  const auto has_physics = [](const AxisDescription& axis) { return motor_setup(axis).has_value(); };
  if (arguments.motors.physics && std::ranges::none_of(machine->axes, has_physics)) {
    return fail(exit_bad_machine,
                arguments.machine + ": --physics needs motor data: a table [axis.X.torque] for at least one axis");
  }
  const bool on_port = is_on_port(arguments.board);
  if (on_port && !suits_the_port(*machine, arguments.machine, arguments.motors.anyway)) return exit_bad_machine;
  end_on_signals();
  return run_program(
      arguments, *machine,
      {.board = on_port ? "virtual" : arguments.board,
       .over_a_line = cut.has_value(),
       .cut = cut,
       .touchables = *things,
       .physics = arguments.motors.physics || (on_port && std::ranges::any_of(machine->axes, has_physics)),
       .disturbances = *disturbances,
       .plant_apart = on_port,
       .spindle = SpindleWish::now,
       .may_move = arguments.resume},
      std::move(*program), std::move(*options), *changes);
}

}  // namespace passo
