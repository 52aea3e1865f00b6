#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

SurveyedMotor surveyed_motor(Axis axis, const MotorSetup& setup, double tolerance, double radians_per_unit,
                             RadiansPerSecond top) {
  Load load = setup.load;
  load.friction_per_speed.value += setup.damping.value;
  return {.axis = axis,
          .setup = setup,
          .tolerance = tolerance,
          .fastest = top,
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
    const RadiansPerSecond top{axis.velocity.value() * motor.radians_per_unit};
    motors.push_back(surveyed_motor(axis.axis, *setup, motor.tolerance, motor.radians_per_unit, top));
  }
  return motors;
}

StepGrid step_grid(const MachineDescription& machine) {
  StepGrid grid{.steps_per_unit = {}, .slow_rate = slow_event_rate(machine.board.highest_event_rate)};
  const Kinematics kinematics = kinematics_of(machine);
  for (const Axis axis : all_axes) grid.steps_per_unit[axis] = kinematics.steps_per_unit(axis);
  return grid;
}

}  // namespace passo
