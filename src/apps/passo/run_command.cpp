// passo run: check the program, run it on the virtual machine, and write what was asked for.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>

#include "board_run.hpp"
#include "commands.hpp"
#include "homing_run.hpp"
#include "mid_run_changes.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "resumable_run.hpp"
#include "run_outputs.hpp"
#include "run_signals.hpp"
#include "touch_option.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/activity/program.hpp"
#include "passo/activity/machine_plant.hpp"
#include "passo/session/operator_panel.hpp"
#include "passo/journal/path_fingerprint.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/geometry/euclid.hpp"
#include "passo/report/line_load.hpp"
#include "passo/report/summary.hpp"
#include "passo/report/summary_builder.hpp"

namespace passo {
namespace {

// How often the clock is read for the progress line: every so many board segments.
constexpr unsigned segments_between_looks = 1024;

void add_board(RunSummary& summary, Job& job, const MachineDescription& machine) {
  const MachineCounts counts = job.machine().counts();
  BoardSummary board;
  board.end = Seconds(static_cast<double>(job.machine().now().count) / machine.board.clock.value());
  board.events = static_cast<std::uint64_t>(counts.events);
  board.frames = job.link().frames_sent();
  board.bytes = job.link().bytes_sent();
  if (const Refiller* refiller = job.drive().refiller(); refiller != nullptr && job.link().board()) {
    board.held_items = job.link().board()->capacity;
    board.rests = refiller->recoveries();
  }
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const std::int64_t net = axis.inverted ? -counts.motors[m].position : counts.motors[m].position;
    summary.axes[m].net_steps = Steps{net};
    summary.axes[m].total_steps = Steps{counts.motors[m].total};
    summary.axes[m].position = static_cast<double>(net) / axis.steps_per_unit;
    board.pulses += static_cast<std::uint64_t>(counts.motors[m].total);
  }
  summary.board = board;
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

RunSummary play(Job& job, const ProgramCheck& check, const RunArguments& arguments, const MachineDescription& machine,
                RunOutputs& outputs, MidRunChanges& changes, const BoardRun* board) {
  SummaryBuilder builder(axes_of(machine));
  job.motion().watch([&](const MotionItem& item) {
    const auto* move = std::get_if<PlannedMove>(&item);
    builder.watch(item, move != nullptr ? move->segment.work_zero : Point());
  });
  ProbeSummary probes;
  job.drive().probe().watch([&](const ProbeOutcome& outcome) { count(outcome, machine, probes); });
  outputs.watch(job);
  changes.begin(job.drive());
  OperatorPanel panel(job.drive());
  TailWatch tails;
  LineLoad load;
  {
    ProgressDisplay progress(arguments.program.program, !arguments.quiet);
    for (unsigned played = 0; job.advance() && !outputs.failed(); ++played) {
      if (interrupted_by() != 0 && !job.drive().stopped()) job.drive().stop();
      if (board != nullptr) panel.look();
      if (changes.any() && !panel.holds()) changes.act(job.drive(), job.machine(), machine);
      if (board == nullptr) tails.look(job.drive(), job.machine(), machine);
      load.look(job.drive().now(), job.link().bytes_sent());
      if (played % segments_between_looks == 0) progress.update(job.nominal_time() / check.nominal_time);
    }
  }
  RunSummary summary = builder.summary();
  summary.program = arguments.program.program;
  summary.machine = machine.name;
  add_board(summary, job, machine);
  summary.board->busiest_second = load.busiest();
  summary.holds = changes.holds();
  if (probes.moves > 0) summary.probes = probes;
  summary.tails = tails.tails();
  return summary;
}

// Why a run ended before its program did, and where.
std::string stopped_words(const Job& job, const RunSummary& summary) {
  std::string words = interrupted_by() != 0            ? "interrupted; "
                      : job.drive().stopped_by_probe() ? "the probe was touched in a move that is no probe move; "
                                                       : "the program cannot go on; ";
  words += "the machine rests at";
  for (const AxisSummary& axis : summary.axes) words += fmt::format(" {}{:.3f}", letter_of(axis.axis), axis.position);
  return words + " (machine coordinates), and nothing was written";
}

// The names of the files tell their kinds: a wrong one is a mistake of the command line.
bool names_are_good(const RunArguments& arguments) {
  for (const std::string& path : arguments.pictures) {
    if (is_picture_name(path)) continue;
    fail(exit_bad_program, path + ": a picture's name ends in .svg or .png");
    return false;
  }
  for (const std::string& path : arguments.traces) {
    if (is_trace_name(path)) continue;
    fail(exit_bad_program, path + ": a trace's name ends in .vcd or .csv");
    return false;
  }
  return true;
}

// An emulated board ends with the run.
bool keeps_journal(const RunArguments& arguments) {
  return arguments.board != "virtual" && !arguments.board.starts_with("sim:");
}

std::function<void(const PathItem&)> known_again(PathFingerprint& path, const RunArguments& arguments) {
  if (!keeps_journal(arguments)) return {};
  return [&path](const PathItem& item) { path.add(item); };
}

// The exit code; `board` is null where the machine is virtual.
int home_first(const MachineDescription& machine, BoardRun* board, Plant& plant, bool shows) {
  const HomingReport report = home_machine(machine, board, plant, shows);
  if (!report.code.empty()) {
    const int failed = fail(exit_failed, words_of(report));
    return interrupted_by() != 0 ? 128 + interrupted_by() : failed;
  }
  if (board == nullptr || board->stands_at(steps_at(machine, report.place))) return exit_done;
  return fail(exit_failed, "the board: it does not answer any more");
}

// Opens it, and the journal of what runs on it. From here on Ctrl-C brakes.
int reach_board(const ResumableRun::Subject& subject, const ProgramReader& program, Plant& plant,
                std::unique_ptr<BoardRun>& board, std::unique_ptr<ResumableRun>& resumable) {
  const RunArguments& arguments = subject.arguments;
  int code = exit_done;
  if (keeps_journal(arguments)) resumable = ResumableRun::open(subject, code);
  if (code != exit_done) return code;
  const auto motors = static_cast<std::uint8_t>(subject.machine.axes.size());
  board = BoardRun::open(arguments.board, motors, arguments.resume, plant, code);
  if (!board) return code;
  brake_on_signals();
  // A job that is resumed began so.
  if (arguments.home && !arguments.resume) code = home_first(subject.machine, board.get(), plant, !arguments.quiet);
  if (code == exit_done && resumable) static_cast<void>(resumable->begin(*board, program, subject, code));
  return code;
}

int print(const RunSummary& summary, const RunArguments& arguments) {
  if (arguments.json) {
    std::fputs(to_json(summary).c_str(), stdout);
  } else if (!arguments.quiet) {
    std::fputs(to_text(summary, is_terminal(STDOUT_FILENO) && std::getenv("NO_COLOR") == nullptr).c_str(), stdout);
  }
  return std::fflush(stdout) == 0 ? exit_done : fail(exit_failed, "cannot write to standard output");
}

bool suits_the_board(const RunArguments& arguments) {
  const char* words = nullptr;
  if ((arguments.resume || !arguments.journal.empty()) && !keeps_journal(arguments)) {
    words = "--resume and --journal are for a board that outlives the run: serial: or tcp:";
  } else if (!arguments.cable_cut.empty() && arguments.board != "virtual") {
    words = "--cut-cable-at is for the virtual machine; of a board's cable, pull the plug";
  } else if (!arguments.touches.empty() && keeps_journal(arguments)) {
    words = "--touch is for the virtual machine and emulated boards";
  }
  if (words != nullptr) fail(exit_bad_program, words);
  return words == nullptr;
}

}  // namespace

int run(const RunArguments& arguments) {
  if (!names_are_good(arguments)) return exit_bad_program;
  std::optional<MidRunChanges> changes = MidRunChanges::read(arguments.holds, arguments.overrides);
  if (!changes) return exit_bad_program;
  std::optional<CableCut> cut;
  if (!arguments.cable_cut.empty() && !(cut = read_cable_cut(arguments.cable_cut))) return exit_bad_program;
  Diagnostics diagnostics;
  const std::optional<MachineDescription> machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;

  const std::optional<std::vector<TouchBox>> boxes = read_touch_options(arguments.touches, *machine);
  if (!boxes) return exit_bad_program;
  std::optional<ProgramReader> program = open_program(arguments.program);
  std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  options->main_passes = arguments.passes;
  if (arguments.home && machine->homing.empty()) {
    return fail(exit_bad_machine, words_without_homing(arguments.machine));
  }
  if (arguments.home) options->start = home_rest(*machine);
  Diagnostics findings;
  PathFingerprint path;
  const ProgramCheck check =
      check_program(program->again(), *machine, *options, findings, known_again(path, arguments));
  show(findings);
  if (!check.good) return exit_bad_program;
  if (!suits_the_board(arguments)) return exit_bad_program;

  end_on_signals();
  const std::string tools = check.tools_change ? tool_table_file(arguments.program, *options) : std::string();
  Result<RunOutputs, OutputError> outputs =
      RunOutputs::open(arguments, *machine, parameter_file(arguments.program, *options), tools);
  if (!outputs) return fail(exit_failed, outputs.error().message);

  IdealPlant plant = plant_of(*machine, Point(), *boxes);
  std::unique_ptr<BoardRun> board;
  std::unique_ptr<ResumableRun> resumable;
  Job::Options reaches;
  reaches.plant = &plant;
  if (cut) reaches.line.emplace();
  if (arguments.board != "virtual") {
    const int code =
        reach_board({arguments, *machine, *options, check, path.value()}, *program, plant, board, resumable);
    if (code != exit_done) return code;
    reaches.board = &board->port();
    if (resumable) resumable->add_to(reaches);
  } else if (arguments.home) {
    if (const int code = home_first(*machine, nullptr, plant, !arguments.quiet); code != exit_done) return code;
  }

  Diagnostics late;
  Job job(std::move(*program), *machine, *options, late, reaches);
  if ((cut || board) && !job.link().error()) {
    if (const auto words = job.unsuited()) return fail(exit_failed, "the board: " + *words);
  }
  if (cut) job.line().cut(cut->at, cut->missing);
  if (int code = exit_done; resumable && !job.link().error() && !resumable->start(job, code)) return code;
  const RunSummary summary = play(job, check, arguments, *machine, *outputs, *changes, board.get());
  if (resumable) resumable->end(job);
  if (const auto error = job.link().error()) return fail(exit_failed, "the board: " + std::string(message_of(*error)));
  if (board) {
    if (const auto words = board->compare(job.machine().counts())) return fail(exit_failed, "the board: " + *words);
    board->tell(*job.drive().refiller());
  }
  if (late.any_error() || job.drive().stopped_by_probe() || interrupted_by() != 0) {
    show(late);
    const int failed = fail(exit_failed, stopped_words(job, summary));
    return interrupted_by() != 0 ? 128 + interrupted_by() : failed;
  }
  const Status<OutputError> written =
      outputs->commit(summary, job.saved_parameters(), job.tools(), options->machine_units);
  if (!written) return fail(exit_failed, written.error().message);

  return print(summary, arguments);
}

}  // namespace passo
