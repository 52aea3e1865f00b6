// Tools of the table in a program: selecting them, changing them, their offsets, and G10.
#include <functional>
#include <sstream>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/interpreter/used_tools.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

InterpreterOptions with_tools() {
  InterpreterOptions options;
  options.tools.name = "shop.tbl";
  Tool drill{.number = 3, .pocket = 12, .diameter = Mm(5)};
  drill.offset[Axis::z] = 40;
  Tool turning{.number = 8, .pocket = 1, .diameter = Mm(0.8), .front_angle_deg = 95, .orientation = 2};
  turning.offset[Axis::x] = -3;
  turning.offset[Axis::z] = 11;
  EXPECT_TRUE(options.tools.add(drill));
  EXPECT_TRUE(options.tools.add(turning));
  return options;
}

TEST(Tools, a_tool_that_is_not_in_the_table_is_an_error_that_names_both) {
  for (const char* const word : {"T4", "M61 Q4", "G43 H4", "G43.2 H4", "G10 L1 P4 Z1"}) {
    const Interpreted result = interpret_text(std::string(word) + "\nM2\n", with_tools());
    ASSERT_EQ(result.diagnostics.errors(), 1U) << word << result.rendered();
    const Diagnostic& error = result.diagnostics.all().front();
    EXPECT_EQ(error.code, "gcode.unknown-tool") << word;
    EXPECT_EQ(error.message, "there is no tool 4 in shop.tbl");
    EXPECT_EQ(error.text.substr(error.place.column - 1, error.place.length).back(), '4') << word;
  }
}

TEST(Tools, h0_is_the_tool_in_the_spindle) {
  const Interpreted result = interpret_text("T3 M6\nG43 H0\nM2\n", with_tools());
  EXPECT_EQ(result.last<operation::SetToolOffset>().offset[Axis::z], 40);
}

TEST(Tools, no_tool_is_always_there) {
  const Interpreted result =
      interpret_text("T3 M6\nT0 M6\nG43\nM61 Q0\nG43 H0\n(debug,#5400 #5403)\nM2\n", with_tools());
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"0.000000 0.000000\")"));
  for (const auto& set : result.all<operation::SetToolOffset>()) EXPECT_EQ(set.offset, Point());
}

TEST(Tools, m61_brings_what_the_table_says_of_the_tool) {
  const Interpreted result = interpret_text("M61 Q8\n(debug,#5400 #5401 #5410 #5411 #5413)\nG43\nM2\n", with_tools());
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"8.000000 -3.000000 0.800000 95.000000 2.000000\")"));
  EXPECT_EQ(result.last<operation::SetToolOffset>().offset[Axis::z], 11);
}

// #5401 … are of the tool in the spindle, in LinuxCNC 2.10 as in 2.9; #5081 … are 2.10's, for the offset in effect.
TEST(Tools, numbers_5081_on_are_the_offset_in_effect) {
  const auto messages = [](const std::string& program, const InterpreterOptions& options) {
    std::string text;
    std::istringstream calls(interpret_text(program + "M2\n", options).calls());
    for (std::string call; std::getline(calls, call);) {
      const std::size_t begin = call.find("MESSAGE(\"");
      if (begin != std::string::npos) text += call.substr(begin + 9, call.rfind('"') - begin - 9) + '\n';
    }
    return text;
  };
  const std::string look = "(debug,%d#5403 #5083)\n";
  EXPECT_EQ(messages("T3 M6\n" + look + "G43\n" + look + "G43 H8\n" + look + "G43.2 Z1\n" + look + "G43.1 Z5\n" + look +
                         "G10 L1 P3 Z7\n" + look + "G49\n" + look,
                     with_tools()),
            "40 0\n40 40\n40 11\n40 12\n40 5\n7 5\n7 0\n");
  InterpreterOptions inches = with_tools();
  inches.machine_units = LengthUnits::inch;
  EXPECT_EQ(messages("G21 G43.1 Z25.4 A3\n(debug,%d#5083 #5084)\n", inches), "1 3\n");
  const Interpreted set = interpret_text("#5083=2\nM2\n");
  EXPECT_EQ(set.diagnostics.all().front().code, "gcode.read-only-parameter") << set.rendered();
}

TEST(Tools, an_offset_moves_the_numbers_and_not_the_tool) {
  const Interpreted result = interpret_text("G0 Z50\nT3 M6 G43\n(debug,#5422 #<_abs_z>)\nM2\n", with_tools());
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"10.000000 50.000000\")"));
}

