#include "passo/activity/streamed_program.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/activity/placed_tool_change.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

bool is_kind(const PathItem& item, Action::Kind kind) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr && action->kind == kind;
}

// As in grbl, a probe move of check mode is touched at its end.
ProbeOutcome touched_at(const Point& place) {
  return {.refused = false, .touched = true, .contact = place, .rest = place};
}

// The first error. Warnings do not stop a line.
std::optional<Diagnostic> first_error(const Diagnostics& diagnostics) {
  for (const Diagnostic& one : diagnostics.all()) {
    if (one.severity == Severity::error) return one;
  }
  return {};
}

}  // namespace

StreamedProgram::StreamedProgram(const MachineDescription& machine, InterpreterOptions options, const Point& start)
    : machine_(machine),
      options_(on_machine(machine, std::move(options))),
      path_options_(path_options(machine, "line")),
      answers_(StoredResults::Answers{}),
      queue_(motion_limits(machine)) {
  options_.open_ended = true;
  options_.on_machine = true;
  path_options_.open_ended = true;
  begin(start);
}

void StreamedProgram::begin(const Point& start) {
  options_.start = path_options_.start = start;
  diagnostics_.clear();
  interpreter_ = std::make_unique<Interpreter>(ProgramReader::from_lines("line"), options_, diagnostics_, answers_);
  operations_ = std::make_unique<Tap<Operation>>(*interpreter_);
  operations_->watch([this](const Operation& operation) {
    operator_messages_.watch(operation, interpreter_->tools());
    if (allows_changes_ || !is_placed_tool_change(operation, machine_)) return;
    diagnostics_.add(unplaced_tool_change(path_options_.file, operation.source.line));
  });
  builder_ = std::make_unique<PathBuilder>(*operations_, path_options_, diagnostics_, answers_);
  asks_ = false;
}

void StreamedProgram::restart(const Point& place) {
  forget_queue();
  options_.parameters = interpreter_->saved_parameters();
  forget_g92(options_.parameters);
  begin_with_g54(options_.parameters);
  options_.units = LengthUnits::mm;
  begin(place);
}

void StreamedProgram::go_on_at(const Point& place) {
  const SavedParameters parameters = interpreter_->saved_parameters();
  apply_offsets(parameters, place);
}

void StreamedProgram::apply_offsets(const SavedParameters& parameters, const Point& place) {
  forget_queue();
  options_.parameters = interpreter_->saved_parameters();
  replace_persistent_offsets(options_.parameters, parameters);
  begin_with(interpreter_->modes(), interpreter_->motion(), place);
}

void StreamedProgram::forget_queue() {
  operator_messages_ = {};
  queue_.clear();
  jogs_ = false;
  outputs_ = {};
}

// The outputs are off. F is given in G94: in inverse time it counts for its own line alone.
void StreamedProgram::begin_with(const ActiveModes& modes, int motion, const Point& place) {
  options_.units = modes.inches ? LengthUnits::inch : LengthUnits::mm;
  begin(place);
  const double unit = modes.inches ? mm_per_inch : 1;
  const double tool_offset = modes.frame.tool_offset()[Axis::z] / unit;
  std::vector<std::string> lines = {fmt::format("G94 F{:.6f}", modes.feed / unit), fmt::format("S{:.6f}", modes.speed),
                                    fmt::format("{}", fmt::join(modes.codes.begin() + 1, modes.codes.end(), " "))};
  if (modes.tool > 0) lines.push_back(fmt::format("T{}", modes.tool));
  if (tool_offset != 0) lines.push_back(fmt::format("G43.1 Z{:.6f}", tool_offset));
  for (const std::string& line : lines) static_cast<void>(read(line));
  interpreter_->set_motion(motion);
}

// As grbl does after M2: units, feed, speed, tool and its offset stay.
void StreamedProgram::begin_after_end() {
  constexpr int feed_motion = 10;
  ActiveModes modes = interpreter_->modes();
  modes.codes = {"G1", "G54", "G17", modes.inches ? "G20" : "G21", "G90", "G94"};
  options_.parameters = interpreter_->saved_parameters();
  begin_with(modes, feed_motion, builder_->position());
  ended_ = true;
}

std::optional<Diagnostic> StreamedProgram::add_line(std::string_view line, Seconds now) {
  return queue_line(line, now, false);
}

