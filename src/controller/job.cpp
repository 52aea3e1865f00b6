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

BoardOutputs board_outputs(const OutputState& state) {
  unsigned switches = 0;
  if (state.spindle != SpindleDirection::off) switches |= OutputSwitch::spindle_on;
  if (state.spindle == SpindleDirection::counterclockwise) switches |= OutputSwitch::spindle_reverse;
  if (state.mist) switches |= OutputSwitch::mist_on;
  if (state.flood) switches |= OutputSwitch::flood_on;
  const double rpm = std::clamp(std::round(state.revolutions_per_minute), 0.0, 65535.0);
  return {.switches = static_cast<std::uint8_t>(switches), .spindle_rpm = static_cast<std::uint16_t>(rpm)};
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
         Diagnostics& diagnostics)
    : path_options_(path_options(machine, program.name())),
      limits_(motion_limits(machine)),
      interpreter_(std::move(program), options, diagnostics),
      path_builder_(interpreter_, path_options_, diagnostics),
      watched_path_(path_builder_),
      smoother_(watched_path_),
      planner_(smoother_, limits_),
      watched_motion_(planner_),
      step_generator_(watched_motion_, step_options(machine)),
      watched_board_(step_generator_),
      machine_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock),
      link_(machine_, static_cast<std::uint8_t>(machine.axes.size())) {
  watched_path_.watch([this](const PathItem& item) { nominal_time_ += nominal_time_of(item, limits_); });
}

bool Job::advance() {
  if (link_.error() || !watched_board_.next(item_)) {
    link_.drain();
    return false;
  }
  if (const auto* segment = std::get_if<BoardSegment>(&item_)) {
    link_.send(*segment);
  } else {
    link_.send(board_outputs(std::get<Action>(item_).outputs));
  }
  return true;
}

}  // namespace passo
