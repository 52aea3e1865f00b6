// Letters of a font as closed lines: their size, their place, and what is wrong with a font.
#include "passo/cam/lettering.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/font_file.hpp"
#include "passo/cam/region.hpp"

namespace passo {
namespace {

const std::string& font_bytes() {
  static const std::string bytes = [] {
    std::ifstream file("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }();
  return bytes;
}

struct Lettered {
  Region face;
  std::string words;
};
Lettered lettered(const Lettering& lettering, const std::string& font = font_bytes()) {
  Diagnostics findings;
  const Drawing drawing = letter(lettering, "font", font, findings);
  Lettered result;
  if (!findings.all().empty()) result.words = render(findings, false);
  std::vector<std::vector<PathPoint>> loops;
  for (const DrawnPath& path : drawing.paths) loops.push_back(path.points);
  result.face = enclosed_by(loops);
  return result;
}
struct LetterBox {
  double left, low, right, high;
};
LetterBox box_of_letters(const Region& face) {
  const DrawnBox box = bounds(face).value_or(DrawnBox{});
  return {to_mm(box.least.x).value(), to_mm(box.least.y).value(), to_mm(box.most.x).value(), to_mm(box.most.y).value()};
}

TEST(Lettering, capitals_are_as_high_as_asked_and_stand_on_the_base_line) {
  const Lettered h = lettered({.text = "H", .height = Mm(12)});
  EXPECT_EQ(h.words, "");
  EXPECT_NEAR(box_of_letters(h.face).low, 0, 1e-6);
  EXPECT_NEAR(box_of_letters(h.face).high, 12, 1e-3);
  // An O has a hole, an i a dot.
  EXPECT_EQ(lettered({.text = "O"}).face.rings.size(), 2U);
  EXPECT_EQ(parts_of(lettered({.text = "i"}).face).size(), 2U);
}

TEST(Lettering, lines_are_aligned_and_go_down) {
  const auto box = [](LetterAlign align) { return box_of_letters(lettered({.text = "HH\nHH", .align = align}).face); };
  EXPECT_GT(box(LetterAlign::left).left, 0);
  EXPECT_NEAR(box(LetterAlign::middle).left, -box(LetterAlign::middle).right, 1e-3);
  EXPECT_LT(box(LetterAlign::right).right, 0);
  EXPECT_NEAR(box(LetterAlign::left).low, -16, 1e-6);
}

TEST(Lettering, pairs_are_kerned_and_arabic_letters_join) {
  const auto width = [](const char* text) {
    const LetterBox box = box_of_letters(lettered({.text = text}).face);
    return box.right - box.left;
  };
  EXPECT_LT(width("HAVH") + 0.1, width("HAH") + width("HVH") - width("HH"));
  // Two letters that join are one part.
  EXPECT_EQ(parts_of(lettered({.text = "\u0644\u0645"}).face).size(), 1U);
}

TEST(Lettering, stands_on_a_circle_outside_and_inside) {
  const Lettered top = lettered({.text = "HHH", .around = Mm(50)});
  const LetterBox above = box_of_letters(top.face);
  EXPECT_NEAR(above.left, -above.right, 1e-3);
  EXPECT_GT(above.high, 59.9);
  EXPECT_LT(above.high, 60.5);
  const LetterBox below = box_of_letters(lettered({.text = "HHH", .around = Mm(-50)}).face);
  EXPECT_NEAR(below.low, -50, 0.6);
  EXPECT_LT(below.high, -38);
}

TEST(Lettering, what_is_wrong_is_told) {
  EXPECT_THAT(lettered({.text = "A\u4e2d"}).words, testing::HasSubstr("the font has no glyph for '\u4e2d'"));
  EXPECT_THAT(lettered({.text = "A"}, "no font").words, testing::HasSubstr("[engrave.no-font]"));
  EXPECT_THAT(lettered({.text = "A"}, font_bytes().substr(0, 3000)).words, testing::HasSubstr("engrave.no-"));
  EXPECT_THAT(lettered({.text = "A", .height = Mm(1e9)}).words, testing::HasSubstr("[drawing.too-far]"));
}

// Font and file, or the finding.
std::string found_font(const std::string& wanted) {
  Diagnostics findings;
  const std::optional<FontFile> font = find_font(wanted, findings);
  return font ? font->name + " " + font->path.substr(font->path.rfind('/') + 1) : render(findings, false);
}

TEST(FontFile, an_installed_font_is_found_by_family_and_style) {
  EXPECT_EQ(found_font("DejaVu Sans"), "DejaVu Sans Book DejaVuSans.ttf");
  EXPECT_EQ(found_font("dejavu sans:Bold"), "DejaVu Sans Bold DejaVuSans-Bold.ttf");
  EXPECT_EQ(found_font("DejaVuSans:style=bold"), "DejaVu Sans Bold DejaVuSans-Bold.ttf");
  EXPECT_EQ(found_font(" DejaVu Sans Mono : regular "), "DejaVu Sans Mono Book DejaVuSansMono.ttf");
  EXPECT_THAT(found_font("monospace"), testing::HasSubstr(".ttf"));
}

TEST(FontFile, what_is_not_installed_is_told_with_what_is) {
  EXPECT_THAT(
      found_font("Dejavu Sanz"),
      testing::AllOf(testing::HasSubstr("no installed font has the family 'Dejavu Sanz'"),
                     testing::HasSubstr("a family such as DejaVu Sans"), testing::HasSubstr("[engrave.no-family]")));
  EXPECT_THAT(found_font("DejaVu Sans:style=Fat"),
              testing::AllOf(testing::HasSubstr("Bold, Bold Oblique, Book"), testing::HasSubstr("[engrave.no-style]")));
  EXPECT_THAT(found_font("DejaVu Sans:boldd"), testing::HasSubstr("'boldd' is not a style"));
  EXPECT_THAT(found_font(""), testing::HasSubstr("[engrave.no-family]"));
  EXPECT_THAT(found_font(":bold"), testing::HasSubstr("[engrave.no-family]"));
}

TEST(FontFile, a_file_is_no_family) {
  EXPECT_TRUE(names_font_file("a.TTF") && names_font_file("./Sans") && names_font_file("x.lff"));
  EXPECT_FALSE(names_font_file("DejaVu Sans:bold"));
}

}  // namespace
}  // namespace passo
