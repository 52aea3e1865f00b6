#include "grbl_run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string_view>
#include <utility>
#include <vector>

#include "from_line.hpp"
#include "opened_grbl.hpp"
#include "operator_prompt.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/program.hpp"
#include "passo/base/counted.hpp"
#include "passo/drive/program_stop.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/sender/grbl_code.hpp"

namespace passo {
namespace {

// The machine's own offsets, as saved parameters.
void take_offsets(const GrblMachine& machine, InterpreterOptions& options) {
  const double unit = options.machine_units == LengthUnits::inch ? 25.4 : 1;
  const auto set = [&](int first, const Point& offset) {
    for (int axis = 0; axis < 3; ++axis) {
      options.parameters[first + axis] = offset.values[static_cast<std::size_t>(axis)] / unit;
    }
  };
  options.parameters[work_system_parameter] = 1;
  options.parameters[g92_active_parameter] = 0;
  for (const auto& [name, offset] : machine.offsets) {
    if (name == "G92") {
      options.parameters[g92_active_parameter] = offset == Point() ? 0 : 1;
      set(g92_parameter, offset);
    } else if (name.size() == 3 && name[2] >= '4' && name[2] <= '9') {
      set(work_offset_parameter(1 + name[2] - '4'), offset);
    }
  }
}

// Where the zero of G54 lies, machine coordinates.
Point zero_of(const GrblMachine& machine) {
  Point zero;
  for (const char* name : {"G54", "G92"}) {
    const auto found = machine.offsets.find(name);
    if (found != machine.offsets.end()) zero = zero + found->second;
  }
  return zero;
}

// Reports what a Grbl machine cannot do, at its line, once for each reason.
class Objections {
 public:
  Objections(const std::string& program, Diagnostics& diagnostics) : program_(program), diagnostics_(diagnostics) {}
  void note(const Operation& operation) {
    if (operation.source.line == line_) return;
    line_ = operation.source.line;
    text_ = operation.text;
    file_ = operation.file;
  }
  void add(const std::string& reason, std::uint32_t line) {
    if (std::ranges::find(told_, reason) != told_.end()) return;
    told_.push_back(reason);
    diagnostics_.add({.code = "grbl.cannot",
                      .file = file_.empty() ? program_ : file_,
                      .place = {.line = line, .column = line == line_ && !text_.empty() ? 1U : 0U},
                      .message = "a machine that speaks Grbl cannot do this: " + reason,
                      .expected = "",
                      .text = line == line_ ? text_ : ""});
  }

 private:
  const std::string& program_;
  Diagnostics& diagnostics_;
  std::uint32_t line_ = 0;
  std::string text_;
  std::string file_;
  std::vector<std::string> told_;
};

std::uint32_t line_of(const PathItem& item) {
  return std::visit([](const auto& one) { return one.source.line; }, item);
}

// The lines of a program in order, a few at a time, with its stops between them.
class GrblProgram {
 public:
  GrblProgram(const RunArguments& arguments, const ProgramReader& program, const MachineDescription& machine,
              const InterpreterOptions& options, const Point& zero)
      : arguments_(arguments),
        program_(program.again()),
        code_(zero),
        checker_(program_.again(), machine, options, unheard_),
        messages_(arguments.program.program, !arguments.quiet) {
    checker_.watch([this](const PathItem& item) { take(item); });
    checker_.watch_operations([this, tools = options.tools](const Operation& operation) {
      words_.watch(operation, tools);
      if (from_line_ == 0) messages_.show(operation, before_words);
    });
  }

  // Begins at a line, after the way there.
  void begin_at(const Reentry& way) {
    for (const PathItem& item : way.lead_in) write(item);
    from_line_ = way.at.line;
  }
  // Gives the sender lines, up to the next stop.
  void feed(GrblSender& sender) {
    while (sender.wants_lines() && !stop_ && !(ended_ && ready_.empty())) {
      if (ready_.empty()) {
        ended_ = checker_.go_on(1);
        if (ended_) ready_.push_back({"G4P0", 0, Seconds(0), {}});  // answered when all motion is done
        continue;
      }
      Ready next = std::move(ready_.front());
      ready_.pop_front();
      if (next.stop) stop_ = next.stop;
      if (!next.text.empty()) sender.add(next.text, next.line, next.silence);
    }
  }
  // The machine is to rest here until somebody goes on.
  const std::optional<OperatorWait>& stop() const { return stop_; }
  void go_on() { stop_.reset(); }
  bool ended() const { return ended_ && ready_.empty(); }
  std::uint64_t moves() const { return checker_.result().moves; }
  Seconds nominal_time() const { return checker_.result().nominal_time; }

  std::function<void()> before_words;

 private:
  struct Ready {
    std::string text;
    std::uint32_t line = 0;
    Seconds silence{0};
    std::optional<OperatorWait> stop;
  };

