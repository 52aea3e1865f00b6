// The check follows the tool change of the machine.
#include <memory>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "passo/activity/cut_meter.hpp"
#include "passo/activity/program.hpp"
#include "passo/interpreter/machine_results.hpp"
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

// The nominal time of a run, in which every tool touches at the same height.
Seconds time_of_run(const std::string& program, const MachineDescription& machine, int& inserted) {
  StoredResults results;
  results.record({.touched = true, .contact = Point{-50, -60, -30}, .rest = Point{-50, -60, -30.1}});
  Diagnostics findings;
  InterpreterOptions options;
  options.on_machine = true;
  Program run(ProgramReader::from_text("t", program), machine, options, results, findings);
  PathItem item;
  while (run.next(item)) {
    if (const auto* segment = std::get_if<Segment>(&item)) inserted += segment->source.inserted ? 1 : 0;
  }
  EXPECT_FALSE(findings.any_error()) << render(findings, false);
  return run.nominal_time();
}

// Otherwise a program would be done, by its progress, long before its last cut.
TEST(ToolChangeCheck, counts_no_time_for_what_the_machine_inserts) {
  // At the height to which the change returns.
  const std::string program =
      "G21 G90 G54\nG0 Z20\nT1 M6\nS9000 M3\nG1 Z-1 F600\nG1 X10\nG0 Z20\nT2 M6\nS8000 M3\nG1 Z-2\nG1 X40\nG0 "
      "Z20\nM2\n";
  ToolChangePlan rack;
  rack.way = ToolChangeWay::rack;
  rack.rack = {.pockets = 2, .first = {50, 50}, .step = {10, 0}, .z = -20, .feed = MmPerSecond(10)};
  ToolChangePlan macro;
  macro.way = ToolChangeWay::macro;
  macro.macro = "G53 G0 X70\nG4 P3\n";
  for (const ToolChangePlan& plan : {ToolChangePlan{}, rack, macro}) {
    SCOPED_TRACE(static_cast<int>(plan.way));
    MachineDescription machine = measuring_machine(plan);
    machine.hooks = {.at_start = "G53 G1 Y50 F300\nG53 G0 Y0\n", .at_end = "G53 G1 Y-50 F300\n"};
    Diagnostics findings;
    const ProgramCheck checked = check(program, machine, findings);
    ASSERT_TRUE(checked.good) << render(findings, false);
    int inserted = 0;
    EXPECT_NEAR(time_of_run(program, machine, inserted).value(), checked.nominal_time.value(), 1e-9);
    EXPECT_GT(inserted, 8);
  }
}

// The life of the tool that M61 names is counted; without a machine that measures, too.
TEST(ToolChangeCheck, m61_begins_to_count_for_its_tool_and_stops_for_nobody) {
  MachineDescription machine = measuring_machine({});
  machine.tool_change.reset();
  CutMeter meter;
  int stops = 0;
  Diagnostics findings;
  const std::string program = "G21 G90 G54\nM61 Q5\nS9000 M3\nG1 X30 F600\nM5\nM61 Q6\nM3\nG1 X10\nM2\n";
  ASSERT_TRUE(check_program(ProgramReader::from_text("t", program), machine, {}, findings, [&](const PathItem& item) {
                meter.watch(item, Seconds(0));
                const auto* action = std::get_if<Action>(&item);
                const bool changes = action != nullptr && action->kind == Action::Kind::tool_change;
                stops += changes && !action->by_machine ? 1 : 0;
              }).good);
  EXPECT_EQ(meter.amounts().at(5).length, Mm(30));
  EXPECT_EQ(meter.amounts().at(6).length, Mm(20));
  EXPECT_EQ(stops, 0);
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
