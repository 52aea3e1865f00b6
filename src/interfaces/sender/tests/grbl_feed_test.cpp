#include "passo/sender/grbl_feed.hpp"

#include "grbl_program_lines.hpp"
#include "kit/example_machine.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/journal/reentry.hpp"
#include "passo/sender/grbl_program_check.hpp"

namespace passo {
namespace {

using testing::ElementsAre;

class GrblFeeds : public testing::Test {
 protected:
  // All lines up to the next stop, or to the end.
  static std::vector<std::string> lines_of(test::GrblProgramLines& program) {
    std::vector<std::string> lines;
    while (const auto line = program.next()) lines.push_back(line->text);
    return lines;
  }
  std::unique_ptr<test::GrblProgramLines> program(const std::string& text, bool waits = true) {
    const ProgramReader reader = ProgramReader::from_text("part.ngc", text);
    Diagnostics findings;
    EXPECT_TRUE(check_for_grbl(reader, machine_, options_, {}, findings).good) << render(findings, false);
    return std::make_unique<test::GrblProgramLines>(reader, machine_, options_, GrblTarget(), waits);
  }

  MachineDescription machine_ = test::example_machine("router");
  InterpreterOptions options_;
};

TEST_F(GrblFeeds, are_lines_with_a_wait_for_the_rest_at_their_end) {
  const auto part = program("G21 G90\nG0 X10\nG4 P2\nG1 X20 F600\nM2\n");
  std::vector<GrblFeed::Line> lines;
  while (const auto line = part->next()) lines.push_back(*line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].text.substr(0, 2), "G0");
  EXPECT_EQ(lines[0].line, 2U);
  EXPECT_EQ(lines[1].silence, Seconds(2)) << "the machine is silent as long as it dwells";
  EXPECT_EQ(lines[3].text, "G4P0");
  EXPECT_TRUE(part->ended());
}

TEST_F(GrblFeeds, wait_at_their_stops_until_somebody_goes_on) {
  const std::string text = "G21 G90\nG0 X10\n(MSG, turn it over)\nM0\nG0 X20\nM2\n";
  const auto part = program(text);
  const std::vector<std::string> before = lines_of(*part);
  ASSERT_EQ(part->feed.asks(), GrblFeed::Asks::operator_stop);
  EXPECT_EQ(part->feed.stop().source.line, 4U);
  EXPECT_EQ(part->path.operator_messages().at(4), "turn it over");
  EXPECT_EQ(before.back(), "G4P0");
  EXPECT_FALSE(part->ended());
  EXPECT_FALSE(part->next());
  part->feed.go_on();
  EXPECT_THAT(lines_of(*part), ElementsAre("X20", "G4P0"));
  EXPECT_TRUE(part->ended());
  const auto unasked = program(text, false);
  lines_of(*unasked);
  EXPECT_TRUE(unasked->ended()) << "nobody is asked";
}

TEST_F(GrblFeeds, begin_at_a_line_after_the_way_there) {
  const std::string text = "G21 G90\n(PRINT,before)\nG1 X10 F600\nG1 Y20\n(PRINT,behind)\nG1 X30\nM2\n";
  const auto part = program(text);
  std::vector<std::uint32_t> skipped;
  part->path.operations().watch([&](const Operation& operation) {
    if (part->feed.leads_in()) skipped.push_back(operation.source.line);
  });
  options_.start[Axis::x] = 50;
  const auto way = reentry_at_line(ProgramReader::from_text("part.ngc", text), machine_, options_, {.line = 4});
  ASSERT_TRUE(way);
  part->feed.begin_at(way->at, way->lead_in);
  std::vector<std::uint32_t> of;
  while (const auto line = part->next()) of.push_back(line->line);
  EXPECT_THAT(of, testing::Not(testing::Contains(3U)));
  EXPECT_THAT(of, testing::Contains(4U));
  EXPECT_THAT(of, testing::Contains(6U));
  EXPECT_THAT(skipped, testing::Contains(2U));
  EXPECT_THAT(skipped, testing::Not(testing::Contains(5U)));
}

TEST_F(GrblFeeds, that_such_a_machine_cannot_do_are_refused_at_the_line_once_for_each_reason) {
  Diagnostics findings;
  const auto mists = ProgramReader::from_text("part.ngc", "G21 G90 F60\nM7\nG0 Z5\nM9\nM7\nM2\n");
  GrblTarget target;
  target.has_mist = false;
  EXPECT_FALSE(check_for_grbl(mists, machine_, options_, target, findings).good);
  ASSERT_EQ(findings.errors(), 1U);
  const auto cannot = std::ranges::find(findings.all(), "grbl.cannot", &Diagnostic::code);
  ASSERT_NE(cannot, findings.all().end());
  EXPECT_EQ(cannot->place.line, 2U);
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
