// Plots as a pen plotter would draw them: places, arcs, labels, line types, packed lines, and what is wrong with a
// plot.
#include "passo/cam/hpgl.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace passo {
namespace {

struct Plotted {
  Drawing drawing;
  std::string words;
};
Plotted plotted(std::string_view text, const HpglOptions& options = {}) {
  Diagnostics findings;
  Plotted result;
  result.drawing = read_hpgl("plot.plt", text, options, findings);
  if (!findings.all().empty()) result.words = render(findings, false);
  return result;
}
std::string places(const DrawnPath& path) {
  std::string text;
  for (const PathPoint& point : path.points) {
    text += std::to_string(point.at.x.count / 1000) + ',' + std::to_string(point.at.y.count / 1000);
    text += point.bulge == 0 ? " " : point.bulge > 0 ? "( " : ") ";
  }
  return text + (path.is_closed ? "closed" : "");
}
std::string all_places(std::string_view text) {
  const Plotted plot = plotted(text);
  std::string all = plot.words;
  for (const DrawnPath& path : plot.drawing.paths) all += places(path) + '\n';
  return all;
}

TEST(Hpgl, lines_go_where_the_pen_is_down) {
  EXPECT_EQ(all_places("IN;SP1;PU400,400;PD800,400,800,800;PU0,0;PD40,0;"),
            "10000,10000 20000,10000 20000,20000 \n0,0 1000,0 \n");
  // Relative places; lower case, blanks and no semicolons; a path that comes back is closed.
  EXPECT_EQ(all_places("in pa 0 0 pd pr 40 0 0 40 -40 0 0 -40 pu"), "0,0 1000,0 1000,1000 0,1000 closed\n");
  // Without a pen nothing is drawn, and the plotter says so.
  EXPECT_THAT(all_places("IN;SP0;PU0,0;PD40,0;"), testing::HasSubstr("[hpgl.no-drawing]"));
}

TEST(Hpgl, a_pen_that_goes_down_and_up_leaves_a_dot) {
  const auto dots = [](std::string_view text) {
    const Plotted plot = plotted(text);
    std::string all = plot.words;
    for (const DrawnHole& hole : plot.drawing.holes) {
      all += fmt::format("{}{},{} ", hole.diameter.count > 0 ? "circle " : "", hole.at.x.count / 1000,
                         hole.at.y.count / 1000);
    }
    return all;
  };
  EXPECT_EQ(dots("IN;PU40,80;PD;PU;PU0,0;PD;PU;"), "1000,2000 0,0 ");
  EXPECT_EQ(dots("IN;PU40,80;PD40,80;PU0,0;PD0,0,0,0;SP0;"), "1000,2000 0,0 ");
  EXPECT_EQ(dots("IN;PU40,80;PD"), "1000,2000 ") << "at the end of the plot";
  EXPECT_EQ(dots("IN;PU0,0;PD;PD40,0;PU;PD;PU;"), "") << "the line is already there";
  EXPECT_EQ(dots("IN;PU40,0;PD;CI20;PU;"), "circle 1000,0 ") << "the pen draws a circle and no middle";
  EXPECT_EQ(dots("IN;PU40,0;PD;AA0,0,90;PU;"), "");
  EXPECT_EQ(dots("IN;PU40,0;PD;EA80,40;PU;PU0,0;PD;LBA\x03;PU;"), "");
  EXPECT_EQ(dots("IN;SP0;PU40,80;PD;PU;SP1;PU0,0;PD;PU"), "0,0 ") << "without a pen there is no dot";
}

TEST(Hpgl, pens_are_layers) {
  const char* const text = "IN;SP1;PU0,0;PD40,0;SP3;PD80,0;";
  EXPECT_EQ(plotted(text).drawing.layers, (std::vector<std::string>{"pen 1", "pen 3"}));
  EXPECT_EQ(plotted(text, {.layers = {"pen 3"}}).drawing.paths.size(), 1U);
  EXPECT_EQ(plotted(text, {.scale = 2}).drawing.paths[0].points[1].at.x.count, 2'000'000);
}

TEST(Hpgl, arcs_and_circles_stay_arcs) {
  EXPECT_EQ(all_places("IN;PU40,0;PD;AA0,0,90;"), "1000,0( 0,1000 \n");
  EXPECT_EQ(all_places("IN;PU40,0;PD;AR-40,0,-180;"), "1000,0) -1000,0 \n");
  EXPECT_EQ(all_places("IN;PU40,0;PD;AT0,40,-40,0;"), "1000,0( -1000,0 \n");
  const Plotted circle = plotted("IN;PU400,400;CI200;");
  ASSERT_EQ(circle.drawing.holes.size(), 1U);
  EXPECT_EQ(circle.drawing.holes[0].diameter.count, 10'000'000);
  // A scaling that stretches makes an ellipse of chords of it.
  EXPECT_GT(plotted("IN;IP0,0,1000,2000;SC0,10,0,10;PU5,5;CI3;").drawing.paths.at(0).points.size(), 20U);
}

TEST(Hpgl, user_units_are_scaled_into_p1_and_p2) {
  EXPECT_EQ(all_places("IN;IP400,400,4400,4400;SC0,10,0,10;PU0,0;PD10,5;"), "10000,10000 110000,60000 \n");
  // Alike in X and Y, in the middle of the longer side.
  EXPECT_EQ(all_places("IN;IP0,0,8000,4000;SC0,10,0,10,1;PU0,0;PD10,10;"), "50000,0 150000,100000 \n");
  EXPECT_EQ(all_places("IN;IP0,0,400,400;SC0,10,0,5,2;PU0,0;PD1,1;"), "0,0 250,125 \n");
  EXPECT_EQ(all_places("IN;RO90;PU0,0;PD40,0;"), "0,0 0,1000 \n");
}

TEST(Hpgl, line_types_are_drawn_as_dashes) {
  const Plotted dashed = plotted("IN;IP0,0,6000,8000;PU0,0;LT2,4;PD1000,0;");  // a pattern of 400 units
  ASSERT_EQ(dashed.drawing.paths.size(), 3U);
  EXPECT_EQ(places(dashed.drawing.paths[1]), "10000,0 15000,0 ");
  EXPECT_EQ(plotted("IN;PU0,0;LT2,4;LT;PD1000,0;").drawing.paths.size(), 1U);
  // Lengths that are no binary fractions end, too.
  EXPECT_GT(plotted("IN;IP0,0,4600,2100;PU0,0;LT-8,7.91033;PD4000,0;PD4000,333.3").drawing.paths.size(), 30U);
}

// All that the labels' lines enclose, mm.
struct LabelBox {
  double left = 1e9, low = 1e9, right = -1e9, high = -1e9;
};
LabelBox box_of_label(std::string_view text) {
  const Plotted plot = plotted(text);
  EXPECT_EQ(plot.words, "");
  LabelBox box;
  for (const DrawnPath& path : plot.drawing.paths) {
    for (const PathPoint& point : path.points) {
      box.left = std::min(box.left, to_mm(point.at.x).value());
      box.right = std::max(box.right, to_mm(point.at.x).value());
      box.low = std::min(box.low, to_mm(point.at.y).value());
      box.high = std::max(box.high, to_mm(point.at.y).value());
    }
  }
  return box;
}

TEST(Hpgl, labels_have_the_size_the_place_and_the_direction_that_are_asked) {
  const LabelBox h = box_of_label("IN;SI1,2;PU400,400;LBHH\x03;");
  EXPECT_NEAR(h.low, 10, 0.01);
  EXPECT_NEAR(h.high, 30, 0.01);
  EXPECT_GT(h.left, 10);
  EXPECT_NEAR(h.right - h.left, 15 + 6.36, 0.5);  // a cell, and an H
  const LabelBox up = box_of_label("IN;SI1,2;DI0,1;PU400,400;LBHH\x03;");
  EXPECT_NEAR(up.right, 10, 0.01);
  EXPECT_GT(up.low, 10);
  // In the middle of the place; another end of labels; a second line.
  const LabelBox middle = box_of_label("IN;SI1,2;LO5;PU400,400;DT*;LBHHH*;");
  EXPECT_NEAR(middle.left + middle.right, 20, 0.01);
  EXPECT_NEAR(middle.low + middle.high, 20, 0.01);
  EXPECT_NEAR(box_of_label("IN;SI1,2;PU400,2000;LBH\r\nH\x03;").low, 10, 0.01);
  // The pen goes on behind the label.
  EXPECT_THAT(all_places("IN;SI1,2;PU0,0;LB \x03PD0,0;"), testing::HasSubstr("15000,0 0,0"));
}

TEST(Hpgl, packed_lines_are_unpacked) {
  // '=' absolute, '<' up: 40,40; then 40,0. Digits of base 64: 80 is 16 and a last 1.
  EXPECT_EQ(all_places("IN;PE<=O\xC0O\xC0O\xC0\xBF;"), "1000,1000 2000,1000 \n");
  EXPECT_EQ(all_places("IN;PE7<=OaOaOa_;"), "1000,1000 2000,1000 \n");
  EXPECT_THAT(all_places("IN;PE<=O;"), testing::HasSubstr("[hpgl.packed]"));
}

TEST(Hpgl, polygons_rectangles_and_curves) {
  EXPECT_EQ(all_places("IN;PU0,0;EA40,80;"), "0,0 1000,0 1000,2000 0,2000 closed\n");
  EXPECT_EQ(all_places("IN;PU0,0;PM0;PA40,0,40,40;PM2;EP;"), "0,0 1000,0 1000,1000 closed\n");
  EXPECT_EQ(all_places("IN;PU0,0;EW40,0,90;"), "0,0 1000,0( 0,1000 closed\n");
  EXPECT_GT(plotted("IN;PU0,0;PD;BZ0,400,400,400,400,0;").drawing.paths.at(0).points.size(), 10U);
}

TEST(Hpgl, escapes_of_plotters_and_printers_are_skipped) {
  EXPECT_EQ(all_places("\x1b%-12345X@PJL SET X=1\r\n@PJL ENTER\r\n\x1b"
                       "E\x1b%1BIN;PU0,0;PD40,0;\x1b%0A"),
            "0,0 1000,0 \n");
  EXPECT_EQ(all_places("\x1b.I81;;17:\x1b.(IN;PU0,0;PD40,0;"), "0,0 1000,0 \n");
}

TEST(Hpgl, what_is_wrong_is_told_with_its_place) {
  EXPECT_THAT(plotted("IN;\nPU0,0;PD40;").words,
              testing::HasSubstr("plot.plt:2:11: error: these positions have 1 number"));
  EXPECT_THAT(plotted("IN;PU0,0;PD4#0;").words, testing::HasSubstr("plot.plt:1:13: error: this is not a number of PD"));
  EXPECT_THAT(plotted("IN;LBnever").words, testing::HasSubstr("[hpgl.label]"));
  EXPECT_THAT(plotted("IN;SC0,0,0,0;").words, testing::HasSubstr("[hpgl.numbers]"));
  EXPECT_THAT(plotted("IN;AA1;").words, testing::HasSubstr("[hpgl.numbers]"));
  EXPECT_THAT(plotted("IN;PU1e;").words, testing::HasSubstr("[hpgl.syntax]"));
  EXPECT_THAT(plotted("IN;7").words, testing::HasSubstr("[hpgl.syntax]"));
  EXPECT_THAT(plotted("IN;PD9999999999,0;").words, testing::HasSubstr("[hpgl.syntax]"));
  const Plotted odd = plotted("IN;QQ1;IW0,0,1,1;PU0,0;PD40,0;");
  EXPECT_THAT(odd.drawing.notes, testing::ElementsAre("ignored: 1 clipping windows", "ignored: 1 unknown commands QQ"));
}

TEST(Hpgl, is_told_by_its_first_commands) {
  for (const char* const text :
       {"IN;SP1;", "DF;PA0,0;", "PU0,0;PD1,1;", "\x1b.(;IN;", "SP1PU0 0", "CO a circle;\nPU 5,5;", " \r\nIN;"}) {
    EXPECT_TRUE(looks_like_hpgl(text)) << text;
  }
  for (const char* const text :
       {"INCH,LZ\nT1C0.1", "G21\nG0 X1", "", "0\nSECTION", "INSIDE the house", "Past", "<svg/>", "M48\nINCH"}) {
    EXPECT_FALSE(looks_like_hpgl(text)) << text;
  }
}

}  // namespace
}  // namespace passo
