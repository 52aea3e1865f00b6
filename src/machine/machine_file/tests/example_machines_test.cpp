#include <cmath>

#include "passo/machine_file/machine_description.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"

namespace passo {
namespace {

MachineDescription example(const std::string& name) {
  Diagnostics diagnostics;
  auto machine = load_machine_file(std::string(PASSO_SOURCE_DIR) + "/examples/machines/" + name, diagnostics);
  EXPECT_EQ(render(diagnostics, false), "");
  return machine.value_or(MachineDescription{});
}

TEST(ExampleMachines, the_pantograph_makes_steps_of_a_hundredth_millimetre) {
  const MachineDescription machine = example("pantograph.toml");
  ASSERT_EQ(machine.axes.size(), 3U);
  for (const AxisDescription& axis : machine.axes) EXPECT_DOUBLE_EQ(axis.step().value(), 0.01);
  EXPECT_EQ(machine.board.clock, Hertz(16e6));
  EXPECT_EQ(machine.board.highest_event_rate, Hertz(50e3));
  EXPECT_EQ(machine.path_tolerance, Mm(0.02));
  EXPECT_EQ(machine.axes[0].velocity, MmPerSecond(25));
}

TEST(ExampleMachines, forty_eight_steps_move_a_millimetre) {
  const MachineDescription machine = example("forty-eight.toml");
  ASSERT_EQ(machine.axes.size(), 3U);
  for (const AxisDescription& axis : machine.axes) EXPECT_EQ(axis.steps_per_unit, 48);
  EXPECT_EQ(machine.axes[0].highest_step_rate(), Hertz(384));
  EXPECT_TRUE(machine.axes[2].inverted);
  EXPECT_EQ(machine.tool.highest_rpm, 0);
}

TEST(ExampleMachines, the_router_needs_640_microsteps_a_millimetre_at_100_mm_a_second) {
  const MachineDescription machine = example("router.toml");
  ASSERT_EQ(machine.axes.size(), 3U);
  for (const AxisDescription& axis : machine.axes) EXPECT_EQ(axis.steps_per_unit, 640);
  EXPECT_EQ(machine.axes[0].highest_step_rate(), Hertz(64000));
  EXPECT_EQ(machine.axes[2].velocity, MmPerSecond(50));
  EXPECT_EQ(machine.board.highest_event_rate, Hertz(100e3));
}

TEST(ExampleMachines, the_router_with_a_drive_has_it_on_a_bus) {
  const MachineDescription machine = example("router-vfd.toml");
  ASSERT_TRUE(machine.spindle.modbus);
  EXPECT_EQ(machine.spindle.modbus->drive, "h100");
  EXPECT_EQ(machine.spindle.modbus->highest_rpm, 24000);
  EXPECT_EQ(machine.spindle.modbus->lowest_rpm, 6000);
  EXPECT_EQ(machine.spindle.modbus->rpm_per_hertz(), 60);
}

TEST(ExampleMachines, the_bench_has_the_limits_that_its_table_tells) {
  const MachineDescription machine = example("bench.toml");
  ASSERT_EQ(machine.axes.size(), 3U);
  for (const AxisDescription& axis : machine.axes) {
    EXPECT_EQ(axis.steps_per_unit, 400);
    EXPECT_EQ(axis.velocity, MmPerSecond(axis.axis == Axis::z ? 50 : 100));
    EXPECT_EQ(axis.acceleration, MmPerSecond2(500));
    EXPECT_EQ(axis.jerk, MmPerSecond3(0));
  }
  EXPECT_EQ(machine.path_tolerance, Mm(0.01));
}

TEST(ExampleMachines, have_machine_zero_within_their_travel_so_that_programs_run_without_a_work_offset) {
  for (const char* name : {"pantograph.toml", "forty-eight.toml", "router.toml", "bench.toml", "strong-router.toml"}) {
    const MachineDescription machine = example(name);
    EXPECT_EQ(machine.axes.size(), 3U);
    for (const AxisDescription& axis : machine.axes) {
      EXPECT_LE(axis.travel_low, -30) << name;
      EXPECT_GE(axis.travel_high, 25) << name;
      if (axis.axis == Axis::z) continue;
      EXPECT_EQ(axis.travel_low, -axis.travel_high) << name;
    }
  }
}

TEST(ExampleMachines, brake_from_full_velocity_within_a_tenth_of_their_travel) {
  for (const char* name : {"pantograph.toml", "forty-eight.toml", "router.toml", "bench.toml", "strong-router.toml"}) {
    for (const AxisDescription& axis : example(name).axes) {
      const double braking = std::pow(axis.velocity.value(), 2) / (2 * axis.acceleration.value());
      EXPECT_LT(braking, (axis.travel_high - axis.travel_low) / 10) << name << " " << letter_of(axis.axis);
    }
  }
}

}  // namespace
}  // namespace passo
