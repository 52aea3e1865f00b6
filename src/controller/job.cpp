#include "passo/controller/job.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics) {
  const PathOptions path = path_options(machine, program.name());
  const MotionLimits limits = motion_limits(machine);
  Interpreter interpreter(std::move(program), options, diagnostics);
  PathBuilder builder(interpreter, path, diagnostics);
  ProgramCheck check;
  PathItem item;
  while (!diagnostics.full() && builder.next(item)) {
    check.nominal_time += nominal_time_of(item, limits);
    if (std::holds_alternative<Segment>(item)) ++check.moves;
  }
  check.tools_change = interpreter.tools() != options.tools;
  check.good = !diagnostics.any_error();
  return check;
}

Job::Job(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
         Diagnostics& diagnostics, const std::optional<LineOptions>& line)
    : path_options_(path_options(machine, program.name())),
      limits_(motion_limits(machine)),
      interpreter_(std::move(program), options, diagnostics),
      path_builder_(interpreter_, path_options_, diagnostics),
      watched_path_(path_builder_),
      smoother_(watched_path_),
      machine_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock),
      line_(line ? std::optional<VirtualLine>(std::in_place, machine_, machine.board.clock, *line) : std::nullopt),
      drive_(smoother_, limits_, step_options(machine), machine_, board_line()) {
  if (line_) [[maybe_unused]]
    const bool used = drive_.use_tails({});
  watched_path_.watch([this](const PathItem& item) { nominal_time_ += nominal_time_of(item, limits_); });
}

BoardLine Job::board_line() {
  // A line may be slow, but a board that lives answers at once.
  if (line_) return {.port = &*line_, .care = {.answer_within = Seconds(0.05), .session = 1}};
  return {};
}

}  // namespace passo
