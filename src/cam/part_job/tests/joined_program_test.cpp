#include "passo/part_job/joined_program.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

JoinedOperation operation(std::string title, std::string body, std::int32_t tool,
                          const std::string& spindle = "12000") {
  return {.title = std::move(title),
          .program =
              "(part.ngc, by passo cam pocket)\n(tool 1: cutter 3 mm, 1 run)\nG17 G21 G40 G80 G90 G94\nG0 Z5\n\n"
              "M3 S" +
              spindle + "\nG4 P2 (the spindle reaches its speed)\n" + body + "M5\nG0 X0 Y0\nM2\n",
          .tools = {{tool, "cutter"}},
          .park = "X0 Y0"};
}

TEST(JoinedProgram, the_same_tool_continues_with_a_running_spindle) {
  JoinedProgram joined({"plate.ngc, by passo cam job"});
  joined.add(operation("first", "G1 X1\n", 3));
  joined.add(operation("second", "G1 X2\n", 3));
  EXPECT_EQ(joined.take(),
            "(plate.ngc, by passo cam job)\n\n(first)\nG17 G21 G40 G80 G90 G94\nG0 Z5\n(MSG, tool 3: cutter)\nT3 M6\n"
            "G0 Z5\nM3 S12000\nG4 P2 (the spindle reaches its speed)\nG1 X1\n\n(second)\nG17 G21 G40 G80 G90 G94\n"
            "G0 Z5\nG1 X2\n\nM5\nG0 X0 Y0\nM2\n");
}

TEST(JoinedProgram, a_new_speed_is_written) {
  JoinedProgram joined({});
  joined.add(operation("first", "G1 X1\n", 3));
  joined.add(operation("second", "G1 X2\n", 3, "8000"));
  const std::string text = joined.take();
  EXPECT_NE(text.find("M3 S8000\nG4 P2"), std::string::npos) << text;
}

TEST(JoinedProgram, another_tool_is_changed_at_the_park_position_with_a_stopped_spindle) {
  JoinedProgram joined({});
  joined.add(operation("first", "G1 X1\nG0 Z5\n", 3));
  joined.add(operation("second", "G1 X2\n", 4));
  const std::string text = joined.take();
  EXPECT_NE(text.find("G0 Z5\nM5\nG0 X0 Y0\n(MSG, tool 4: cutter)\nT4 M6\nG0 Z5\nM3 S12000\n"), std::string::npos)
      << text;
}

TEST(JoinedProgram, an_operation_of_two_tools_has_the_numbers_of_the_job) {
  JoinedOperation two{.title = "sign",
                      .program =
                          "G17 G21\nG0 Z5\n\n(MSG, tool 1: flat)\nT1 M6\nG0 Z5\nG1 X1\nM5\nG0 X0 Y0\n"
                          "(MSG, tool 2: V)\nT2 M6\nG0 Z5\nG1 X2\nM5\nG0 X0 Y0\nM2\n",
                      .tools = {{7, "flat cutter"}, {3, "V"}},
                      .park = "X0 Y0"};
  JoinedProgram joined({});
  joined.add(two);
  const std::string text = joined.take();
  const std::size_t first = text.find("T7 M6");
  EXPECT_LT(first, text.find("G1 X1")) << text;
  EXPECT_LT(text.find("G1 X1"), text.find("T3 M6")) << text;
  EXPECT_EQ(text.find("T1 M6"), std::string::npos);
  EXPECT_EQ(text.find("T2 M6"), std::string::npos);
}

TEST(JoinedProgram, a_program_of_one_tool_names_it_and_does_not_change_it) {
  JoinedProgram joined({"tool 3: cutter"}, JoinedProgram::Tools::in_spindle);
  joined.add(operation("first", "G1 X1\n", 3));
  joined.add(operation("second", "G1 X2\n", 3));
  EXPECT_EQ(joined.take(),
            "(tool 3: cutter)\n\n(first)\nG17 G21 G40 G80 G90 G94\nG0 Z5\n(MSG, tool 3: cutter)\nM3 S12000\n"
            "G4 P2 (the spindle reaches its speed)\nG1 X1\n\n(second)\nG17 G21 G40 G80 G90 G94\nG0 Z5\nG1 X2\n\nM5\n"
            "G0 X0 Y0\nM2\n");
}

TEST(JoinedProgram, lines_belong_to_operations) {
  JoinedProgram joined({"head"});
  joined.add(operation("first", "G1 X1\n", 3));
  joined.add(operation("second", "G1 X2\n", 3));
  const std::vector<std::uint32_t> lines = joined.first_lines();
  const std::string text = joined.take();
  ASSERT_EQ(lines.size(), 2U);
  std::uint32_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 8, "(second)") == 0) {
      EXPECT_EQ(line, lines[1] + 1);
    }
    if (text[at] == '\n') ++line;
  }
}

}  // namespace
}  // namespace passo
