// Fonts of single lines: LibreCAD's and Hershey's, and text in their letters on lines, circles and arcs.
#include "passo/cam/stroke_font.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "passo/cam/lettering.hpp"

namespace passo {
namespace {

struct ReadFont {
  StrokeFont font;
  std::string words;
};
ReadFont read_font(std::string_view text) {
  Diagnostics findings;
  ReadFont result;
  result.font = read_stroke_font("font", text, findings);
  if (!findings.all().empty()) result.words = render(findings, false);
  return result;
}

constexpr const char* small_lff =
    "# Format: LibreCAD Font 1\n# LetterSpacing: 2\n# WordSpacing: 5\n\n"
    "[0048] H\n0,0;0,8\n4,0;4,8\n0,4;4,4\n\n[00c4]\nC0048\n2,9\n\n[[0044] D\n0,0;0,8;2,8;2,0A-1;0,0\n";

TEST(StrokeFonts, of_librecad_have_bulges_copies_and_spaces) {
  const ReadFont read = read_font(small_lff);
  EXPECT_EQ(read.words, "");
  EXPECT_DOUBLE_EQ(read.font.capital, 8);
  EXPECT_DOUBLE_EQ(read.font.letters.at(U'H').advance, 6);
  EXPECT_DOUBLE_EQ(read.font.letters.at(U' ').advance, 5);
  EXPECT_EQ(read.font.letters.at(U'\u00c4').strokes.size(), 4U);
  // The bulge of a point is that of the way to it.
  EXPECT_DOUBLE_EQ(read.font.letters.at(U'D').strokes[0][2].bulge, -1);
}

TEST(StrokeFonts, the_one_built_in_has_all_of_ascii) {
  const StrokeFont& font = built_in_stroke_font();
  EXPECT_EQ(font.letters.size(), 95U);
  EXPECT_DOUBLE_EQ(font.capital, 21);
  EXPECT_EQ(font.letters.at(U'H').strokes.size(), 3U);
  EXPECT_TRUE(font.letters.at(U' ').strokes.empty());
  EXPECT_EQ(font.letters.rbegin()->first, U'~');
}

TEST(StrokeFonts, what_is_wrong_is_told_with_its_line) {
  EXPECT_THAT(read_font("# LetterSpacing: 2\n[0048]\n0,0;x,8\n").words, testing::HasSubstr("font:3:5: error:"));
  EXPECT_THAT(read_font("# LetterSpacing: two\n").words, testing::HasSubstr("font:1:18: error:"));
  EXPECT_THAT(read_font("# LetterSpacing: 2\n0,0;1,8\n").words, testing::HasSubstr("before the first letter"));
  EXPECT_THAT(read_font("# LetterSpacing: 2\n[zz]\n").words, testing::HasSubstr("[font.syntax]"));
  EXPECT_THAT(read_font("# LetterSpacing: 2\n").words, testing::HasSubstr("no letters"));
  EXPECT_THAT(read_font("  699  1JZ\n  714  9MWRF").words, testing::HasSubstr("is incomplete"));
  EXPECT_FALSE(looks_like_stroke_font("#!/bin/sh"));
  EXPECT_FALSE(looks_like_stroke_font("12345 of them"));
}

TEST(StrokeFonts, characters_are_those_of_utf_8) {
  EXPECT_EQ(characters_of("A\u00c4\u4e2d\U0001F600"),
            (std::vector<char32_t>{U'A', U'\u00c4', U'\u4e2d', U'\U0001F600'}));
  EXPECT_EQ(characters_of("\xC3"), (std::vector<char32_t>{0xFFFD}));
}

std::string lettered_words(const Lettering& lettering, const char* font = small_lff) {
  Diagnostics findings;
  const Drawing drawing = letter(lettering, "font", font, findings);
  if (!findings.all().empty()) return render(findings, false);
  std::string words;
  for (const DrawnPath& path : drawing.paths) {
    for (const PathPoint& point : path.points) {
      words += std::to_string(std::lround(to_mm(point.at.x).value() * 100)) + ',' +
               std::to_string(std::lround(to_mm(point.at.y).value() * 100)) + ' ';
    }
    words += path.is_closed ? "closed\n" : "\n";
  }
  return words;
}

TEST(StrokeLettering, letters_stand_on_a_line_that_may_be_turned) {
  EXPECT_EQ(lettered_words({.text = "HH", .height = Mm(8)}),
            "0,0 0,800 \n400,0 400,800 \n0,400 400,400 \n600,0 600,800 \n1000,0 1000,800 \n600,400 1000,400 \n");
  EXPECT_EQ(lettered_words({.text = "H", .height = Mm(8), .turn_degrees = 90}),
            "0,0 -800,0 \n0,400 -800,400 \n-400,0 -400,400 \n");
  EXPECT_THAT(lettered_words({.text = "Hx"}), testing::HasSubstr("the font has no glyph for 'x'"));
}

// The angle of the middle of each letter of "HHH" on the circle, degrees.
std::vector<double> angles_on(double around, double from, double to) {
  Diagnostics findings;
  const Drawing drawing = letter({.text = "HHH", .height = Mm(8), .around = Mm(around), .arc = LetterArc{from, to}},
                                 "font", small_lff, findings);
  EXPECT_FALSE(findings.any_error());
  std::vector<double> angles;
  for (std::size_t i = 2; i < drawing.paths.size(); i += 3) {
    // The bar of an H is 4 mm high; its ends are 3 mm left and 1 mm right of the middle of its room.
    const auto at = [&](std::size_t end) { return drawing.paths[i].points[end].at; };
    const double x = to_mm(at(0).x).value() * 0.25 + to_mm(at(1).x).value() * 0.75;
    const double y = to_mm(at(0).y).value() * 0.25 + to_mm(at(1).y).value() * 0.75;
    EXPECT_NEAR(std::hypot(x, y), std::abs(around + 4), 1e-3);
    angles.push_back(std::atan2(y, x) * 180 / std::numbers::pi);
  }
  return angles;
}

TEST(StrokeLettering, an_arc_is_filled_from_angle_to_angle) {
  const double half = 3 / 60.0 * 180 / std::numbers::pi;  // of a letter's room of 6 mm
  EXPECT_THAT(angles_on(60, 180, 0),
              testing::ElementsAre(testing::DoubleNear(180 - half, 0.01), testing::DoubleNear(90, 0.01),
                                   testing::DoubleNear(half, 0.01)));
  EXPECT_THAT(angles_on(-60, 180, 0),
              testing::ElementsAre(testing::DoubleNear(-180 + half, 0.01), testing::DoubleNear(-90, 0.01),
                                   testing::DoubleNear(-half, 0.01)));
  EXPECT_THAT(lettered_words({.text = "HHHHH", .height = Mm(8), .around = Mm(60), .arc = LetterArc{100, 90}}),
              testing::HasSubstr("[engrave.too-long]"));
}

}  // namespace
}  // namespace passo