  void take(const PathItem& item) {
    if (from_line_ != 0 && !reaches(item)) return;
    write(item);
  }
  // From the beginning of the line on. What was set before is in the way there.
  bool reaches(const PathItem& item) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr || segment->source.line != from_line_) return false;
    from_line_ = 0;
    Segment to_start = *segment;
    to_start.curve = Curve::line(segment->curve.end(), segment->curve.start());
    write(to_start);
    return true;
  }
  void write(const PathItem& item) {
    std::vector<std::string> lines;
    if (!code_.write(item, lines)) return;  // the check has told it
    const auto* action = std::get_if<Action>(&item);
    const Seconds silence = action != nullptr && action->kind == Action::Kind::dwell ? action->dwell : Seconds(0);
    for (std::string& text : lines) ready_.push_back({std::move(text), line_of(item), silence, {}});
    if (action == nullptr || !is_program_stop(*action) || arguments_.yes) return;
    const std::uint32_t line = action->source.line;
    const OperatorWait wait{.kind = action->kind, .tool = action->tool, .line = line, .words = words_.at(line)};
    words_.pass(line);
    ready_.push_back({"G4P0", action->source.line, Seconds(0), wait});
  }

  const RunArguments& arguments_;
  ProgramReader program_;
  GrblCode code_;
  Diagnostics unheard_;
  ProgramChecker checker_;
  ProgramMessages messages_;
  WaitWords words_;
  std::deque<Ready> ready_;
  std::optional<OperatorWait> stop_;
  std::uint32_t from_line_ = 0;
  bool ended_ = false;
};

// Holds and overrides of the command line, at their times.
class TimedBytes {
 public:
  TimedBytes(const MidRunChanges& changes, Seconds begun) : changes_(changes.all()), begun_(begun) {}
  // True: a hold has ended the run.
  bool look(OpenedGrbl& opened) {
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
  const std::vector<MidRunChanges::Change>& changes_;
  Seconds begun_;
  std::size_t next_ = 0;
  bool holds_ = false;
  bool ends_ = false;    // the hold ends the run
  bool rested_ = false;  // in the hold
  Seconds pause_{0};
  Seconds resume_at_{0};
};

// The machine is idle, in known modes. False, with a message and `code`.
bool make_ready(OpenedGrbl& opened, const std::string& board, bool homes, int& code) {
  GrblSender& sender = opened.sender();
  if (homes && !opened.home(code)) return false;
  if (sender.report()->state == "Alarm") {
    const std::string alarm = sender.alarm_words();
    code = fail(exit_failed, fmt::format("{}: the machine is locked by an alarm{}{}{}. --home homes it; $X of another "
                                         "sender unlocks it where it stands [grbl.locked]",
                                         board, alarm.empty() ? "" : " (", alarm, alarm.empty() ? "" : ")"));
    return false;
  }
  for (const char* line : {"G21G90G94G17G40G49G54", "M5", "M9"}) sender.add(line);
  sender.ask_for_offsets();
  if (!opened.turn_to_rest()) {
    code = opened.give_up();
    return false;
  }
  if (sender.place()) return true;
  code = fail(exit_failed, board +
                               ": the reports of the machine tell no place: $10=1 makes them tell it "
                               "[grbl.no-place]");
  return false;
}

// The program is checked before anything moves.
ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const Point& zero) {
  Diagnostics findings;
  Objections objections(program.name(), findings);
  GrblCode code(zero);
  std::vector<std::string> lines;
  ProgramCheck check = check_program(
      program.again(), machine, options, findings,
      [&](const PathItem& item) {
        lines.clear();
        const auto written = code.write(item, lines);
        if (!written) objections.add(written.error(), line_of(item));
      },
      [&](const Operation& operation) { objections.note(operation); });
  check.good = check.good && !findings.any_error();
  show(findings);
  return check;
}

struct GrblRunResult {
  Seconds time{0};
  std::uint64_t lines = 0;
};

