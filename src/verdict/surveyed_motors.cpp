#include "passo/activity/machine_plant.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

namespace {

constexpr int most_coarse = 2;  // steps of the driver to a full step

}  // namespace

std::vector<SurveyedMotor> surveyed_motors(const MachineDescription& machine) {
  std::vector<SurveyedMotor> motors;
  for (const AxisDescription& axis : machine.axes) {
    const auto setup = motor_setup(axis);
    if (!setup) continue;
    const AxisMotor& motor = *axis.motor;
    const RadiansPerSecond fastest{axis.velocity.value() * motor.radians_per_unit};
    Load load = setup->load;
    load.friction_per_speed.value += setup->damping.value;
    motors.push_back({.axis = axis.axis,
                      .band = TorqueBand(*setup, motor.tolerance, fastest),
                      .load = load,
                      .inertia = setup->motor.rotor.inertia.value + load.inertia.value,
                      .weight = motor.weight.value,
                      .radians_per_unit = motor.radians_per_unit,
                      .coarse_steps = setup->excitation.steps_per_full_step() <= most_coarse});
  }
  return motors;
}

}  // namespace passo
