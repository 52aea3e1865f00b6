#include "passo/activity/machine_plant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"

namespace passo {

std::vector<TravelSwitch> home_switches(const MachineDescription& machine, Mm hysteresis) {
  std::vector<TravelSwitch> switches;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.home) continue;
    const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
    const bool high = axis.home->toward_high != axis.inverted;
    const auto closes = std::llround(axis.home->switch_at * scale);
    const auto later = std::llround(hysteresis.value() * axis.steps_per_unit);
    switches.push_back({.input = static_cast<std::uint16_t>(1U << static_cast<unsigned>(axis.home->input)),
                        .motor = static_cast<std::uint8_t>(m),
                        .at_high_end = high,
                        .closes_at = closes,
                        .opens_at = high ? closes - later : closes + later});
  }
  return switches;
}

SpindleModel spindle_model(const SpindleDescription& spindle) {
  return {.counts_per_turn = spindle.counts_per_turn,
          .run_up = spindle.run_up.value(),
          .droop = spindle.droop,
          .ripple = spindle.ripple,
          .ripple_rate = spindle.ripple_rate.value()};
}

std::optional<ScrewModel> screw_model(const AxisDescription& axis) {
  if (!axis.screw) return std::nullopt;
  const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
  ScrewModel model{.backlash = axis.screw->backlash * scale};
  for (const ScrewDescription::Error& error : axis.screw->errors) {
    model.errors.push_back({.at = error.at * scale, .off = error.off * scale});
  }
  if (scale < 0) std::ranges::reverse(model.errors);
  return model;
}

void fit(FittedPlant& plant, const MachineDescription& machine, const Point& stands_at,
         const std::vector<TouchBox>& boxes) {
  plant.stand_at(steps_at(machine, stands_at));
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    if (const auto screw = screw_model(machine.axes[m])) plant.fit_screw(m, *screw);
  }
  plant.fit_spindle(spindle_model(machine.spindle));
  for (const TravelSwitch& one : home_switches(machine)) plant.add(one);
  for (const TouchBox& box : boxes) plant.add(touch_body(box, machine));
}

IdealPlant plant_of(const MachineDescription& machine, const Point& stands_at, const std::vector<TouchBox>& boxes) {
  IdealPlant plant;
  fit(plant, machine, stands_at, boxes);
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

void fit_rotors(RotorPlant& plant, const MachineDescription& machine) {
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    if (const auto setup = motor_setup(machine.axes[m])) plant.fit_motor(m, *setup);
  }
}

}  // namespace passo
