#include "machine_motor.hpp"

#include "named_files.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"

namespace passo {

Result<MotorSetup, std::string> machine_motor(const std::string& machine, const std::string& axis) {
  Diagnostics diagnostics;
  const auto description = load_machine_file(machine, diagnostics);
  show(diagnostics);
  if (!description) return Failure{machine + " is wrong"};
  if (axis.empty()) return Failure{"--axis is missing: expected one of " + machine};
  for (const AxisDescription& one : description->axes) {
    if (axis != std::string(1, letter_of(one.axis))) continue;
    auto setup = motor_setup(one);
    if (!setup) return Failure{fmt::format("{} does not describe the motor of {}", machine, axis)};
    return *setup;
  }
  return Failure{fmt::format("--axis: '{}' is not an axis of {}", axis, machine)};
}

}  // namespace passo
