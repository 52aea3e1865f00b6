#include "passo/activity/machine_plant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {

std::vector<TravelSwitch> home_switches(const MachineDescription& machine) {
  std::vector<TravelSwitch> switches;
  const Kinematics board = board_kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.home) continue;
    const auto add = [&](int input, std::size_t motor, double place) {
      const double scale = board.rows()[motor].steps.factor_of(axis.axis);
      const bool high = axis.home->toward_high == (scale > 0);
      const auto closes = std::llround(place * scale);
      const auto later = std::llround(axis.home->hysteresis * std::abs(scale));
      switches.push_back({.input = static_cast<std::uint16_t>(1U << static_cast<unsigned>(input)),
                          .motor = static_cast<std::uint8_t>(motor),
                          .at_high_end = high,
                          .closes_at = closes,
                          .opens_at = high ? closes - later : closes + later,
                          .bounce = axis.home->bounce});
    };
    add(axis.home->input, m, axis.home->switch_at);
    if (!axis.second) continue;
    add(axis.second->input, machine.second_motor_of(m), axis.home->switch_at - axis.second->square);
  }
  return switches;
}

// Where the motors truly stand, if the axes stand there. Second motors are skewed at first.
MotorSteps truth_at(const MachineDescription& machine, const Point& place) {
  MotorSteps steps = steps_at(machine, place);
  const Kinematics board = board_kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.second) continue;
    Point ahead = place;
    ahead[axis.axis] += axis.second->skew;
    const std::uint8_t second = machine.second_motor_of(m);
    steps[second] = std::llround(board.rows()[second].steps_at(ahead));
  }
  return steps;
}

std::uint16_t alarm_of(const AxisDescription& axis) {
  if (!axis.alarm_input) return 0;
  if (*axis.alarm_input == alarm_at_feed_hold) return input_hold;
  if (*axis.alarm_input == alarm_at_cycle_start) return input_start;
  return static_cast<std::uint16_t>(input_limit << *axis.alarm_input);
}

PinSetup pin_setup(const MachineDescription& machine) {
  const PinsDescription& pins = machine.pins;
  unsigned inputs = 0;
  for (std::size_t i = 0; i < pins.limits_high.size(); ++i) inputs |= pins.limits_high[i] ? 1U << i : 0U;
  if (pins.probe_high) inputs |= input_probe;
  if (pins.door_high) inputs |= input_door;
  if (pins.emergency_stop_high) inputs |= input_emergency_stop;
  if (pins.feed_hold_high) inputs |= input_hold;
  if (pins.cycle_start_high) inputs |= input_start;
  unsigned outputs = 0;
  if (pins.spindle_low) outputs |= spindle_on;
  if (pins.spindle_reverse_low) outputs |= spindle_reverse;
  if (pins.mist_low) outputs |= mist_on;
  if (pins.flood_low) outputs |= flood_on;
  if (pins.driver_enable_high) outputs |= inverted_enable;
  unsigned alarms = 0;
  for (const AxisDescription& axis : machine.axes) alarms |= alarm_of(axis);
  const unsigned motors = (1U << machine.motor_count()) - 1;
  return {.inputs = static_cast<std::uint16_t>(inputs),
          .steps = static_cast<std::uint8_t>(pins.step_low ? motors : 0U),
          .outputs = static_cast<std::uint8_t>(outputs),
          .drivers_rest = static_cast<std::uint8_t>(std::lround(pins.drivers_off_after.value() * 10)),
          .alarms = static_cast<std::uint16_t>(alarms),
          .filter = static_cast<std::uint8_t>(std::lround(pins.filter.value() * 1e6))};
}

StepTiming step_timing(const BoardDescription& board) {
  const auto sixteenths = [](Seconds time) {
    constexpr double hardly_more = 1e-6;
    return static_cast<std::uint8_t>(std::clamp(std::ceil(time.value() * 16e6 - hardly_more), 0.0, 255.0));
  };
  const double ticks = std::floor(board.clock.value() / board.highest_event_rate.value() * (1 + 1e-9));
  return {.pulse = sixteenths(board.windings ? Seconds(0) : board.step_pulse),
          .set_up = sixteenths(board.direction_setup),
          .hold = sixteenths(board.direction_hold),
          .event_ticks = static_cast<std::uint16_t>(std::min(ticks, 65535.0))};
}

SpindleModel spindle_model(const SpindleDescription& spindle) {
  return {.counts_per_turn = spindle.counts_per_turn,
          .run_up = spindle.run_up.value(),
          .droop = spindle.droop,
          .ripple = spindle.ripple,
          .ripple_rate = spindle.ripple_rate.value()};
}

