#include "passo/library/gcode.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo::v1 {
namespace {

std::vector<Operation> operations_of(const std::string& text) {
  OperationReader reader(Program::from_text(text, "part.ngc"));
  std::vector<Operation> all;
  for (Operation operation; reader.next(operation);) all.push_back(operation);
  for (const Finding& finding : reader.findings()) ADD_FAILURE() << describe(finding);
  return all;
}

// All operations of a kind.
template <class Kind>
std::vector<Kind> all_of(const std::vector<Operation>& operations) {
  std::vector<Kind> all;
  for (const Operation& operation : operations) {
    if (const auto* one = std::get_if<Kind>(&operation.what)) all.push_back(*one);
  }
  return all;
}

TEST(OperationReader, gives_moves_with_both_ends_their_feed_and_their_line) {
  const auto operations = operations_of("G21 G90\nG0 X10\nG1 Y5 F600\nG2 X20 Y5 I5 J0\nG91 G1 Z-1\nM2\n");
  const auto lines = all_of<operation::Line>(operations);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[0].rapid);
  EXPECT_EQ(lines[0].end, (Position{.x = 10}));
  EXPECT_FALSE(lines[1].rapid);
  EXPECT_EQ(lines[1].start, (Position{.x = 10}));
  EXPECT_EQ(lines[1].end, (Position{.x = 10, .y = 5}));
  EXPECT_NEAR(lines[1].feed.value, 10, 1e-12);
  EXPECT_EQ(lines[2].end, (Position{.x = 20, .y = 5, .z = -1}));
  const auto arcs = all_of<operation::Arc>(operations);
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_EQ(arcs[0].turns, -1);
  EXPECT_EQ(arcs[0].first_centre_mm, 15);
  EXPECT_EQ(arcs[0].start, lines[1].end);
  for (const Operation& operation : operations) {
    if (std::holds_alternative<operation::Arc>(operation.what)) {
      EXPECT_EQ(operation.line, 4U);
    }
  }
  EXPECT_EQ(all_of<operation::End>(operations).size(), 1U);
}

TEST(OperationReader, resolves_units_loops_and_expressions) {
  const auto operations = operations_of("G20\n#1 = 0\nO1 while [#1 LT 3]\nG0 X#1\n#1 = [#1 + 1]\nO1 endwhile\nM2\n");
  const auto lines = all_of<operation::Line>(operations);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NEAR(lines[2].end.x, 50.8, 1e-9);
}

TEST(OperationReader, gives_tools_spindle_coolant_dwell_and_messages) {
  const auto operations =
      operations_of("T3 M6\nS8000 M3\nM8\nG4 P1.5\n(MSG, hello)\nG64 P0.05\nM5 M9\nM64 P3\nM0\nM2\n");
  EXPECT_EQ(all_of<operation::ChangeTool>(operations).at(0).tool, 3);
  const auto spindles = all_of<operation::Spindle>(operations);
  ASSERT_GE(spindles.size(), 3U);
  EXPECT_TRUE(std::any_of(spindles.begin(), spindles.end(), [](const operation::Spindle& spindle) {
    return spindle.direction == operation::Spindle::Direction::clockwise && spindle.speed_rpm == 8000;
  }));
  EXPECT_EQ(spindles.back().direction, operation::Spindle::Direction::off);
  EXPECT_TRUE(all_of<operation::Coolant>(operations).at(0).flood);
  EXPECT_EQ(all_of<operation::Dwell>(operations).at(0).time_s, 1.5);
  const auto modes = all_of<operation::PathMode>(operations);
  ASSERT_FALSE(modes.empty());
  EXPECT_NEAR(modes.back().tolerance_mm, 0.05, 1e-12);
  EXPECT_EQ(all_of<operation::Stop>(operations).size(), 1U);
  bool says_hello = false;
  for (const operation::Message& message : all_of<operation::Message>(operations)) {
    says_hello = says_hello ||
                 (message.kind == operation::Message::Kind::message && message.text.find("hello") != std::string::npos);
  }
  EXPECT_TRUE(says_hello);
  std::vector<std::string> calls;
  for (const operation::Other& other : all_of<operation::Other>(operations)) calls.push_back(other.call);
  EXPECT_THAT(calls, testing::Contains(testing::HasSubstr("OUTPUT_BIT(3)")));
}

TEST(OperationReader, converts_to_machine_positions) {
  OperationReader reader(Program::from_text("G10 L2 P1 X100 Y50 R90\nG54\nG0 X10 Y0\nG92 X0\nG0 X1\nM2\n"));
  std::vector<Position> machine;
  std::vector<Position> starts;
  for (Operation operation; reader.next(operation);) {
    if (const auto* line = std::get_if<operation::Line>(&operation.what)) {
      machine.push_back(reader.to_machine(line->end));
      starts.push_back(line->start);
    }
  }
  ASSERT_EQ(machine.size(), 2U);
  EXPECT_NEAR(machine[0].x, 100, 1e-9);
  EXPECT_NEAR(machine[0].y, 60, 1e-9);
  EXPECT_NEAR(starts[1].x, 0, 1e-9);
  EXPECT_NEAR(machine[1].y, 61, 1e-9);
}

TEST(OperationReader, gives_errors_with_their_places_and_goes_on) {
  OperationReader reader(Program::from_text("G1 X10\nG0 X20\nG0 Q3 X30\nG0 X40\nM2\n", "part.ngc"));
  std::size_t lines = 0;
  for (Operation operation; reader.next(operation);) {
    lines += std::holds_alternative<operation::Line>(operation.what) ? 1 : 0;
  }
  EXPECT_GE(lines, 2U);
  ASSERT_TRUE(reader.any_error());
  const std::vector<Finding> findings = reader.findings();
  ASSERT_GE(findings.size(), 2U);
  EXPECT_EQ(findings[0].code, "gcode.missing-feed");
  EXPECT_EQ(findings[0].file, "part.ngc");
  EXPECT_EQ(findings[0].line, 1U);
  EXPECT_EQ(findings[0].column, 1U);
  EXPECT_THAT(describe(findings[0]), testing::StartsWith("part.ngc:1:1: error: "));
  EXPECT_EQ(findings[1].line, 3U);
}

TEST(Program, that_cannot_be_opened_says_why) {
  const Outcome<Program> program = Program::open("/nowhere/part.ngc");
  ASSERT_FALSE(program);
  EXPECT_EQ(program.findings().front().severity, Severity::error);
  EXPECT_THAT(program.findings().front().message, testing::Not(testing::IsEmpty()));
  EXPECT_THROW(static_cast<void>(program.value()), std::bad_optional_access);
}

TEST(ReadOptions, name_files_whose_errors_are_findings) {
  OperationReader reader(Program::from_text("M2\n"), {.tool_table = "/nowhere/tool.tbl"});
  EXPECT_TRUE(reader.any_error());
}

}  // namespace
}  // namespace passo::v1
