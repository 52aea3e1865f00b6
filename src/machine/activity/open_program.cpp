#include "passo/activity/open_program.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/activity/nominal_time.hpp"
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

OpenProgram::OpenProgram(const MachineDescription& machine, InterpreterOptions options, const Point& start)
    : options_(std::move(options)),
      limits_(motion_limits(machine)),
      path_options_(path_options(machine, "line")),
      answers_(AnswerBook::Answers{}) {
  options_.open_ended = true;
  options_.on_machine = true;
  path_options_.open_ended = true;
  begin(start);
}

void OpenProgram::begin(const Point& start) {
  options_.start = path_options_.start = start;
  diagnostics_.clear();
  interpreter_ = std::make_unique<Interpreter>(ProgramReader::from_lines("line"), options_, diagnostics_, answers_);
  operations_ = std::make_unique<Tap<Operation>>(*interpreter_);
  operations_->watch([this](const Operation& operation) { wait_words_.watch(operation, interpreter_->tools()); });
  builder_ = std::make_unique<PathBuilder>(*operations_, path_options_, diagnostics_, answers_);
  asks_ = false;
}

void OpenProgram::restart(const Point& place) {
  forget_queue();
  options_.parameters = interpreter_->saved_parameters();
  for (int number = g92_active_parameter; number < work_system_parameter; ++number) options_.parameters.erase(number);
  options_.parameters[work_system_parameter] = 1;
  options_.units = LengthUnits::mm;
  begin(place);
}

void OpenProgram::go_on_at(const Point& place) {
  const SavedParameters parameters = interpreter_->saved_parameters();
  apply_offsets(parameters, place);
}

void OpenProgram::apply_offsets(const SavedParameters& parameters, const Point& place) {
  forget_queue();
  options_.parameters = interpreter_->saved_parameters();
  set_lasting_offsets(options_.parameters, parameters);
  begin_with(interpreter_->modes(), interpreter_->motion(), place);
}

void OpenProgram::forget_queue() {
  wait_words_ = {};
  queue_.clear();
  queued_time_ = Seconds(0);
  jogs_ = false;
  outputs_ = {};
}

// The outputs are off. F is given in G94: in inverse time it counts for its own line alone.
void OpenProgram::begin_with(const ModesInForce& modes, int motion, const Point& place) {
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
void OpenProgram::begin_after_end() {
  constexpr int feed_motion = 10;
  ModesInForce modes = interpreter_->modes();
  modes.codes = {"G1", "G54", "G17", modes.inches ? "G20" : "G21", "G90", "G94"};
  options_.parameters = interpreter_->saved_parameters();
  begin_with(modes, feed_motion, builder_->position());
  ended_ = true;
}

std::optional<Diagnostic> OpenProgram::add_line(std::string_view line, Seconds now) {
  return queue_line(line, now, false);
}

std::optional<Diagnostic> OpenProgram::add_jog(std::string_view words, Seconds now) {
  const ModesInForce modes = interpreter_->modes();
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

std::optional<Diagnostic> OpenProgram::check(std::string_view line) {
  const std::size_t kept = queue_.size();
  auto answer = read(line);
  answers_.record({});
  for (PathItem item; pull_answer(item);) {
    if (is_kind(item, Action::Kind::probe_end)) answers_.record(touched_at(std::get<Action>(item).place));
  }
  queue_.resize(kept);
  if (interpreter_->ended()) begin_after_end();
  return answer;
}

std::optional<Diagnostic> OpenProgram::judge(std::string_view line) {
  const std::size_t kept = queue_.size();
  auto answer = read(line);
  if (!answer) roll_back(kept);
  return answer;
}

std::optional<Diagnostic> OpenProgram::queue_line(std::string_view line, Seconds now, bool jogs) {
  const std::size_t kept = queue_.size();
  answer_fault_.reset();
  auto answer = read(line);
  if (answer) return answer;
  // As in grbl, a jog goes at the speed that it names.
  for (std::size_t i = kept; jogs && i < queue_.size(); ++i) {
    if (auto* const segment = std::get_if<Segment>(&queue_[i])) segment->heeds.feed_override = false;
  }
  if (!queue_.empty()) {
    jogs_ = jogs;
    last_came_ = now;
    if (kept == 0) first_came_ = now;
  }
  if (interpreter_->ended() && !asks_) begin_after_end();
  return answer;
}

// Interprets a line, and queues what the line asks for. Of a line with an error, nothing stays.
std::optional<Diagnostic> OpenProgram::read(std::string_view line) {
  const std::size_t kept = queue_.size();
  interpreter_->keep();
  builder_->keep();
  kept_words_ = wait_words_;
  diagnostics_.clear();
  interpreter_->push_line(line);
  for (PathItem item; builder_->next(item);) {
    if (diagnostics_.any_error()) break;
    push(item);
    asks_ = is_kind(item, Action::Kind::probe_begin);
    if (asks_) break;
  }
  if (!diagnostics_.any_error()) return {};
  const Diagnostic error = *first_error(diagnostics_);
  roll_back(kept);
  return error;
}

// Goes back to what was before the line that was read last.
void OpenProgram::roll_back(std::size_t kept) {
  asks_ = false;
  for (PathItem item; builder_->next(item);) {
  }
  while (queue_.size() > kept) {
    queued_time_ -= nominal_time_of(queue_.back(), limits_);
    queue_.pop_back();
  }
  diagnostics_.clear();
  interpreter_->roll_back();
  builder_->roll_back();
  wait_words_ = kept_words_;
}

void OpenProgram::push(const PathItem& item) {
  queued_time_ += nominal_time_of(item, limits_);
  queue_.push_back(item);
}

bool OpenProgram::room() const {
  if (asks_) return false;
  return queue_.size() < enough_items || (queue_.size() < most_items && queued_time_ < enough_time);
}

bool OpenProgram::is_to_begin(Seconds now) const {
  if (queue_.empty() && !asks_) return false;
  return !room() || now - last_came_ >= quiet || now - first_came_ >= longest_wait;
}

bool OpenProgram::expects_more(Seconds now) const {
  return room() && queue_.size() < enough_items && now - last_came_ < quiet;
}

bool OpenProgram::next(PathItem& item) {
  if (!queue_.empty()) {
    item = std::move(queue_.front());
    queue_.pop_front();
    queued_time_ = queue_.empty() ? Seconds(0) : queued_time_ - nominal_time_of(item, limits_);
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
bool OpenProgram::pull_answer(PathItem& item) {
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

void OpenProgram::drop(const Point& place) {
  wait_words_ = {};
  queue_.clear();
  queued_time_ = Seconds(0);
  asks_ = false;
  builder_->stand_at(place);
  interpreter_->stand_at(place);
}

OpenRun::OpenRun(OpenProgram& program, const MachineDescription& machine)
    : program_(program), smoother_(program, smoothness(machine)) {}

}  // namespace passo
