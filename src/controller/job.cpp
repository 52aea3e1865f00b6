#include "passo/controller/job.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/controller/machine_plant.hpp"
#include "passo/controller/stage_options.hpp"

namespace passo {
namespace {

// How long an item takes at its programmed speed, within the axes' top speeds but without ramps.
Seconds nominal_time_of(const PathItem& item, const MotionLimits& limits) {
  if (const auto* action = std::get_if<Action>(&item)) return action->dwell;
  const auto& segment = std::get<Segment>(item);
  const Point steepest = segment.curve.steepest();
  double speed = segment.speed.value();
  for (const Axis axis : all_axes) {
    if (steepest[axis] > 0) speed = std::min(speed, limits.velocity[axis].value() / steepest[axis]);
  }
  return speed > 0 ? segment.curve.length() / MmPerSecond(speed) : Seconds(0);
}

// So many moves behind a probe move are checked.
constexpr std::uint64_t most_moves_behind_a_probe = 10'000'000;

InterpreterOptions answered_by(const ProbeOutcome& outcome, InterpreterOptions options, Job::Probing probing) {
  if (probing == Job::Probing::by_board) options.probe = &outcome;
  return options;
}

PathOptions answered_by(const ProbeOutcome& outcome, PathOptions options, Job::Probing probing) {
  if (probing == Job::Probing::by_board) options.probe = &outcome;
  return options;
}

StepOptions step_options_at(const MachineDescription& machine, const Point& start) {
  StepOptions options = step_options(machine);
  options.start = start;
  return options;
}

bool is_probe(const PathItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr && action->kind == Action::Kind::probe_end;
}

// The check is not the whole program's.
void tell_end(Diagnostics& diagnostics, const std::string& file, const PathItem& item) {
  const std::uint32_t line = std::visit([](const auto& what) { return what.source.line; }, item);
  diagnostics.add({.severity = Severity::warning,
                   .code = "path.unchecked",
                   .file = file,
                   .place = {.line = line, .column = 0, .length = 1},
                   .message = "the check ends here, ten million moves behind a probe move",
                   .expected = "a loop that also ends where the probe is touched at the end of its move",
                   .text = {}});
}

}  // namespace

ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics, const std::function<void(const PathItem&)>& watch) {
  const PathOptions path = path_options(machine, program.name(), options.start);
  const MotionLimits limits = motion_limits(machine);
  Interpreter interpreter(std::move(program), options, diagnostics);
  PathBuilder builder(interpreter, path, diagnostics);
  ProgramCheck check;
  std::uint64_t behind_a_probe = 0;
  PathItem item;
  while (!diagnostics.full() && behind_a_probe < most_moves_behind_a_probe && builder.next(item)) {
    check.nominal_time += nominal_time_of(item, limits);
    if (std::holds_alternative<Segment>(item)) ++check.moves;
    if (watch) watch(item);
    if (check.probes) ++behind_a_probe;
    if (!check.probes && is_probe(item)) {
      check.probes = true;
      diagnostics.doubt_errors("if the probe is touched at the end of its move");
    }
  }
  if (behind_a_probe == most_moves_behind_a_probe) tell_end(diagnostics, path.file, item);
  diagnostics.doubt_errors({});
  check.tools_change = interpreter.tools() != options.tools;
  check.good = !diagnostics.any_error();
  return check;
}

Job::Job(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& interpretation,
         Diagnostics& diagnostics, const Options& options)
    : path_options_(
          answered_by(probe_outcome_, path_options(machine, program.name(), interpretation.start), options.probing)),
      limits_(motion_limits(machine)),
      interpreter_(std::move(program), answered_by(probe_outcome_, interpretation, options.probing), diagnostics),
      path_builder_(interpreter_, path_options_, diagnostics),
      good_path_(path_builder_, diagnostics),
      watched_path_(good_path_),
      smoother_(watched_path_, smoothness(machine)),
      machine_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock, machine.board.highest_event_rate,
               static_cast<std::size_t>(machine.board.held_items)),
      line_(options.line ? std::optional<VirtualLine>(std::in_place, machine_, machine.board.clock, *options.line)
                         : std::nullopt),
      drive_(smoother_, limits_,
             step_options_at(machine, options.resume_at ? options.resume_at->point : interpretation.start), machine_,
             board_line(options, line_)),
      resume_at_(options.resume_at),
      wants_encoder_(options.board != nullptr && machine.spindle.counts_per_turn > 0) {
  machine_.stand_at(resume_at_ ? resume_at_->steps : steps_at(machine, interpretation.start));
  if (options.board == nullptr) connect_plant(machine, options.plant);
  if (resume_at_) {
    drive_.begin_at(resume_at_->place);
  }
  const bool over_a_line = line_ || options.board != nullptr;
  if (over_a_line && !drive_.unsuited()) drive_.use_tails({});
  if (options.board != nullptr) follow_by_machine(static_cast<std::uint8_t>(machine.axes.size()));
  const bool has_encoder = machine.spindle.counts_per_turn > 0;
  if (has_encoder) drive_.use_encoder(machine.spindle.counts_per_turn);
  // Over a line no tap turns round with the spindle: it rests meanwhile, and its holder floats. With a limit of jerk a
  // change of speed is made before the next is asked for: too slow to turn round with a spindle.
  if (!over_a_line && has_encoder && !has_jerk_limit(machine)) {
    path_options_.tap_rest = &tap_rest_;
    path_options_.spindle_run_up = machine.spindle.run_up;
    drive_.tell_tap(tap_rest_);
  }
  watched_path_.watch([this](const PathItem& item) { nominal_time_ += nominal_time_of(item, limits_); });
  drive_.probe().tell(probe_outcome_);
  if (machine.probe.guards && options.probing == Probing::by_board) {
    drive_.go_live({});
    drive_.guard_by_probe();
  }
}

BoardLine Job::board_line(const Options& options, std::optional<VirtualLine>& line) {
  if (line) return BoardLine::to(*line);
  if (options.board == nullptr) return {};
  return BoardLine::to_board(*options.board, options.session, options.greeting);
}

void Job::connect_plant(const MachineDescription& machine, Plant* plant) {
  if (plant == nullptr) {
    own_plant_ = plant_of(machine, resume_at_ ? resume_at_->point : path_options_.start);
    plant = &own_plant_;
  }
  machine_.connect(*plant);
}

void Job::follow_by_machine(std::uint8_t motors) {
  shadow_.emplace(machine_, motors);
  if (drive_.refiller() == nullptr) return;
  drive_.refiller()->watch_executed(
      [this](const LinkItem& item) { std::visit([this](const auto& one) { shadow_->send(one); }, item); });
}

void Job::resume() {
  if (resume_at_ && drive_.refiller() != nullptr) drive_.switch_on(resume_at_->outputs, resume_at_->spindle_wait);
}

bool Job::advance() {
  const bool goes_on = drive_.advance();
  if (shadow_ && (!goes_on || drive_.state() == MotionDrive::State::held)) shadow_->drain();
  return goes_on;
}

std::optional<std::string> Job::unsuited() const {
  if (auto words = drive_.unsuited()) return words;
  const auto& status = link().status();
  if (link().error() || !status || !wants_encoder_ || (status->state & board_encodes) != 0) return {};
  return "it has no encoder, and [spindle] of the machine file tells of one";
}

}  // namespace passo