void print(const GrblRunResult& result, const RunArguments& arguments, const OpenedGrbl& opened,
           const ProgramCheck& check) {
  const Point place = opened.sender().place().value_or(Point());
  const GrblMachine& machine = opened.sender().machine();
  if (arguments.json) {
    const nlohmann::ordered_json all = {
        {"program", arguments.program.program},
        {"grbl",
         {{"firmware", machine.firmware},
          {"version", machine.version},
          {"receive_buffer", opened.sender().buffer_size()}}},
        {"moves", check.moves},
        {"lines", result.lines},
        {"time_s", result.time.value()},
        {"position_mm", {{"X", place[Axis::x]}, {"Y", place[Axis::y]}, {"Z", place[Axis::z]}}}};
    fmt::print("{}\n", all.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("{}: {} in {}, {:.1f} s; at rest in {} (machine). Its steps are not counted: {} {} tells none\n",
               arguments.program.program, counted(check.moves, "move"), counted(result.lines, "line"),
               result.time.value(), opened.place_words(), machine.firmware, machine.version);
  }
}

// `waits`: the stop at which nobody can be asked, if there is one.
int end_broken_off(const RunArguments& arguments, OpenedGrbl& opened, const std::optional<OperatorWait>& waits) {
  const GrblSender& sender = opened.sender();
  std::string words = interrupted_by() != 0 ? "interrupted" : "held";
  if (sender.fault()) {
    words = words_of(*sender.fault(), arguments.program.program);
  } else if (waits && interrupted_by() == 0) {
    words = fmt::format(
        "{} waits at {}, and there is no terminal to ask on: run it on one, or with --yes when all is "
        "prepared [run.waits]",
        arguments.program.program, words_of(*waits));
  }
  // The report may be from before the brake, if the machine has not answered any more.
  const int failed = fail(
      exit_failed, fmt::format("{}; the machine was last in the state {} at {} (machine coordinates). A Grbl machine "
                               "cannot go on exactly where it was: --from-line begins at a line",
                               words, sender.report()->state, opened.place_words()));
  return interrupted_by() != 0 ? exit_of_signal() : failed;
}

int stream(const RunArguments& arguments, OpenedGrbl& opened, GrblProgram& lines, const ProgramCheck& check,
           const MidRunChanges& changes) {
  GrblSender& sender = opened.sender();
  ProgressDisplay progress(arguments.program.program, !arguments.quiet);
  lines.before_words = [&] { progress.clear(); };
  OperatorPrompt prompt(arguments.program.program);
  const Seconds begun = opened.now();
  const std::uint64_t lines_before = sender.lines_sent();
  TimedBytes timed(changes, begun);
  while (!(lines.ended() && !lines.stop() && sender.at_rest()) && !sender.stopped()) {
    lines.feed(sender);
    opened.turn(OpenedGrbl::between_looks);
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
        "--resume and --journal: a machine that speaks Grbl counts no steps for its sender, so a job goes on at a line "
        "(--from-line), and not where it was [grbl.cannot]";
  } else if (arguments.from_here) {
    words =
        "--from-here: a machine that speaks Grbl keeps its own position: home it, or set its work zero [grbl.cannot]";
  } else if (arguments.pass > 0 || arguments.after > 0) {
    words = "--pass and --after: a machine that speaks Grbl begins at a line that is done once [grbl.cannot]";
  } else if (!arguments.pictures.empty() || !arguments.traces.empty() || !arguments.report.empty() ||
             !arguments.log.empty()) {
    words =
        "--picture, --trace, --report and --log: a machine that speaks Grbl plans its own motion and tells no steps; "
        "passo run without --board makes them [grbl.cannot]";
  }
  if (words != nullptr) fail(exit_bad_program, words);
  return words == nullptr;
}

int run_on_grbl(const RunArguments& arguments, const MachineDescription& machine, ProgramReader program,
                InterpreterOptions options, const MidRunChanges& changes) {
  int code = exit_done;
  brake_on_signals();
  const auto opened = OpenedGrbl::open(arguments.board, code);
  if (!opened || !make_ready(*opened, arguments.board, arguments.home, code)) return code;
  const GrblSender& sender = opened->sender();
  options.start = *sender.place();
  take_offsets(sender.machine(), options);
  const Point zero = zero_of(sender.machine());
  const ProgramCheck check = check_for_grbl(program, machine, options, zero);
  if (!check.good) return exit_bad_program;
  if (!arguments.quiet)
    note("the program begins at " + opened->place_words() +
         " (machine coordinates), with the "
         "offsets of the machine");
  GrblProgram lines(arguments, program, machine, options, zero);
  if (arguments.from_line > 0) {
    const auto way = way_to_line(arguments, program, machine, options, code);
    if (!way) return code;
    lines.begin_at(*way);
  }
  return stream(arguments, *opened, lines, check, changes);
}

int home_grbl(const HomeArguments& arguments) {
  if (arguments.repeat > 1) {
    return fail(exit_bad_program,
                "--repeat: a machine that speaks Grbl does not tell where its switches closed "
                "[grbl.cannot]");
  }
  int code = exit_done;
  brake_on_signals();
  const auto opened = OpenedGrbl::open(arguments.board, code);
  if (!opened) return code;
  const Seconds begun = opened->now();
  if (!opened->home(code)) return code;
  const Point place = opened->sender().place().value_or(Point());
  const double time = (opened->now() - begun).value();
  if (arguments.json) {
    const nlohmann::ordered_json all = {
        {"homed", true},
        {"time_s", time},
        {"position_mm", {{"X", place[Axis::x]}, {"Y", place[Axis::y]}, {"Z", place[Axis::z]}}}};
    fmt::print("{}\n", all.dump(2));
  } else if (!arguments.quiet) {
    fmt::print("homed in {:.1f} s: at rest in {} (machine)\n", time, opened->place_words());
  }
  return exit_done;
}

}  // namespace passo
