// Words that move the frame, or the machine, in programs that are levelled.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "passo/probing/levelled_program.hpp"

namespace passo {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string head = "G17 G21 G40 G80 G90 G94\n";

// 0.1 higher every 10 mm of X.
HeightMap rising() {
  return HeightMap({0, 100}, {0, 100}, {0, 1, 0, 1});
}

struct Written {
  std::string text;
  std::string words;
};
Written levelled(const std::string& program, const LevelOptions& wish = {}) {
  Written result;
  InterpreterOptions options;
  options.on_machine = true;
  Diagnostics diagnostics;
  write_levelled_program(ProgramReader::from_text("it", program), options, rising(), wish, diagnostics,
                         [&](std::string_view text) { result.text += text; });
  result.words = render(diagnostics, false);
  return result;
}

// The folder of cases that users met, beside the checkout.
std::string text_of_case(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/cases/language" / name;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(LevelledFrames, a_place_of_the_machine_stays_one) {
  const Written it =
      levelled("#5=0\nG90 F100\nG0 X10 Y10 Z5\nG1 Z-1\nX20\nG53 G0 Z-4\nG53 G0 X0 Y0\nG53 G1 X#5 Z[-2-1]\nM2\n");
  EXPECT_EQ(it.words, "");
  EXPECT_EQ(it.text,
            head + "G0 X10 Y10 Z5\nG1 Z-0.9 F100\nX20 Z-0.8\nG53 G0 Z-4\nG53 G0 X0 Y0\nG53 G1 X0 Z-3\nM5\nM2\n");
  EXPECT_THAT(levelled("G20 G90\nG53 G0 Z-0.12345\nM2\n").text, HasSubstr("\nG53 G0 Z-3.13563\n"));
}

TEST(LevelledFrames, nothing_gets_a_z_that_the_machine_has_set) {
  const Written it = levelled("G90 F100\nG0 X10 Y10 Z5\nG1 Z-1\nG53 G0 Z-4\nG0 X90 Y10\nG1 Z-1\nM2\n");
  EXPECT_THAT(it.text, HasSubstr("G53 G0 Z-4\nX90\nG1 Z-0.1\n"));
}

TEST(LevelledFrames, the_first_move_gets_no_z_before_the_program_gives_one) {
  const Written it = levelled("G21 G90 G54\nG0 X46 Y6\nZ12\nG1 Z-0.05 F500\nX60\nG0 Z12\nM2\n");
  EXPECT_EQ(it.words, "");
  EXPECT_EQ(it.text, head + "G54\nG0 X46 Y6\nZ12\nG1 Z0.41 F500\nX60 Z0.55\nG0 Z12\nM5\nM2\n");
  const Written feed = levelled("G90 G1 X46 Y6 F100\nM2\n");
  EXPECT_THAT(feed.text, HasSubstr("G1 X46 Y6 F100\n"));
  EXPECT_THAT(feed.words, HasSubstr("it:1:1: warning: the height map is not applied"));
}

TEST(LevelledFrames, the_work_system_and_the_tool_offset_in_force_stay_in_force) {
  const Written it = levelled("G90 F100\nG0 X10 Y10 Z5\nM2\n");
  EXPECT_THAT(it.text, Not(HasSubstr("G54")));
  EXPECT_THAT(it.text, Not(HasSubstr("G49")));
  EXPECT_THAT(levelled("G54\nG0 X1\nG55\nG54\nG59.1\nG92.1\nM2\n").text,
              HasSubstr("G54\nG0 X1\nG55\nG54\nG59.1\nG92.1\n"));
}

TEST(LevelledFrames, ways_home_stay_ways_home) {
  const char* const begin = "G90 F100\nG0 X50 Y10 Z5\nG1 Z-1\n";
  EXPECT_THAT(levelled(std::string(begin) + "X60\nG91 G28 Z0\nM2\n").text,
              HasSubstr("G1 Z-0.5 F100\nX60 Z-0.4\nG91 G28 Z0\nM5\n"));
  EXPECT_THAT(levelled(std::string(begin) + "G28\nG90\nG0 X1 Y1\nM2\n").text, HasSubstr("F100\nG28\nG0 X1 Y1\n"));
  EXPECT_THAT(levelled(std::string(begin) + "G30 Z3\nG0 X1\nM2\n").text,
              HasSubstr("F100\nG0 Z3\nG91 G30 Z0\nG90 X1\n"));
  EXPECT_THAT(levelled("G91 G28 X0 Y0 Z0\nM2\n").text, HasSubstr("G94\nG91 G28 X0 Y0 Z0\n"));
  EXPECT_THAT(levelled("G28.1\n" + std::string(begin) + "X40\nG30.1\nM2\n").text,
              HasSubstr("G30.1\n#5183=[#5183-0.400000]\n"));
  EXPECT_THAT(levelled("G28.1\nM2\n").text, HasSubstr("G94\nG28.1\nM5\n"));
}

TEST(LevelledFrames, a_distance_from_an_unknown_place_stays_a_distance) {
  const Written it = levelled("G91 F100\nG0 Z5\nX20 Y10\nG1 Z-6\nX30\nG0 Z6\nM2\n");
  EXPECT_THAT(it.text, HasSubstr("G94\nG91 G0 Z5\nX20 Y10\nG1 Z-5.8 F100\nX30 Z0.3\nG0 Z5.5\n"));
  EXPECT_THAT(it.words, HasSubstr("[level.place]"));
  EXPECT_THAT(levelled("G90 F100\nG0 X10 Y10 Z5\nG1 Z-1\nG53 G0 Z-4\nG91 G0 Z-1\nM2\n").text,
              HasSubstr("G53 G0 Z-4\nG91 Z-0.9\n"));
}

TEST(LevelledFrames, a_change_of_the_tool_length_hides_the_height) {
  const std::string program = "G90 F100\nG0 X10 Y10 Z0\nG1 Z-1\nG43 H1\nG1 X20\nZ-2\nM2\n";
  EXPECT_THAT(levelled(program).text, HasSubstr("Z-0.9 F100\nG43 H1\nG91 X10 Z0.1\nG90 Z-1.8\n"));
}

TEST(LevelledFrames, a_way_and_a_place_go_into_one_block) {
  EXPECT_THAT(levelled("G90 F100\nG0 X10 Y10 Z0\nG1 Z-1\nG55\nG1 X20\nM2\n").text,
              HasSubstr("G55\nX20 Z[#5422+0.1]\n"));
}

TEST(LevelledFrames, a_cycle_from_an_unknown_height_stays_a_cycle) {
  const Written it = levelled("G90 F100\nG53 G0 Z0\nG98 G81 X50 Y10 Z-2 R0.5\nX20\nG80\nG0 X0\nM2\n", {.holes = true});
  EXPECT_EQ(it.words, "");
  EXPECT_THAT(it.text, HasSubstr("G53 G0 Z0\nG98 G81 X50 Y10 Z-1.50000 R1.00000 F100\n"));
  EXPECT_THAT(it.text, HasSubstr("F100\nG98 G81 X20 Y10 Z-1.80000 R0.70000\nG0 X0\n"));
  const Written pecks =
      levelled("G90 F100\nG53 G0 Z0\nG98 G83 X50 Y10 Z-2 R0.5 Q1 D.3\nX20\nG80\nM2\n", {.holes = true});
  EXPECT_THAT(pecks.text, HasSubstr("G98 G83 X50 Y10 Z-1.50000 R1.00000 Q1.00000 D0.30000 F100\n"));
  EXPECT_THAT(pecks.text, HasSubstr("G98 G83 X20 Y10 Z-1.80000 R0.70000 Q1.00000\n")) << "D is of its own block";
}

// G30 stands where no rounded number is: with its end written, the circle might be a millionth of a degree.
TEST(LevelledFrames, a_full_circle_ends_where_it_begins) {
  EXPECT_THAT(levelled("G90 F100\nG0 X10 Y10 Z5\nG30\nG2 J-6.3\nM2\n").text, HasSubstr("G30\nG2 I0 J-6.3 F100\n"));
}

TEST(LevelledFrames, what_moves_the_zero_is_refused_with_its_word) {
  EXPECT_THAT(levelled("G90\nG0 Z5\nG10 L2 P1 Z1\nM2\n").words,
              HasSubstr("it:3:1: error: G10 L2 changes the work zero"));
  EXPECT_THAT(levelled("G90\nG10 L2 P2 Z0\nM2\n").words, HasSubstr("it:2:1: error: G10 L2 changes the work zero"));
  EXPECT_THAT(levelled("G90\nG10 L20 P1 Z0\nM2\n").words, HasSubstr("it:2:1: error: G10 L20 changes the work zero"));
  EXPECT_THAT(levelled("G90\nG0 Z5 G52 X0\nM2\n").words, HasSubstr("error"));
  EXPECT_THAT(levelled("G90\nG92 X0\nM2\n").words, HasSubstr("it:2:1: error: G92 changes the work zero"));
}

TEST(LevelledFrames, cases_of_users) {
  const std::string machine = text_of_case("level-g53.ngc");
  const std::string first = text_of_case("level-first-move.ngc");
  if (machine.empty() || first.empty()) GTEST_SKIP() << "no ../shared/cases here";
  EXPECT_THAT(levelled(machine).text, HasSubstr("\nG53 G0 Z-4\nG53 G0 X0 Y0\nM5\n"));
  EXPECT_THAT(levelled(first).text, HasSubstr("\nG0 X46 Y6\nZ12\n"));
}

}  // namespace
}  // namespace passo
