#include "passo/probing/levelled_program.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "passo/probing/probing_cycle.hpp"

namespace passo {
namespace {

using testing::HasSubstr;
using testing::Not;

// 0.1 higher every 10 mm of X.
const HeightMap& slope() {
  static const HeightMap map({0, 100}, {0, 100}, {0, 1, 0, 1});
  return map;
}

struct Levelled {
  std::string text;
  std::string words;
  LevelCount count;
};
Levelled level(std::string_view program, const HeightMap& map = slope(), const LevelOptions& wish = {}) {
  Levelled result;
  Diagnostics diagnostics;
  result.count = write_levelled_program(ProgramReader::from_text("it", std::string(program)), {}, map, wish,
                                        diagnostics, [&](std::string_view text) { result.text += text; });
  result.words = render(diagnostics, false);
  return result;
}

TEST(LevelledProgram, adds_the_height_to_each_move) {
  const Levelled it = level("G21 G90 F100\nG0 X10 Y0 Z5\nG1 Z-1\nX50\nG0 Z5\nM2\n");
  EXPECT_EQ(it.words, "");
  EXPECT_EQ(it.text, "G17 G21 G40 G80 G90 G94\nG0 X10 Y0 Z5\nG1 Z-0.9 F100\nX50 Z-0.5\nG0 Z5\nM5\nM2\n");
}

TEST(LevelledProgram, keeps_what_happens_between_the_moves) {
  const Levelled it = level(
      "(a part)\nG20\nG91 F10\nT3 M6\nM3 S5000\nM8\nG4 P0.5\nG0 Z1\n(MSG,look)\nG61\nG64 P0.001\nG1 "
      "X1\nM9\nM0\nG55\nM30\n");
  EXPECT_THAT(it.words, HasSubstr("X25.400 Y0.000 is assumed [level.place]"));
  for (const char* line : {"(a part)\n", "T3\n", "M6\n", "S5000.000\n", "M3\n", "M8\n", "G4 P0.5000\n", "G0 Z25.4\n",
                           "(MSG,look)\n", "G61\n", "G64 P0.02540\n", "G1 X25.4", "F254\n", "M9\n", "M0\n", "G55\n"}) {
    EXPECT_THAT(it.text, HasSubstr(line));
  }
}

TEST(LevelledProgram, switches_off_once) {
  const std::string moves = "G0 X10 Y0 Z5\nG1 Z0.1 F100\n";
  EXPECT_THAT(level("M3 S100 M8\nG0 X10 Y0 Z5\nG1 Z0 F100\nM5\nM9\nM2\n").text, HasSubstr(moves + "M5\nM9\nM2\n"));
  EXPECT_THAT(level("M3 S100\nM5\nM4\nG0 X10 Y0 Z5\nG1 Z0 F100\nM2\n").text,
              HasSubstr("M3\nM5\nM4\n" + moves + "M5\nM2\n"));
}

TEST(LevelledProgram, an_arc_stays_an_arc) {
  const Levelled it = level("G90 F100\nG0 X10 Y0 Z0\nG3 X10 Y0 I10 J0\nM2\n", slope(), {.tolerance = 0.1});
  EXPECT_EQ(it.words, "");
  EXPECT_THAT(it.text, HasSubstr("G3 X"));
  EXPECT_THAT(it.text, Not(HasSubstr("G1 ")));
  EXPECT_GT(it.count.moves_after, it.count.moves_before);
}

TEST(LevelledProgram, holes_keep_their_depths_unless_asked) {
  const char* const program =
      "G90 F100\nG0 X20 Y20 Z5\nG81 X50 Y50 Z-2 R1\nX70\nG80\nG0 Z5\nX0\nG1 Z-1\nX10\nG0 Z5\nM2\n";
  const Levelled kept = level(program);
  EXPECT_EQ(kept.count.holes, 2U);
  EXPECT_THAT(kept.text, HasSubstr("Z1.5\nG1 Z-2 F100\nG0 Z1.5\n"));
  EXPECT_THAT(kept.text, HasSubstr("Z1.7\nG1 Z-2\nG0 Z1.7\n"));
  EXPECT_THAT(kept.text, HasSubstr("Z-1\nX10 Z-0.9\n"));  // what is milled is levelled
  const Levelled levelled = level(program, slope(), {.holes = true});
  EXPECT_EQ(levelled.count.holes, 0U);
  EXPECT_THAT(levelled.text, HasSubstr("Z-1.5"));
  EXPECT_THAT(levelled.text, HasSubstr("Z-1.3"));
}

TEST(LevelledProgram, places_of_the_machine_stay) {
  const Levelled it = level("G90 F100\nG0 X100 Y0 Z0.5\nG53 G0 Z-20\nM2\n");
  EXPECT_THAT(it.text, HasSubstr("Z1.5\nG53 G0 Z-20\n"));
}

TEST(LevelledProgram, tool_lengths_stay_words) {
  const Levelled it = level("G90 F100\nT1 M6\nG43 H1\nG0 X10 Y0 Z5\nG1 X20\nG49\nM2\n");
  EXPECT_THAT(it.text, HasSubstr("G43 H1\nG0 X10 Y0 Z5\nG1 Z5.1 F100\nX20 Z5.2\nG49\n"));
}

TEST(LevelledProgram, an_upright_arc_becomes_chords) {
  const Levelled it = level("G90 F100\nG0 X10 Y0 Z0\nG18 G2 X20 Z0 I5 K0\nM2\n");
  EXPECT_EQ(it.words, "");
  EXPECT_GT(it.count.moves_after, 10U);
  EXPECT_THAT(it.text, Not(HasSubstr("G2 ")));
}

TEST(LevelledProgram, refuses_what_a_list_of_moves_cannot_say) {
  EXPECT_THAT(level("G90 F100\nG38.2 Z-5\nM2\n").words, HasSubstr("it:2:1: error: the height map cannot be applied"));
  EXPECT_THAT(level("G90 F100\nG10 L2 P1 X5\nM2\n").words, HasSubstr("[level.offset]"));
  EXPECT_THAT(level("G90 F100\nG92 X5\nM2\n").words, HasSubstr("[level.offset]"));
  EXPECT_THAT(level("G90 F100\nG1 X200 Y0 Z0\nM2\n").words, HasSubstr("is 100.000 mm outside the height map"));
  EXPECT_EQ(level("G90 F100\nG0 X200 Y0\nM2\n").words, "");
}

TEST(LevelledProgram, loops_and_subprograms_are_written_out) {
  const Levelled it = level(
      "o1 sub\nG1 X#1 F100\no1 endsub\nG90 G0 X0 Y0 Z0\no2 repeat [3]\no1 call [10]\no1 call [20]\no2 endrepeat\nM2\n");
  EXPECT_EQ(it.words, "");
  EXPECT_EQ(it.count.moves_before, 7U);
}

TEST(ProbingCycle, refuses_values_out_of_range) {
  for (const ProbingKind kind : all_probing_kinds()) {
    ProbingCycle cycle{.kind = kind};
    if (kind == ProbingKind::corner) cycle.side = "front-left";
    if (kind == ProbingKind::edge || kind == ProbingKind::angle) cycle.side = "x+";
    EXPECT_TRUE(probing_program(cycle)) << name_of(kind);
    for (const ProbingField& field : probing_fields()) {
      if (!field.is_of(kind)) continue;
      ProbingCycle wrong = cycle;
      field.value(wrong) = field.high * 2 + 1;
      const auto program = probing_program(wrong);
      ASSERT_FALSE(program) << field.name;
      EXPECT_THAT(program.error(), HasSubstr(std::string(field.name)));
    }
  }
  EXPECT_THAT(probing_program({.kind = ProbingKind::edge, .side = "z+"}).error(), HasSubstr("not 'z+'"));
  EXPECT_THAT(probing_program({.kind = ProbingKind::corner, .side = "left"}).error(), HasSubstr("front-left"));
}

}  // namespace
}  // namespace passo
