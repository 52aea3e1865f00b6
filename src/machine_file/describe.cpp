#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

// The acceleration at some speeds, where the motor's torque limits it.
std::string describe_torque(const AxisDescription& axis, const char* unit) {
  if (!axis.follows_torque()) return "";
  std::string line = fmt::format("                {:g} of pull-out:", axis.motor->share);
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const MmPerSecond speed = part * axis.velocity;
    line += fmt::format(" {:.4g} {unit}/s2 at {:g} {unit}/s{}", axis.acceleration_at(speed).value(), speed.value(),
                        part < 1 ? "," : "\n", fmt::arg("unit", unit));
  }
  return line;
}

std::string describe_home(const AxisDescription& axis, const char* unit) {
  if (!axis.home) return "";
  const HomeDescription& home = *axis.home;
  return fmt::format(
      "                homed at limit {} by its {} end, {:g} {unit}: {:g} {unit}/s, then {:g} {unit}/s; rests at {:g} "
      "{unit}\n",
      home.input + 1, home.toward_high ? "high" : "low", home.switch_at, home.seek.value(), home.latch.value(),
      home.rest(), fmt::arg("unit", unit));
}

std::string describe_axis(const AxisDescription& axis, std::size_t motor) {
  const char* unit = is_rotary(axis.axis) ? "deg" : "mm";
  std::string line = fmt::format(
      "axis {}          motor {}, {:g} steps/{unit}, {:.4g} {unit} a step, {:g} to {:g} {unit}, "
      "{:g} {unit}/s ({:.6g} steps/s), {:g} {unit}/s2",
      letter_of(axis.axis), motor, axis.steps_per_unit, axis.step().value(), axis.travel_low, axis.travel_high,
      axis.velocity.value(), axis.highest_step_rate().value(), axis.acceleration.value(), fmt::arg("unit", unit));
  if (axis.jerk > MmPerSecond3(0)) line += fmt::format(", {:g} {}/s3", axis.jerk.value(), unit);
  if (axis.start_stop > MmPerSecond(0)) {
    line += fmt::format(", starts and stops at {:g} {}/s ({:.6g} steps/s)", axis.start_stop.value(), unit,
                        axis.start_stop_rate().value());
  }
  if (axis.inverted) line += ", inverted";
  return line + "\n" + describe_torque(axis, unit) + describe_home(axis, unit);
}

std::string describe_tool(const ToolDescription& tool) {
  std::string line = fmt::format("tool            {}", tool.name.empty() ? "without a name" : tool.name);
  line += tool.highest_rpm > 0 ? fmt::format(", up to {:g} rpm", tool.highest_rpm) : ", a relay (on or off)";
  if (tool.diameter.value() > 0) line += fmt::format(", {:g} mm", tool.diameter.value());
  return line + "\n";
}

std::string describe_spindle(const SpindleDescription& spindle) {
  if (spindle.counts_per_turn == 0) return "";
  return fmt::format(
      "spindle         encoder of {} counts a turn; virtual: {:g} s to 1000 rpm, droop {:g} %, ripple {:g} % at "
      "{:g} Hz\n",
      spindle.counts_per_turn, spindle.run_up.value(), spindle.droop * 100, spindle.ripple * 100,
      spindle.ripple_rate.value());
}

}  // namespace

std::string describe(const MachineDescription& machine) {
  const BoardDescription& board = machine.board;
  std::string out = fmt::format("machine         {}\n", machine.name);
  out += fmt::format("path tolerance  {:g} mm\n", machine.path_tolerance.value());
  out +=
      fmt::format("board           clock {:.9g} Hz, {:.1f} to {:g} events/s, step pulse {:g} us\n", board.clock.value(),
                  board.lowest_event_rate().value(), board.highest_event_rate.value(), board.step_pulse.value() * 1e6);
  out += describe_tool(machine.tool);
  out += describe_spindle(machine.spindle);
  if (!machine.homing.empty()) {
    out += "homing          ";
    for (const Axis axis : machine.homing) out += letter_of(axis);
    out += ", one after the other\n";
  }
  for (std::size_t motor = 0; motor < machine.axes.size(); ++motor) out += describe_axis(machine.axes[motor], motor);
  return out;
}

}  // namespace passo
