#include "passo/activity/machine_plant.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

SurveyedMotor surveyed_motor(Axis axis, const MotorSetup& setup, double tolerance, double radians_per_unit,
                             RadiansPerSecond fastest) {
  Load load = setup.load;
  load.friction_per_speed.value += setup.damping.value;
  return {.axis = axis,
          .setup = setup,
          .tolerance = tolerance,
          .fastest = fastest,
          .band = TorqueBand(setup, tolerance),
          .load = load,
          .inertia = setup.motor.rotor.inertia.value + load.inertia.value,
          .weight = setup.weight.value,
          .radians_per_unit = radians_per_unit};
}

std::vector<SurveyedMotor> surveyed_motors(const MachineDescription& machine) {
  std::vector<SurveyedMotor> motors;
  for (const AxisDescription& axis : machine.axes) {
    auto setup = motor_setup(axis);
    if (!setup) continue;
    const AxisMotor& motor = *axis.motor;
    setup->weight = motor.weight;
    const RadiansPerSecond fastest{axis.velocity.value() * motor.radians_per_unit};
    motors.push_back(surveyed_motor(axis.axis, *setup, motor.tolerance, motor.radians_per_unit, fastest));
  }
  return motors;
}

StepGrid step_grid(const MachineDescription& machine) {
  StepGrid grid{.steps_per_unit = {}, .slow_rate = slow_event_rate(machine.board.highest_event_rate)};
  for (const AxisDescription& axis : machine.axes) grid.steps_per_unit[axis.axis] = axis.steps_per_unit;
  return grid;
}

}  // namespace passo