TEST(Tools, g43_2_adds_a_tool_or_a_length) {
  const Interpreted result = interpret_text("G43 H3\nG43.2 H8\nG43.2 Z1 Y2\nM2\n", with_tools());
  const Point offset = result.last<operation::SetToolOffset>().offset;
  EXPECT_EQ(offset[Axis::x], -3);
  EXPECT_EQ(offset[Axis::y], 2);
  EXPECT_EQ(offset[Axis::z], 52);
}

TEST(Tools, g10_sets_the_table_and_counts_with_the_next_g43) {
  const Interpreted result =
      interpret_text("T3 M6\nG43\nG10 L1 P3 Z7 R4\n(debug,#5403 #5410)\nG43\nM2\n", with_tools());
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"7.000000 8.000000\")"));
  const auto offsets = result.all<operation::SetToolOffset>();
  ASSERT_EQ(offsets.size(), 2U);
  EXPECT_EQ(offsets[0].offset[Axis::z], 40);
  EXPECT_EQ(offsets[1].offset[Axis::z], 7);
}

TEST(Tools, g10_l10_makes_the_position_the_given_one_in_a_turned_system_too) {
  const Interpreted result = interpret_text(
      "T3 M6\nG10 L2 P1 R30 X5\nG0 X10 Y20\nG10 L10 P3 X1 Y2\nG43\n(debug,#5420 #5421)\n"
      "G10 L10 P3 X4\nG43\n(debug,#5420 #5421)\nM2\n",
      with_tools());
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000 2.000000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"4.000000 2.000000\")"));
}

TEST(Tools, g10_that_is_wrong_changes_nothing) {
  for (const char* const wrong : {"G10 L1 P3", "G10 L1 P0 Z1", "G10 L1 P3 Z1 Q10", "G10 L1 P1.5 Z1", "G10 L1 Z1"}) {
    const Interpreted result = interpret_text(std::string(wrong) + "\nG43 H3\nM2\n", with_tools());
    EXPECT_EQ(result.diagnostics.errors(), 1U) << wrong << result.rendered();
    EXPECT_EQ(result.last<operation::SetToolOffset>().offset[Axis::z], 40) << wrong;
    EXPECT_TRUE(result.all<operation::SetToolTableEntry>().empty());
  }
}

TEST(Tools, g43_that_is_wrong_leaves_the_offset) {
  const Interpreted result = interpret_text("G43 H3\nG43 H4\n(debug,#<_tool_offset>)\nG0 Z1\nM2\n", with_tools());
  EXPECT_EQ(result.all<operation::SetToolOffset>().size(), 1U);
}

TEST(Tools, a_table_that_is_read_again_keeps_what_the_program_set) {
  const Interpreted result = interpret_text("G10 L1 P8 Z3\nG10 L0\nG43 H8\nM2\n", with_tools());
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_THAT(result.calls(), HasSubstr("RELOAD_TOOLDATA()\n"));
  EXPECT_EQ(result.last<operation::SetToolOffset>().offset[Axis::z], 3);
}

TEST(Tools, examples_are_those_of_rs274) {
  InterpreterOptions options;
  options.tools = example_tools();
  const Interpreted result = interpret_text("G20\nG43 H1\nG43 H2\nG43 H3\nG43 H4\nM2\n", options);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<double> inches;
  for (const auto& set : result.all<operation::SetToolOffset>()) inches.push_back(set.offset[Axis::z] / mm_per_inch);
  EXPECT_THAT(inches, testing::ElementsAre(testing::DoubleEq(0.511), testing::DoubleEq(0.1), testing::DoubleEq(1.273),
                                           testing::DoubleEq(0)));
  EXPECT_EQ(options.tools.find(3)->diameter, Mm(0.201 * mm_per_inch));
}

TEST(UsedTools, are_in_the_order_of_their_first_use_and_the_last_stands_for_all_others) {
  std::vector<std::int32_t> used;
  std::vector<std::size_t> places;
  for (const std::int32_t tool : {7, 3, 7, 9, 4, 3, 9}) {
    places.push_back(index_of_tool(used, tool, std::identity(), 3, [tool] { return tool; }));
  }
  EXPECT_THAT(used, testing::ElementsAre(7, 3, 9));
  EXPECT_THAT(places, testing::ElementsAre(0, 1, 0, 2, 2, 1, 2));
}

}  // namespace
}  // namespace passo