std::optional<Diagnostic> StreamedProgram::add_jog(std::string_view words, Seconds now) {
  const ActiveModes modes = interpreter_->modes();
  const double unit = modes.inches ? mm_per_inch : 1;
  const int motion = interpreter_->motion();
  auto answer = queue_line(fmt::format("G94 G1 {}", words), now, true);
  // Units come first, because F counts in them.
  static_cast<void>(read(modes.codes[3]));
  static_cast<void>(read(fmt::format("G94 F{:.6f}", modes.feed / unit)));
  static_cast<void>(read(fmt::format("{} {}", modes.codes[4], modes.codes[5])));
  interpreter_->set_motion(motion);
  diagnostics_.clear();
  return answer;
}

std::optional<Diagnostic> StreamedProgram::check(std::string_view line) {
  const std::size_t kept = queue_.size();
  auto answer = read(line);
  answers_.record({});
  for (PathItem item; pull_answer(item);) {
    if (is_kind(item, Action::Kind::probe_end)) answers_.record(touched_at(std::get<Action>(item).place));
  }
  queue_.cut_to(kept);
  if (interpreter_->ended()) begin_after_end();
  return answer;
}

std::optional<Diagnostic> StreamedProgram::judge(std::string_view line) {
  const std::size_t kept = queue_.size();
  auto answer = read(line);
  if (!answer) roll_back(kept);
  return answer;
}

std::optional<Diagnostic> StreamedProgram::queue_line(std::string_view line, Seconds now, bool jogs) {
  const std::size_t kept = queue_.size();
  answer_fault_.reset();
  auto answer = read(line, jogs);
  if (answer) return answer;
  if (!queue_.empty()) jogs_ = jogs;
  queue_.add_line(kept, now);
  if (interpreter_->ended() && !asks_) begin_after_end();
  return answer;
}

// Interprets a line, and queues what the line asks for. Of a line with an error, nothing stays.
std::optional<Diagnostic> StreamedProgram::read(std::string_view line, bool jogs) {
  const std::size_t kept = queue_.size();
  interpreter_->keep();
  builder_->keep();
  kept_words_ = operator_messages_;
  diagnostics_.clear();
  interpreter_->push_line(line);
  for (PathItem item; builder_->next(item);) {
    if (diagnostics_.any_error()) break;
    // As in grbl, a jog goes at the speed that it names.
    if (auto* const segment = std::get_if<Segment>(&item); segment != nullptr && jogs)
      segment->heeds.feed_override = false;
    queue_.push(item);
    asks_ = is_kind(item, Action::Kind::probe_begin);
    if (asks_) break;
  }
  if (!diagnostics_.any_error()) return {};
  const Diagnostic error = *first_error(diagnostics_);
  roll_back(kept);
  return error;
}

// Goes back to what was before the line that was read last.
void StreamedProgram::roll_back(std::size_t kept) {
  asks_ = false;
  for (PathItem item; builder_->next(item);) {
  }
  queue_.cut_to(kept);
  diagnostics_.clear();
  interpreter_->roll_back();
  builder_->roll_back();
  operator_messages_ = kept_words_;
}

bool StreamedProgram::next(PathItem& item) {
  if (!queue_.empty()) {
    item = queue_.pull();
  } else if (!pull_answer(item)) {
    item = Action{.kind = Action::Kind::await_line, .outputs = outputs_, .place = builder_->position()};
    return true;
  }
  if (const auto* action = std::get_if<Action>(&item)) {
    outputs_ = action->outputs;
  } else {
    last_mode_ = std::get<Segment>(item).mode;
  }
  line_number_ = std::visit([](const auto& what) { return what.source.line_number; }, item);
  return true;
}

// What comes after a question, once it is answered.
bool StreamedProgram::pull_answer(PathItem& item) {
  if (!asks_) return false;
  const bool has_end = interpreter_->ended();  // M2 stands in the line of the question
  if (builder_->next(item) && !diagnostics_.any_error()) return true;
  asks_ = false;
  answer_fault_ = first_error(diagnostics_);
  // A probe move that has met nothing ends a program in a file. Whoever has sent it decides what comes next, with all
  // modes as they were.
  for (PathItem rest; builder_->next(rest);) {
  }
  diagnostics_.clear();
  if (!interpreter_->ended()) return false;
  if (answer_fault_ && !has_end) {
    interpreter_->reopen();
    interpreter_->stand_at(builder_->position());
  } else {
    begin_after_end();
  }
  return false;
}

void StreamedProgram::drop(const Point& place) {
  operator_messages_ = {};
  queue_.clear();
  asks_ = false;
  builder_->stand_at(place);
  interpreter_->stand_at(place);
}

StreamedProgramRun::StreamedProgramRun(StreamedProgram& program, const MachineDescription& machine)
    : program_(program), smoother_(program, smoothness(machine), smoothing_share(machine)) {}

}  // namespace passo
