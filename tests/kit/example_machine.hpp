// The machines of examples/, for tests of all stages together. A test program that includes this file must define
// PASSO_SOURCE_DIR.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "passo/activity/program.hpp"

namespace passo::test {

inline MachineDescription example_machine(const std::string& name) {
  Diagnostics diagnostics;
  auto machine = load_machine_file(PASSO_SOURCE_DIR "/examples/machines/" + name + ".toml", diagnostics);
  EXPECT_TRUE(machine) << render(diagnostics, false);
  return machine.value_or(MachineDescription());
}

// Adds jerk limits with which full acceleration is reached in 20 ms.
inline MachineDescription with_jerk_limits(MachineDescription machine) {
  for (AxisDescription& axis : machine.axes) axis.jerk = MmPerSecond3(axis.acceleration.value() / 0.02);
  return machine;
}

}  // namespace passo::test
