#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"

namespace passo {
namespace {

// The acceleration at some speeds, where the motor's torque limits it.
std::string describe_torque(const AxisDescription& axis, const char* unit) {
  if (!axis.follows_torque()) return "";
  std::string line = fmt::format("                {:g} of pull-out:", axis.motor->share);
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const MmPerSecond speed = part * axis.velocity;
    line += fmt::format(" {} {unit}/s2 at {:g} {unit}/s{}", sensible_number(axis.acceleration_at(speed).value(), 4),
                        speed.value(), part < 1 ? "," : "\n", fmt::arg("unit", unit));
  }
  return line;
}

std::string describe_home(const AxisDescription& axis, const char* unit) {
  if (!axis.home) return "";
  const HomeDescription& home = *axis.home;
  return fmt::format(
      "                homed at limit {} by its {} end, {:g} {unit}: {:g} {unit}/s, then {:g} {unit}/s; stops at {:g} "
      "{unit}\n",
      home.input + 1, home.toward_high ? "high" : "low", home.switch_at, home.seek.value(), home.latch.value(),
      home.rest(), fmt::arg("unit", unit));
}

std::string describe_screw(const AxisDescription& axis, const char* unit) {
  if (!axis.screw) return "";
  std::string line = fmt::format("                screw with {:g} {} of backlash", axis.screw->backlash, unit);
  if (!axis.screw->errors.empty()) line += ", errors at " + counted(axis.screw->errors.size(), "place");
  return line + (axis.screw->is_compensated ? ", compensated\n" : ", not compensated\n");
}

std::string describe_second(const MachineDescription& machine, std::size_t index) {
  const AxisDescription& axis = machine.axes[index];
  if (!axis.second) return "";
  std::string line = fmt::format("                second motor {}", machine.second_motor_of(index));
  if (axis.second->inverted) line += ", inverted";
  if (axis.home) {
    line += fmt::format(", squared at limit {}, {:+g} {}", axis.second->input + 1, axis.second->square,
                        is_rotary(axis.axis) ? "deg" : "mm");
  }
  return line + "\n";
}

std::string describe_alarm(const AxisDescription& axis) {
  if (!axis.alarm_input) return "";
  const int input = *axis.alarm_input;
  const std::string place = input == alarm_at_feed_hold     ? "the pin of feed hold"
                            : input == alarm_at_cycle_start ? "the pin of cycle start"
                                                            : fmt::format("limit {}", input + 1);
  return fmt::format("                drive's alarm at {}\n", place);
}

// The pins that are on at another level than usual.
std::string describe_pins(const PinsDescription& pins) {
  std::string high;
  std::string low;
  const auto add = [](std::string& words, bool has, const std::string& word) {
    if (has) words += (words.empty() ? "" : ", ") + word;
  };
  for (std::size_t i = 0; i < pins.limits_high.size(); ++i)
    add(high, pins.limits_high[i], fmt::format("limit {}", i + 1));
  add(high, pins.probe_high, "probe");
  add(high, pins.door_high, "door");
  add(high, pins.emergency_stop_high, "emergency stop");
  add(high, pins.feed_hold_high, "feed hold");
  add(high, pins.cycle_start_high, "cycle start");
  add(high, pins.driver_enable_high, "drivers");
  add(low, pins.step_low, "step");
  add(low, pins.spindle_low, "spindle");
  add(low, pins.spindle_reverse_low, "spindle reverse");
  add(low, pins.mist_low, "mist");
  add(low, pins.flood_low, "flood");
  std::string out;
  if (!high.empty()) out += fmt::format("pins            on when high: {}\n", high);
  if (!low.empty()) out += fmt::format("pins            on when low: {}\n", low);
  if (pins.filter != PinsDescription().filter) {
    out += fmt::format("switches        filtered for {:g} us\n", pins.filter.value() * 1e6);
  }
  if (pins.drivers_off_after > Seconds(0)) {
    out += fmt::format("drivers         off {:g} s after the host's last message\n", pins.drivers_off_after.value());
  }
  if (pins.enable_wait > Seconds(0)) {
    out += fmt::format("drivers         ready {:g} s after they are enabled\n", pins.enable_wait.value());
  }
  return out;
}

// "ZXY, one after the other", or "Z (XY), those in parentheses at once".
std::string describe_homing(const MachineDescription& machine) {
  if (machine.homing.empty()) return "";
  std::string letters;
  bool any = false;
  for (std::size_t i = 0; i < machine.homing.size(); ++i) {
    const auto same = [&](std::size_t k) {
      return k < machine.homing_turns.size() && i < machine.homing_turns.size() &&
             machine.homing_turns[k] == machine.homing_turns[i];
    };
    const bool before = i > 0 && same(i - 1);
    const bool after = same(i + 1);
    any = any || after;
    if (after && !before) letters += '(';
    letters += letter_of(machine.homing[i]);
    if (before && !after) letters += ')';
  }
  return fmt::format("homing          {}, {}\n", letters,
                     any ? "those in parentheses together" : "one after the other");
}

std::string describe_encoder(const AxisDescription& axis, const char* unit) {
  if (!axis.encoder) return "";
  std::string line = fmt::format("                encoder with {} counts/rev", axis.encoder->counts_per_turn);
  if (axis.encoder->most_error > 0) line += fmt::format(", at most {:g} {} behind", axis.encoder->most_error, unit);
  return line + (axis.encoder->closes_loop ? ", closed loop\n" : "\n");
}

std::string describe_axis(const AxisDescription& axis, std::size_t motor) {
  const char* unit = is_rotary(axis.axis) ? "deg" : "mm";
  std::string line = fmt::format(
      "axis {}          motor {}, {:g} steps/{unit}, {:.4g} {unit}/step, {:g} to {:g} {unit}, {:g} {unit}/s ({:.6g} "
      "steps/s), {:g} {unit}/s2",
      letter_of(axis.axis), motor, axis.steps_per_unit, axis.step().value(), axis.travel_low, axis.travel_high,
      axis.velocity.value(), axis.highest_step_rate().value(), axis.acceleration.value(), fmt::arg("unit", unit));
  if (axis.jerk > MmPerSecond3(0)) line += fmt::format(", {:g} {}/s3", axis.jerk.value(), unit);
  if (axis.start_stop > MmPerSecond(0)) {
    line += fmt::format(", starts and stops at {:g} {}/s ({:.6g} steps/s)", axis.start_stop.value(), unit,
                        axis.start_stop_rate().value());
  }
  if (axis.inverted) line += ", inverted";
  if (axis.surface_radius) {
    line += *axis.surface_radius > Mm(0) ? fmt::format(", feed at a radius of {:g} mm", axis.surface_radius->value())
                                         : ", feed at the tool's radius";
  }
  return line + "\n" + describe_torque(axis, unit) + describe_home(axis, unit) + describe_screw(axis, unit) +
         describe_encoder(axis, unit);
}

std::string describe_tool(const ToolDescription& tool) {
  std::string line = fmt::format("tool            {}", tool.name.empty() ? "without a name" : tool.name);
  line += tool.highest_rpm > 0 ? fmt::format(", up to {:g} rpm", tool.highest_rpm) : ", a relay (on or off)";
  if (tool.diameter.value() > 0) line += fmt::format(", {:g} mm", tool.diameter.value());
  return line + "\n";
}

std::string describe_spindle_bus(const SpindleBusDescription& bus) {
  static constexpr char parities[] = {'N', 'E', 'O'};
  return fmt::format("spindle         {} by Modbus at {}, address {}, {} baud 8{}{}{}\n", bus.drive, bus.device,
                     bus.address, bus.baud, parities[static_cast<std::size_t>(bus.parity)], bus.stop_bits,
                     bus.drive == "huanyang" ? "; it has no time-out: it runs on if this computer fails" : "");
}

std::string describe_spindle(const SpindleDescription& spindle) {
  if (spindle.counts_per_turn == 0) {
    return spindle.run_up > Seconds(0) ? fmt::format("spindle         {:g} s to 1000 rpm\n", spindle.run_up.value())
                                       : "";
  }
  return fmt::format(
      "spindle         encoder with {} counts/rev; {:g} s to 1000 rpm; simulated: droop {:g} %, ripple {:g} % at {:g} "
      "Hz\n",
      spindle.counts_per_turn, spindle.run_up.value(), spindle.droop * 100, spindle.ripple * 100,
      spindle.ripple_rate.value());
}

std::string describe_tool_change(const ToolChangePlan& plan) {
  std::string line = "tool change     ";
  switch (plan.way) {
    case ToolChangeWay::setter: line += "by hand, tool setter"; break;
    case ToolChangeWay::plate: line += "by hand, touch plate"; break;
    case ToolChangeWay::rack: line += fmt::format("rack of {}", plan.rack.pockets); break;
    case ToolChangeWay::macro: line += "by lines of G-code"; break;
  }
  if (!plan.measures) return line + fmt::format(", not measured; across at Z{:g}\n", plan.safe_z);
  line += plan.measure_at ? fmt::format(" at X{:g} Y{:g}", plan.measure_at->x, plan.measure_at->y)
                          : std::string(" at the work's X0 Y0");
  line +=
      fmt::format(", touching at Z{:g} to Z{:g}, across at Z{:g}; ", plan.window_low, plan.window_high, plan.safe_z);
  switch (plan.use) {
    case LengthUse::absolute: line += fmt::format("lengths from the nose, Z{:g}", plan.setter_z); break;
    case LengthUse::reference: line += "lengths from the first tool"; break;
    case LengthUse::work: line += "the work's Z follows the tool"; break;
  }
  if (plan.touches > 1) line += fmt::format("; mean of {} touches within {:g} mm", plan.touches, plan.agreement);
  if (plan.wear) line += fmt::format("; used tools within {:g} mm", *plan.wear);
  return line + "\n";
}

std::string describe_handwheel(const HandwheelDescription& wheel) {
  std::string axes;
  for (const auto& axis : wheel.axes) axes += axis ? letter_of(*axis) : '-';
  return fmt::format("handwheel       axes {}, {:g} mm or degrees for {}, times 1, 10 and 100; up to {:g} %{}\n", axes,
                     wheel.step, counted(static_cast<std::size_t>(wheel.counts_per_detent), "count"), wheel.share * 100,
                     wheel.is_reversed ? ", reversed" : "");
}

std::string describe_hooks(const ProgramHooks& hooks) {
  if (hooks.empty()) return "";
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  return fmt::format("hooks           lines of G-code in each job: {} at the start, {} at the end\n",
                     lines(hooks.at_start), lines(hooks.at_end));
}

std::string describe_motion_outputs(const MotionOutputsDescription& outputs) {
  constexpr const char* pins[] = {"flood", "mist", "spindle direction"};
  std::string text;
  for (std::size_t i = 0; i < outputs.digital.size(); ++i) {
    if (!outputs.digital[i]) continue;
    text +=
        fmt::format("output {}        {}, {} in stops\n", i, pins[static_cast<std::size_t>(outputs.digital[i]->pin)],
                    outputs.digital[i]->stays_on ? "kept" : "off");
  }
  if (!outputs.laser) return text;
  text += fmt::format("laser           full power at S{:g}", outputs.laser->maximum_s);
  if (outputs.laser->minimum > 0) text += fmt::format(", at least {:g} %", outputs.laser->minimum * 100);
  return text + "\n";
}

std::string describe_park(const ParkDescription& park) {
  if (!park.place && park.at_end == ParkDescription::AtEnd::stay) return "";
  std::string line = "park            ";
  line += park.place ? fmt::format("X {:g} Y {:g} (machine)", (*park.place)[Axis::x], (*park.place)[Axis::y])
                     : std::string("no position");
  constexpr const char* ends[] = {"stay where they are", "raise the tool", "park the tool"};
  return line + fmt::format("; programs that end {}\n", ends[static_cast<std::size_t>(park.at_end)]);
}

}  // namespace

