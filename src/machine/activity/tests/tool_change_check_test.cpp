// The check follows the tool change of the machine.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "passo/activity/program.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

MachineDescription measuring_machine(ToolChangePlan plan) {
  MachineDescription machine;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    AxisDescription& one = machine.axes.emplace_back();
    one.axis = axis;
    one.steps_per_unit = 100;
    one.travel_low = -100;
    one.travel_high = 100;
    one.velocity = MmPerSecond(50);
    one.acceleration = MmPerSecond2(200);
  }
  machine.tool.highest_rpm = 10'000;
  plan.safe_z = 20;
  plan.measure_at = MachineXy{-50, -60};
  plan.window_low = -40;
  plan.seek = MmPerSecond(10);
  plan.latch = MmPerSecond(1);
  machine.tool_change = std::make_shared<const ToolChangePlan>(std::move(plan));
  return machine;
}

ProgramCheck check(const std::string& program, const MachineDescription& machine, Diagnostics& findings) {
  InterpreterOptions options;
  options.on_machine = true;
  return check_program(ProgramReader::from_text("t", program), machine, options, findings);
}

constexpr const char* first_cut = "G21 G90 G54\nG0 Z5\nT1 M6\nS9000 M3\nG4 P2\nG1 Z-1 F600\nG1 X10\nG0 Z5\n";

TEST(ToolChangeCheck, finds_nothing_wrong_in_a_change) {
  Diagnostics findings;
  EXPECT_TRUE(check(std::string(first_cut) + "M2\n", measuring_machine({}), findings).good);
  EXPECT_TRUE(findings.all().empty()) << render(findings, false);
}

TEST(ToolChangeCheck, finds_errors_in_the_lines_of_a_changer_before_anything_moves) {
  ToolChangePlan plan;
  plan.way = ToolChangeWay::macro;
  plan.macro = "G53 G0 X170\n";
  Diagnostics findings;
  EXPECT_FALSE(check(std::string(first_cut) + "M2\n", measuring_machine(plan), findings).good);
  ASSERT_TRUE(findings.any_error());
  EXPECT_EQ(findings.all().front().code, "travel.exceeded");
}

TEST(ToolChangeCheck, finds_a_change_inside_cutter_compensation) {
  Diagnostics findings;
  EXPECT_FALSE(
      check(std::string(first_cut) + "G41.1 D2 G1 X20\nT2 M6\nG40\nM2\n", measuring_machine({}), findings).good);
}

}  // namespace
}  // namespace passo