ScrewModel screw_model(const AxisDescription& axis, const MotorRow& motor) {
  const double scale = motor.steps.factor_of(axis.axis);
  ScrewModel model{.backlash = axis.screw->backlash * scale};
  for (const ScrewDescription::Error& error : axis.screw->errors) {
    model.errors.push_back({.at = error.at * scale, .off = error.off * scale});
  }
  if (scale < 0) std::ranges::reverse(model.errors);
  return model;
}

namespace {

// The simulated setter: every tool touches it in the middle of the window.
TouchBox tool_setter_of(const ToolChangePlan& plan) {
  constexpr double radius = 10;  // mm
  TouchBox box;
  box.ranges[Axis::x] = {plan.measure_at->x - radius, plan.measure_at->x + radius};
  box.ranges[Axis::y] = {plan.measure_at->y - radius, plan.measure_at->y + radius};
  box.ranges[Axis::z].high = (plan.window_low + plan.window_high) / 2;
  return box;
}

}  // namespace

void fit(FittedPlant& plant, const MachineDescription& machine, const Point& stands_at,
         const std::vector<Touchable>& things) {
  plant.stand_at(truth_at(machine, stands_at));
  const Kinematics board = board_kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.screw) continue;
    const auto fit_screw = [&](std::size_t motor) { plant.fit_screw(motor, screw_model(axis, board.rows()[motor])); };
    fit_screw(m);
    if (axis.second) fit_screw(machine.second_motor_of(m));
  }
  plant.fit_spindle(spindle_model(machine.spindle));
  for (const TravelSwitch& one : home_switches(machine)) plant.add(one);
  for (const Touchable& thing : things) add(plant, thing, machine);
  if (!things.empty() || machine.tool_change == nullptr || !machine.tool_change->measure_at) return;
  add(plant, tool_setter_of(*machine.tool_change), machine);
}

IdealPlant plant_of(const MachineDescription& machine, const Point& stands_at, const std::vector<Touchable>& things) {
  IdealPlant plant;
  fit(plant, machine, stands_at, things);
  return plant;
}

namespace {

// Two phases on for full steps, and sines for all others.
Result<Excitation, std::string> excitation_of(const AxisDescription& axis) {
  const Rotor& rotor = axis.motor->curve.rotor();
  const double steps_per_turn = axis.steps_per_unit * 2 * std::numbers::pi / axis.motor->radians_per_unit;
  const double parts = steps_per_turn / rotor.steps_per_revolution;
  const long whole = std::lround(parts);
  if (whole < 1 || std::abs(parts - static_cast<double>(whole)) > 1e-6 * parts) {
    return Failure{fmt::format("{:g} steps of the driver to a full step", parts)};
  }
  return Excitation::named(whole == 1 ? "two-on" : fmt::format("microsteps:{}", whole));
}

}  // namespace

std::optional<MotorSetup> motor_setup(const AxisDescription& axis) {
  if (!axis.motor) return std::nullopt;
  const AxisMotor& motor = *axis.motor;
  const auto excitation = excitation_of(axis);
  if (!excitation) return std::nullopt;
  MotorSetup setup = measured_setup(motor.curve, *excitation);
  if (motor.driven) {
    setup = {.motor = motor.driven->data, .drive = motor.driven->drive, .excitation = *excitation};
    setup.damping = damping_of(motor.driven->data);
  }
  setup.load = motor.load;
  setup.detent = motor.detent;
  setup.weight = {axis.inverted ? -motor.weight.value : motor.weight.value};
  return setup;
}

namespace {

// The encoder is on the shaft, so its counts are those of the motor's steps, whichever way the axis is wired.
EncoderModel encoder_model(const AxisDescription& axis) {
  const double turns_per_unit = axis.motor->radians_per_unit / (2 * std::numbers::pi);
  return {.counts_per_step = axis.encoder->counts_per_turn * turns_per_unit / axis.steps_per_unit,
          .most_error = axis.encoder->most_error * axis.steps_per_unit,
          .closes_loop = axis.encoder->closes_loop};
}

}  // namespace

void fit_rotors(RotorPlant& plant, const MachineDescription& machine) {
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto setup = motor_setup(axis);
    if (!setup) continue;
    plant.fit_motor(m, *setup);
    if (axis.encoder) plant.fit_encoder(m, encoder_model(axis));
    if (!axis.second) continue;
    MotorSetup second = *setup;
    if (axis.second->inverted != axis.inverted) second.weight.value = -second.weight.value;
    plant.fit_motor(machine.second_motor_of(m), second);
    if (axis.encoder) plant.fit_encoder(machine.second_motor_of(m), encoder_model(axis));
  }
}

}  // namespace passo
