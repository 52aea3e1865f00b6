#include "passo/sender/grbl_program.hpp"

#include "kit/example_machine.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;

class GrblPrograms : public testing::Test {
 protected:
  // All lines up to the next stop, or to the end.
  static std::vector<std::string> lines_of(GrblProgram& program) {
    std::vector<std::string> lines;
    while (const auto line = program.next()) lines.push_back(line->text);
    return lines;
  }
  GrblProgram program(const std::string& text, bool waits = true) {
    const ProgramReader reader = ProgramReader::from_text("part.ngc", text);
    Diagnostics findings;
    EXPECT_TRUE(check_for_grbl(reader, machine_, options_, {}, findings).good) << render(findings, false);
    return {reader, machine_, options_, {}, waits};
  }

  MachineDescription machine_ = test::example_machine("router");
  InterpreterOptions options_;
};

TEST_F(GrblPrograms, are_lines_with_a_wait_for_the_rest_at_their_end) {
  GrblProgram part = program("G21 G90\nG0 X10\nG4 P2\nG1 X20 F600\nM2\n");
  std::vector<GrblProgram::Line> lines;
  while (const auto line = part.next()) lines.push_back(*line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].text.substr(0, 2), "G0");
  EXPECT_EQ(lines[0].line, 2U);
  EXPECT_EQ(lines[1].silence, Seconds(2)) << "the machine is silent as long as it dwells";
  EXPECT_EQ(lines[3].text, "G4P0");
  EXPECT_TRUE(part.ended());
  EXPECT_FALSE(part.stop());
}

TEST_F(GrblPrograms, wait_at_their_stops_until_somebody_goes_on) {
  const std::string text = "G21 G90\nG0 X10\n(MSG, turn it over)\nM0\nG0 X20\nM2\n";
  GrblProgram part = program(text);
  const std::vector<std::string> before = lines_of(part);
  ASSERT_TRUE(part.stop());
  EXPECT_EQ(part.stop()->line, 4U);
  EXPECT_EQ(part.stop()->words, "turn it over");
  EXPECT_EQ(before.back(), "G4P0");
  EXPECT_FALSE(part.ended());
  EXPECT_FALSE(part.next());
  part.go_on();
  EXPECT_THAT(lines_of(part), ElementsAre("X20", "G4P0"));
  EXPECT_TRUE(part.ended());
  GrblProgram unasked = program(text, false);
  lines_of(unasked);
  EXPECT_TRUE(unasked.ended()) << "nobody is asked";
}

TEST_F(GrblPrograms, begin_at_a_line_after_the_way_there) {
  const std::string text = "G21 G90\n(PRINT,before)\nG1 X10 F600\nG1 Y20\n(PRINT,behind)\nG1 X30\nM2\n";
  GrblProgram part = program(text);
  std::vector<std::uint32_t> printed;
  part.hear([&](const Operation& operation) {
    if (std::holds_alternative<operation::Print>(operation.what)) printed.push_back(operation.source.line);
  });
  options_.start[Axis::x] = 50;
  const auto way = reentry_at_line(ProgramReader::from_text("part.ngc", text), machine_, options_, {.line = 4});
  ASSERT_TRUE(way);
  part.begin_at(*way);
  std::vector<std::uint32_t> of;
  while (const auto line = part.next()) of.push_back(line->line);
  EXPECT_THAT(of, testing::Not(testing::Contains(3U)));
  EXPECT_THAT(of, testing::Contains(4U));
  EXPECT_THAT(of, testing::Contains(6U));
  EXPECT_THAT(printed, ElementsAre(5U)) << "what it says before is not heard";
}

TEST_F(GrblPrograms, that_such_a_machine_cannot_do_are_refused_at_the_line_once_for_each_reason) {
  Diagnostics findings;
  const auto probes = ProgramReader::from_text("part.ngc", "G21 G90 F60\nG38.3 Z-1\nG0 Z5\nG38.3 Z-1\nM2\n");
  EXPECT_FALSE(check_for_grbl(probes, machine_, options_, {}, findings).good);
  ASSERT_EQ(findings.errors(), 1U);
  const auto cannot = std::ranges::find(findings.all(), "grbl.cannot", &Diagnostic::code);
  ASSERT_NE(cannot, findings.all().end());
  EXPECT_EQ(cannot->place.line, 2U);
  EXPECT_EQ(cannot->text, "G38.3 Z-1");
}

TEST(GrblOffsets, become_those_of_the_program) {
  GrblMachine machine;
  machine.offsets["G54"] = Point{{{10, 20, -5}}};
  machine.offsets["G55"] = Point{{{25.4, 0, 0}}};
  machine.offsets["G92"] = Point{{{1, 0, 0}}};
  machine.offsets["TLO"] = Point{{{0, 0, 7}}};
  EXPECT_EQ(first_work_zero(machine), (Point{{{11, 20, -5}}}));
  InterpreterOptions options;
  set_offsets(options, machine);
  EXPECT_EQ(options.parameters.at(5220), 1);
  EXPECT_EQ(options.parameters.at(5221), 10);
  EXPECT_EQ(options.parameters.at(5223), -5);
  EXPECT_EQ(options.parameters.at(5241), 25.4);
  EXPECT_EQ(options.parameters.at(5210), 1);
  EXPECT_EQ(options.parameters.at(5211), 1);
  options.machine_units = LengthUnits::inch;
  set_offsets(options, machine);
  EXPECT_EQ(options.parameters.at(5241), 1) << "parameters are in the machine's unit";
  machine.offsets["G92"] = Point();
  set_offsets(options, machine);
  EXPECT_EQ(options.parameters.at(5210), 0);
}

}  // namespace
}  // namespace passo