std::string describe(const MachineDescription& machine) {
  const BoardDescription& board = machine.board;
  std::string out = fmt::format("machine         {}\n", machine.name);
  if (machine.is_core_xy) out += "kinematics      CoreXY: X and Y share two motors; only a board with Grbl drives it\n";
  out += fmt::format("path tolerance  {:g} mm", machine.path_tolerance.value());
  out += machine.has_rotary_axis() ? fmt::format(", {:g} deg\n", machine.path_tolerance_deg) : "\n";
  out += fmt::format("board           clock {} Hz, {:.1f} to {} events/s, step pulse {:g} us\n",
                     sensible_number(board.clock.value()), board.lowest_event_rate().value(),
                     sensible_number(board.highest_event_rate.value()), board.step_pulse.value() * 1e6);
  out += describe_tool(machine.tool);
  out += describe_spindle(machine.spindle);
  if (machine.spindle.modbus) out += describe_spindle_bus(*machine.spindle.modbus);
  out += describe_motion_outputs(machine.motion_outputs);
  out += describe_pins(machine.pins);
  out += describe_homing(machine);
  if (machine.tool_change) out += describe_tool_change(*machine.tool_change);
  out += describe_hooks(machine.hooks);
  if (machine.handwheel) out += describe_handwheel(*machine.handwheel);
  out += describe_park(machine.park);
  for (std::size_t motor = 0; motor < machine.axes.size(); ++motor) {
    out += describe_axis(machine.axes[motor], motor) + describe_second(machine, motor) +
           describe_alarm(machine.axes[motor]);
  }
  return out;
}

}  // namespace passo
