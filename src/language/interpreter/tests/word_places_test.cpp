// Operations carry the places of the words that ask for them.
#include "interpreted.hpp"
#include "kit/stage_test.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

// The text of the words that the last operation of this kind points at. With an axis, the text of that axis word.
template <class What>
std::string words_of(const std::string& program, std::optional<Axis> axis = std::nullopt) {
  Diagnostics diagnostics;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", program), {}, diagnostics);
  std::string found = "none";
  for (Operation operation; interpreter.next(operation);) {
    if (!std::holds_alternative<What>(operation.what)) continue;
    const WordPlace place = axis ? (*operation.axis_words)[*axis] : operation.word;
    found = place.column == 0 ? "" : operation.text.substr(place.column - 1, place.length);
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return found;
}

TEST(WordPlaces, a_move_has_all_words_of_its_block_and_each_axis_word) {
  const std::string program = "F100\n/ N30 G1 X [1 + 2] (x9) Y-4.5 ; and on\nM2\n";
  EXPECT_EQ(words_of<operation::StraightFeed>(program), "G1 X [1 + 2] (x9) Y-4.5");
  EXPECT_EQ(words_of<operation::StraightFeed>(program, Axis::x), "X [1 + 2]");
  EXPECT_EQ(words_of<operation::StraightFeed>(program, Axis::y), "Y-4.5");
  EXPECT_EQ(words_of<operation::StraightFeed>(program, Axis::z), "");
}

TEST(WordPlaces, a_letter_in_the_name_of_a_parameter_is_no_word) {
  EXPECT_EQ(words_of<operation::StraightFeed>("#<my>=1\nF100 G1 X#<my> y2\nM2\n", Axis::y), "y2");
}

TEST(WordPlaces, a_code_has_its_own_place) {
  EXPECT_EQ(words_of<operation::SetDigitalOutput>("M3 S100 M64 P1 G0 X1\nM2\n"), "M64");
  EXPECT_EQ(words_of<operation::SetSpindleSpeed>("M3 S100 M64 P1 G0 X1\nM2\n"), "S100");
  EXPECT_EQ(words_of<operation::StraightTraverse>("M3 S100 M64 P1 G0 X1\nM2\n"), "M3 S100 M64 P1 G0 X1");
}

TEST(WordPlaces, the_moves_of_a_cycle_have_those_of_its_block) {
  const std::string program = "F100 G91\nG81 X1 Z-2 R1 L500\nM2\n";
  EXPECT_EQ(words_of<operation::StraightFeed>(program), "G81 X1 Z-2 R1 L500");
  EXPECT_EQ(words_of<operation::StraightFeed>(program, Axis::z), "Z-2");
}

TEST(WordPlaces, the_moves_of_a_contour_have_those_of_the_lathe_cycle) {
  const std::string program = "G18 F100\nG0 X10 Z1\no1 sub\nG0 X5\nG1 Z-5\nX10 Z-6\no1 endsub\nG71 Q1 X10 Z1 I1\nM2\n";
  EXPECT_EQ(words_of<operation::StraightFeed>(program), "G71 Q1 X10 Z1 I1");
  EXPECT_EQ(words_of<operation::StraightFeed>(program, Axis::z), "Z1");
}

// These moves are given after other lines were read.
TEST(WordPlaces, moves_that_cutter_compensation_held_back_keep_theirs) {
  Diagnostics diagnostics;
  Interpreter interpreter(
      ProgramReader::from_text("test.ngc", "F100\nG41.1 D2\nG1 X10\nY-20 X11\nG1 Y-30.5\nG40\nM2\n"), {}, diagnostics);
  std::vector<std::string> words;
  for (Operation operation; interpreter.next(operation);) {
    if (!std::holds_alternative<operation::StraightFeed>(operation.what)) continue;
    const WordPlace place = (*operation.axis_words)[Axis::y];
    words.emplace_back(place.column == 0 ? "" : operation.text.substr(place.column - 1, place.length));
  }
  EXPECT_THAT(words, testing::ElementsAre("", "Y-20", "Y-30.5"));
}

}  // namespace
}  // namespace passo
