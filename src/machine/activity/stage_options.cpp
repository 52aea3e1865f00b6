#include "passo/activity/stage_options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "passo/path/backlash_compensator.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

namespace {

std::uint8_t bit_of(const DigitalOutputDescription& output) {
  switch (output.pin) {
    case DigitalOutputDescription::Pin::flood: return OutputSwitch::flood_on;
    case DigitalOutputDescription::Pin::mist: return OutputSwitch::mist_on;
    case DigitalOutputDescription::Pin::direction: return OutputSwitch::spindle_reverse;
  }
  return 0;
}

MotionOutputOptions motion_output_options(const MotionOutputsDescription& machine) {
  MotionOutputOptions options;
  for (std::size_t i = 0; i < machine.digital.size(); ++i) {
    if (machine.digital[i]) options.digital[i] = bit_of(*machine.digital[i]);
  }
  if (machine.laser) options.laser = {.maximum_s = machine.laser->maximum_s, .minimum = machine.laser->minimum};
  return options;
}

}  // namespace

std::uint8_t kept_in_stops(const MachineDescription& machine) {
  unsigned kept = 0;
  for (const auto& output : machine.motion_outputs.digital) {
    if (output && output->stays_on) kept |= bit_of(*output);
  }
  return static_cast<std::uint8_t>(kept);
}

PathOptions path_options(const MachineDescription& machine, const std::string& program, const Point& start) {
  PathOptions options;
  for (const AxisDescription& axis : machine.axes) {
    options.axes.add(axis.axis);
    options.travel[axis.axis] = {.low = axis.travel_low, .high = axis.travel_high};
    options.velocity[axis.axis] = axis.velocity;
    options.surface_radius[axis.axis] = axis.surface_radius;
  }
  options.tolerance = machine.path_tolerance;
  options.turn_tolerance = machine.has_rotary_axis() ? machine.path_tolerance_deg : 0;
  options.spindle_limit = machine.tool.highest_rpm;
  options.spindle_run_up = machine.spindle.run_up;
  options.awaits_spindle_speed = machine.spindle.modbus != nullptr;
  options.threads_hold_speed = machine.spindle.counts_per_turn == 0;
  if (machine.park.at_end != ParkDescription::AtEnd::stay) options.end_height = machine.top_of_travel();
  if (machine.park.at_end == ParkDescription::AtEnd::park) options.park = machine.park.place;
  options.outputs = motion_output_options(machine.motion_outputs);
  options.file = program;
  options.start = start;
  return options;
}

InterpreterOptions on_machine(const MachineDescription& machine, InterpreterOptions options) {
  options.tool_change = machine.tool_change;
  options.hooks = machine.hooks;
  return options;
}

namespace {

AccelerationCurve falling_limit(const AxisDescription& axis) {
  constexpr int samples = 4096;
  if (!axis.follows_torque()) return {};
  std::vector<AccelerationCurve::Sample> all;
  for (int i = 0; i <= samples; ++i) {
    const MmPerSecond speed = axis.velocity * (static_cast<double>(i) / samples);
    all.push_back({.speed = speed, .acceleration = axis.motor->acceleration_at(speed)});
  }
  return AccelerationCurve::below(all, axis.acceleration);
}

}  // namespace

bool has_jerk_limit(const MachineDescription& machine) {
  return std::ranges::any_of(machine.axes, [](const AxisDescription& axis) { return axis.jerk > MmPerSecond3(0); });
}

Smoothness smoothness(const MachineDescription& machine) {
  return has_jerk_limit(machine) ? Smoothness::slow_bending : Smoothness::least_bending;
}

double smoothing_share(const MachineDescription& machine) {
  const Kinematics kinematics = kinematics_of(machine);
  const bool any = std::ranges::any_of(
      kinematics.rows(), [](const MotorRow& motor) { return motor.screw && motor.screw->can_take_up_in_motion(); });
  return any ? smoothing_share_with_backlash : 1;
}

MotionLimits motion_limits(const MachineDescription& machine) {
  MotionLimits limits;
  for (const AxisDescription& axis : machine.axes) {
    limits.velocity[axis.axis] = axis.velocity;
    limits.acceleration[axis.axis] = axis.acceleration;
    limits.jerk[axis.axis] = axis.jerk;
    limits.start_stop[axis.axis] = axis.start_stop;
    limits.falling[axis.axis] = falling_limit(axis);
  }
  return limits;
}

std::array<std::int64_t, max_motors> steps_at(const MachineDescription& machine, const Point& place, AxisSet downs) {
  const MotorPosition motors = kinematics_of(machine).motors(place, downs);
  std::array<std::int64_t, max_motors> steps{};
  for (std::size_t m = 0; m < steps.size(); ++m) steps[m] = std::llround(motors[m]);
  return steps;
}

namespace {

// Null: the axis is in proportion to its motor, or is taken for it.
std::shared_ptr<const ScrewMap> screw_map(const AxisDescription& axis) {
  if (!axis.screw || !axis.screw->is_compensated) return nullptr;
  std::vector<ScrewMap::Error> errors;
  for (const ScrewDescription::Error& error : axis.screw->errors) errors.push_back({error.at, error.off});
  return std::make_shared<const ScrewMap>(axis.screw->backlash, std::move(errors));
}

MotorRow row_of(const AxisDescription& axis, bool inverted) {
  return {.steps = {axis.axis, inverted ? -axis.steps_per_unit : axis.steps_per_unit}, .screw = screw_map(axis)};
}

// The motor of X turns by X + Y, that of Y by X - Y.
MotorRow row_of_core_xy(const AxisDescription& axis) {
  const double steps = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
  return {.steps = {{Axis::x, steps}, {Axis::y, axis.axis == Axis::x ? steps : -steps}}};
}

}  // namespace

Kinematics kinematics_of(const MachineDescription& machine) {
  Kinematics kinematics;
  for (const AxisDescription& axis : machine.axes) {
    const bool shares = machine.is_core_xy && (axis.axis == Axis::x || axis.axis == Axis::y);
    kinematics.add(shares ? row_of_core_xy(axis) : row_of(axis, axis.inverted));
  }
  return kinematics;
}

Kinematics board_kinematics_of(const MachineDescription& machine) {
  Kinematics kinematics = kinematics_of(machine);
  for (const AxisDescription& axis : machine.axes) {
    if (axis.second) kinematics.add(row_of(axis, axis.second->inverted));
  }
  return kinematics;
}

StepOptions step_options(const MachineDescription& machine) {
  StepOptions options;
  options.kinematics = kinematics_of(machine);
  options.bends = machine.motor_count() == machine.axes.size();
  options.clock = {.tick_rate = machine.board.clock, .highest_event_rate = machine.board.highest_event_rate};
  return options;
}

}  // namespace passo
