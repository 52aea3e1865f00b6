#include "passo/cam/dxf.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

struct ReadDxf {
  Drawing drawing;
  Diagnostics found;
};
ReadDxf read_text(const std::string& text, const DxfOptions& options = {}) {
  ReadDxf result;
  result.drawing = read_dxf("board.dxf", text, options, result.found);
  return result;
}
// "0 CIRCLE 8 PADS 10 1.5": codes and values, divided by blanks, as the lines of a file.
std::string in_lines(const std::string& groups) {
  std::istringstream words(groups);
  std::string lines;
  for (std::string word; words >> word;) lines += word + "\n";
  return lines;
}
std::string entities(const std::string& groups, const std::string& before = "") {
  return in_lines(before + " 0 SECTION 2 ENTITIES " + groups + " 0 ENDSEC 0 EOF");
}
const std::string in_mm = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC";
DrawnPoint nm(std::int64_t x, std::int64_t y) {
  return {Nanometres{x}, Nanometres{y}};
}
std::string first_code(const ReadDxf& read) {
  return read.found.all().empty() ? "" : read.found.all().front().code;
}

TEST(Dxf, circles_and_points_are_holes) {
  const ReadDxf read = read_text(entities("0 CIRCLE 8 PADS 10 1.5 20 -2 40 0.4 0 POINT 8 VIAS 10 3 20 4 30 0", in_mm));
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.holes.size(), 2U);
  EXPECT_EQ(read.drawing.holes[0].at, nm(1'500'000, -2'000'000));
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{800'000});
  EXPECT_EQ(read.drawing.layers[read.drawing.holes[0].layer], "PADS");
  EXPECT_EQ(read.drawing.holes[1].diameter, Nanometres{0});
  EXPECT_TRUE(read.drawing.notes.empty());
}

// Five circles: red by its layer, by its own number, by a true colour, and by the colour of its block's INSERT.
const std::string coloured =
    "0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 CUT 70 0 62 1 0 LAYER 2 ENGRAVE 70 0 62 5 0 ENDTAB 0 ENDSEC "
    "0 SECTION 2 BLOCKS 0 BLOCK 2 CORNER 10 0 20 0 0 CIRCLE 5 2F 8 0 62 0 10 0 20 0 40 5 0 ENDBLK 0 ENDSEC "
    "0 SECTION 2 ENTITIES "
    "0 CIRCLE 5 A1 8 CUT 10 0 20 0 40 1 "
    "0 CIRCLE 5 a2 8 ENGRAVE 62 1 10 0 20 0 40 2 "
    "0 CIRCLE 5 A3 8 ENGRAVE 62 30 420 16711680 10 0 20 0 40 3 "
    "0 CIRCLE 5 A4 8 ENGRAVE 62 30 10 0 20 0 40 4 "
    "0 INSERT 5 A5 8 ENGRAVE 62 1 2 CORNER 10 100 20 0 "
    "0 ENDSEC 0 EOF";

std::vector<double> radii_of(const DxfOptions& options) {
  const ReadDxf read = read_text(in_lines(coloured), options);
  EXPECT_FALSE(read.found.any_error());
  std::vector<double> radii;
  for (const DrawnHole& hole : read.drawing.holes) radii.push_back(to_mm(hole.diameter).value() / 2);
  return radii;
}

TEST(Dxf, entities_are_selected_by_colour) {
  using testing::ElementsAre;
  EXPECT_THAT(radii_of({.colors = {"red"}}), ElementsAre(1, 2, 3, 5));
  EXPECT_THAT(radii_of({.colors = {"#F00"}}), ElementsAre(1, 2, 3, 5));
  EXPECT_THAT(radii_of({.colors = {"1"}}), ElementsAre(1, 2, 5)) << "a number of the palette is no true colour";
  EXPECT_THAT(radii_of({.colors = {"30"}}), ElementsAre(4));
  EXPECT_THAT(radii_of({.layers = {"ENGRAVE"}, .colors = {"red", "30"}}), ElementsAre(2, 3, 4, 5));
  const ReadDxf none = read_text(in_lines(coloured), {.colors = {"teal"}});
  EXPECT_TRUE(none.drawing.holes.empty());
  EXPECT_THAT(none.drawing.notes, testing::Contains("nothing that is read has the colour 'teal'"));
}

TEST(Dxf, entities_are_selected_by_layer_block_or_handle) {
  using testing::ElementsAre;
  EXPECT_THAT(radii_of({.names = {"cut"}}), ElementsAre(1));
  EXPECT_THAT(radii_of({.names = {"Corner"}}), ElementsAre(5));
  EXPECT_THAT(radii_of({.names = {"A2", "a4"}}), ElementsAre(2, 4));
  EXPECT_THAT(radii_of({.names = {"A5"}}), ElementsAre(5)) << "the handle of an INSERT is for all in its block";
  EXPECT_THAT(radii_of({.names = {"2F"}}), ElementsAre(5));
  EXPECT_THAT(radii_of({.colors = {"red"}, .names = {"ENGRAVE"}}), ElementsAre(2, 3, 5));
  const ReadDxf none = read_text(in_lines(coloured), {.names = {"A9"}});
  EXPECT_THAT(none.drawing.notes, testing::Contains("no layer, block or handle is 'A9'"));
}

TEST(Dxf, units_come_from_the_header_or_are_told_or_guessed) {
  const std::string circle = "0 CIRCLE 8 0 10 1 20 0 40 0.02";
  const ReadDxf inch = read_text(entities(circle, "0 SECTION 2 HEADER 9 $INSUNITS 70 1 0 ENDSEC"));
  EXPECT_EQ(inch.drawing.holes.at(0).at, nm(25'400'000, 0));
  EXPECT_EQ(inch.drawing.holes.at(0).diameter, Nanometres{1'016'000});
  const ReadDxf told = read_text(entities(circle, in_mm), {.unit = Mm(25.4), .layers = {}});
  EXPECT_EQ(told.drawing.holes.at(0).at, nm(25'400'000, 0));
  EXPECT_THAT(told.drawing.notes, testing::ElementsAre(testing::HasSubstr("as requested")));
  const ReadDxf silent = read_text(entities("0 CIRCLE 8 0 10 1 20 0 40 0.4"));
  EXPECT_THAT(silent.drawing.notes, testing::ElementsAre(testing::HasSubstr("mm is assumed")));
}

TEST(Dxf, a_drawing_that_is_off_by_ten_is_told) {
  const std::string circles = entities("0 CIRCLE 8 0 10 1 20 0 40 4 0 CIRCLE 8 0 10 26 20 0 40 4", in_mm);
  EXPECT_TRUE(read_text(circles).drawing.notes.empty()) << "parts have holes of any size";
  const ReadDxf wide = read_text(circles, {.is_for_drilling = true});
  EXPECT_THAT(wide.drawing.notes,
              testing::ElementsAre(testing::HasSubstr("off by a factor of 10: with a factor of 0.1")));
  std::string points;
  for (int i = 0; i < 8; ++i) points += "0 POINT 8 0 10 " + std::to_string(i * 25.4) + " 20 7 ";
  EXPECT_THAT(read_text(entities(points, in_mm), {.is_for_drilling = true}).drawing.notes,
              testing::ElementsAre(testing::HasSubstr("off by a factor of 10: with a factor of 0.1")));
  EXPECT_TRUE(read_text(entities(points, in_mm), {.unit = Mm(0.1), .layers = {}, .is_for_drilling = true})
                  .drawing.notes.size() == 1U);
}

TEST(Dxf, lines_arcs_and_polylines_are_paths) {
  const ReadDxf read =
      read_text(entities("0 LINE 8 0 10 0 20 0 11 3 21 4 "
                         "0 ARC 8 0 10 0 20 0 40 2 50 0 51 90 "
                         "0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 42 1 10 2 20 0 10 2 20 2 "
                         "0 POLYLINE 8 0 66 1 70 0 0 VERTEX 8 0 10 5 20 5 42 -1 0 VERTEX 8 0 10 7 20 5 0 SEQEND 8 0",
                         in_mm));
  EXPECT_FALSE(read.found.any_error()) << render(read.found, false);
  ASSERT_EQ(read.drawing.paths.size(), 4U);
  EXPECT_EQ(read.drawing.paths[0].points[1].at, nm(3'000'000, 4'000'000));
  EXPECT_NEAR(read.drawing.paths[1].points[0].bulge, std::tan(std::acos(-1) / 8), 1e-12);
  EXPECT_TRUE(read.drawing.paths[2].is_closed);
  EXPECT_EQ(read.drawing.paths[2].points[0].bulge, 1);
  EXPECT_EQ(read.drawing.paths[3].points[0].bulge, -1);
}

TEST(Dxf, a_closed_pair_of_half_circles_is_a_hole) {
  const std::string donut = entities("0 LWPOLYLINE 8 0 90 2 70 1 43 0.5 10 1 20 1 42 1 10 2 20 1 42 1", in_mm);
  const ReadDxf read = read_text(donut, {.is_for_drilling = true});
  ASSERT_EQ(read.drawing.holes.size(), 1U);
  EXPECT_EQ(read.drawing.holes[0].at, nm(1'500'000, 1'000'000));
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{500'000}) << "the inner circle of a donut";
  EXPECT_TRUE(read.drawing.notes.empty());
}

TEST(Dxf, a_polyline_with_a_width_is_its_middle_and_told) {
  const ReadDxf read = read_text(entities(
      "0 LWPOLYLINE 8 0 90 2 70 1 43 0.5 10 1 20 1 42 1 10 2 20 1 42 1 0 POLYLINE 8 0 66 1 70 0 40 2 41 2 0 VERTEX 8 0 "
      "10 5 20 5 0 VERTEX 8 0 10 7 20 5 0 SEQEND 8 0 0 LWPOLYLINE 8 0 90 2 10 0 20 0 10 1 20 0",
      in_mm));
  ASSERT_EQ(read.drawing.holes.size(), 1U);
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{1'000'000}) << "the middle of the donut";
  EXPECT_EQ(read.drawing.paths.size(), 2U);
  EXPECT_THAT(read.drawing.notes,
              testing::ElementsAre("2 polylines with a width are read as their middle, first in line 16"));
}

// The greatest distance of the path's points from the ellipse with these semi-axes, to first order.
double off_ellipse(const DrawnPath& path, double cx, double cy, double a, double b) {
  double most = 0;
  for (const PathPoint& point : path.points) {
    const double x = to_mm(point.at.x).value() - cx;
    const double y = to_mm(point.at.y).value() - cy;
    const double off = (x * x / (a * a) + y * y / (b * b) - 1) / std::hypot(2 * x / (a * a), 2 * y / (b * b));
    most = std::max(most, std::abs(off));
  }
  return most;
}
// The greatest distance of the middles of the path's chords.
double middles_off_ellipse(const DrawnPath& path, double cx, double cy, double a, double b) {
  DrawnPath middles = path;
  const std::size_t n = path.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const DrawnPoint from = path.points[i].at;
    const DrawnPoint to = path.points[i + 1 == n && !path.is_closed ? i : (i + 1) % n].at;
    middles.points[i].at = {{(from.x.count + to.x.count) / 2}, {(from.y.count + to.y.count) / 2}};
  }
  return off_ellipse(middles, cx, cy, a, b);
}

TEST(Dxf, arcs_of_a_stretched_block_are_those_of_ellipses) {
  const auto in_block = [](const std::string& inside, const std::string& insert) {
    const ReadDxf read = read_text(
        entities("0 INSERT 8 0 2 A 10 0 20 0 " + insert,
                 in_mm + " 0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 A 70 0 10 0 20 0 " + inside + " 0 ENDBLK 0 ENDSEC"));
    EXPECT_FALSE(read.found.any_error()) << render(read.found, false);
    EXPECT_TRUE(read.drawing.holes.empty());
    EXPECT_EQ(read.drawing.paths.size(), 1U);
    EXPECT_TRUE(read.drawing.notes.empty());
    return read.drawing.paths.empty() ? DrawnPath{} : read.drawing.paths[0];
  };
  const std::string halves = "0 LWPOLYLINE 8 0 90 2 70 1 10 0 20 0 42 1 10 10 20 0 42 1";
  for (const std::string& circle :
       {halves, std::string("0 CIRCLE 8 0 10 5 20 0 40 5"),
        std::string("0 POLYLINE 8 0 66 1 70 1 0 VERTEX 8 0 10 0 20 0 42 1 0 VERTEX 8 0 10 10 20 0 42 1 0 SEQEND 8 0"),
        std::string("0 ARC 8 0 10 5 20 0 40 5 50 0 51 360")}) {
    const DrawnPath path = in_block(circle, "41 2 42 1");
    EXPECT_TRUE(path.is_closed) << circle;
    EXPECT_GT(path.points.size(), 30U);
    EXPECT_LT(off_ellipse(path, 10, 0, 10, 5), 1e-5);
    EXPECT_LT(middles_off_ellipse(path, 10, 0, 10, 5), 0.0051);
    EXPECT_LT(off_ellipse(in_block(circle, "41 -2 42 1"), -10, 0, 10, 5), 1e-5) << "mirrored, too";
    EXPECT_LT(off_ellipse(in_block(circle, "41 2 42 1 230 -1"), -10, 0, 10, 5), 1e-5) << "and seen from behind";
  }
  // A quarter and a side: the arc bulges to the right of the path.
  const DrawnPath part =
      in_block("0 LWPOLYLINE 8 0 90 3 70 0 10 0 20 0 10 10 20 0 42 -0.41421356 10 0 20 10", "41 1 42 3");
  EXPECT_FALSE(part.is_closed);
  EXPECT_EQ(part.points.back().at, nm(0, 30'000'000));
  DrawnPath arc = part;
  arc.points.erase(arc.points.begin());
  EXPECT_LT(off_ellipse(arc, 10, 30, 10, 30), 1e-4);
  EXPECT_LT(middles_off_ellipse(arc, 10, 30, 10, 30), 0.0051);
}

TEST(Dxf, entities_lie_in_planes_of_their_own) {
  const ReadDxf behind = read_text(entities(
      "0 CIRCLE 8 0 10 3 20 1 40 1 210 0 220 0 230 -1 0 ARC 8 0 10 3 20 1 40 2 50 0 51 90 210 0 220 0 230 -1", in_mm));
  EXPECT_EQ(behind.drawing.holes.at(0).at, nm(-3'000'000, 1'000'000));
  EXPECT_EQ(behind.drawing.paths.at(0).points.front().at, nm(-5'000'000, 1'000'000));
  EXPECT_NEAR(behind.drawing.paths.at(0).points[0].bulge, -std::tan(std::acos(-1) / 8), 1e-9) << "clockwise from above";
  // A circle whose plane is tilted by 60 degrees about X appears as an ellipse.
  const ReadDxf leaning =
      read_text(entities("0 CIRCLE 8 0 10 0 20 0 40 10 210 0 220 -0.8660254037844386 230 0.5", in_mm));
  ASSERT_EQ(leaning.drawing.paths.size(), 1U);
  EXPECT_LT(off_ellipse(leaning.drawing.paths[0], 0, 0, 10, 5), 1e-4);
}

TEST(Dxf, a_spline_through_fit_points_is_smooth) {
  const auto spline = [](const std::string& groups) {
    const ReadDxf read = read_text(entities("0 SPLINE 8 0 71 3 " + groups, in_mm));
    EXPECT_FALSE(read.found.any_error()) << render(read.found, false);
    EXPECT_TRUE(read.drawing.notes.empty());
    return read.drawing.paths.empty() ? DrawnPath{} : read.drawing.paths[0];
  };
  const auto turns = [](const DrawnPath& path) {  // the largest change of direction at a point, in degrees
    double most = 0;
    const std::size_t n = path.points.size();
    for (std::size_t i = path.is_closed ? 0 : 1; i + (path.is_closed ? 0 : 1) < n; ++i) {
      const auto angle = [&](std::size_t from, std::size_t to) {
        return std::atan2(static_cast<double>(path.points[to].at.y.count - path.points[from].at.y.count),
                          static_cast<double>(path.points[to].at.x.count - path.points[from].at.x.count));
      };
      const double turn = std::remainder(angle(i, (i + 1) % n) - angle((i + n - 1) % n, i), 2 * std::acos(-1));
      most = std::max(most, std::abs(turn) * 180 / std::acos(-1));
    }
    return most;
  };
  const std::string zigzag = "11 0 21 0 11 10 21 10 11 20 21 0 11 30 21 10";
  const DrawnPath open = spline("70 8 " + zigzag);
  for (const DrawnPoint at : {nm(0, 0), nm(10'000'000, 10'000'000), nm(20'000'000, 0), nm(30'000'000, 10'000'000)}) {
    EXPECT_TRUE(std::ranges::any_of(open.points, [&](const PathPoint& point) { return point.at == at; }));
  }
  EXPECT_LT(turns(open), 8);
  // A spline through points of a circle is nearly that circle.
  std::string circle;
  constexpr int points = 12;
  for (int i = 0; i < points; ++i) {
    circle +=
        fmt::format(" 11 {:.9f} 21 {:.9f}", 10 * std::cos(i * std::acos(-1) / 6), 10 * std::sin(i * std::acos(-1) / 6));
  }
  const DrawnPath ring = spline("70 1" + circle);
  EXPECT_TRUE(ring.is_closed);
  EXPECT_LT(off_ellipse(ring, 0, 0, 10, 10), 0.01);
  EXPECT_LT(turns(ring), 8);
  // With tangents at its ends: a quarter of a circle in one cubic.
  const DrawnPath quarter = spline("70 0 11 10 21 0 11 7.0710678 21 7.0710678 11 0 21 10 12 0 22 1 13 -1 23 0");
  EXPECT_LT(off_ellipse(quarter, 0, 0, 10, 10), 0.02);
  EXPECT_EQ(spline("70 8 11 0 21 0 11 5 21 5").points.size(), 2U) << "two points: a line";
}

TEST(Dxf, ellipses_and_splines_stay_within_the_tolerance) {
  const ReadDxf read = read_text(entities(
      "0 ELLIPSE 8 0 10 0 20 0 11 10 21 0 40 0.5 41 0 42 6.283185307179586 "
      "0 SPLINE 8 0 70 8 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 10 10 20 0 41 1 10 10 20 10 41 0.70710678118 "
      "10 0 20 10 41 1",
      in_mm));
  EXPECT_FALSE(read.found.any_error()) << render(read.found, false);
  ASSERT_EQ(read.drawing.paths.size(), 2U);
  const auto middles_are_near = [](const DrawnPath& path, auto off) {
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const double x = (to_mm(path.points[i].at.x) + to_mm(path.points[i + 1].at.x)).value() / 2;
      const double y = (to_mm(path.points[i].at.y) + to_mm(path.points[i + 1].at.y)).value() / 2;
      EXPECT_LT(std::abs(off(x, y)), 0.006);
    }
  };
  EXPECT_TRUE(read.drawing.paths[0].is_closed);
  EXPECT_GT(read.drawing.paths[0].points.size(), 20U);
  // To first order: the implicit function over its gradient.
  middles_are_near(read.drawing.paths[0],
                   [](double x, double y) { return (x * x / 100 + y * y / 25 - 1) / std::hypot(x / 50, 2 * y / 25); });
  middles_are_near(read.drawing.paths[1], [](double x, double y) { return std::hypot(x, y) - 10; });
}

TEST(Dxf, blocks_are_scaled_turned_mirrored_and_repeated) {
  const std::string blocks =
      in_mm +
      " 0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 PAD 70 0 10 1 20 0 0 CIRCLE 8 0 10 2 20 0 40 0.5 0 ENDBLK "
      "0 BLOCK 8 0 2 PAIR 70 0 10 0 20 0 0 INSERT 8 0 2 PAD 10 0 20 0 0 INSERT 8 0 2 PAD 10 0 20 5 0 ENDBLK 0 ENDSEC";
  const ReadDxf turned = read_text(entities("0 INSERT 8 TOP 2 pad 10 10 20 20 41 2 42 2 50 90", blocks));
  ASSERT_EQ(turned.drawing.holes.size(), 1U) << render(turned.found, false);
  EXPECT_EQ(turned.drawing.holes[0].at, nm(10'000'000, 22'000'000));
  EXPECT_EQ(turned.drawing.holes[0].diameter, Nanometres{2'000'000});
  EXPECT_EQ(turned.drawing.layers[turned.drawing.holes[0].layer], "TOP") << "layer 0 of a block is the INSERT's";
  const ReadDxf mirrored = read_text(entities("0 INSERT 8 0 2 PAD 10 0 20 0 41 -1", blocks));
  EXPECT_EQ(mirrored.drawing.holes.at(0).at, nm(-1'000'000, 0));
  EXPECT_EQ(mirrored.drawing.holes.at(0).diameter, Nanometres{1'000'000});
  const ReadDxf rows = read_text(entities("0 INSERT 8 0 2 PAIR 10 0 20 0 70 3 71 2 44 10 45 20", blocks));
  EXPECT_EQ(rows.drawing.holes.size(), 12U);
  EXPECT_EQ(rows.drawing.holes.at(11).at, nm(21'000'000, 25'000'000));
  const ReadDxf stretched = read_text(entities("0 INSERT 8 0 2 PAD 10 0 20 0 41 2", blocks));
  EXPECT_EQ(stretched.drawing.paths.size(), 1U) << "a stretched circle is no hole";
}

TEST(Dxf, layers_are_chosen_or_those_that_are_on) {
  const std::string layers = in_mm +
                             " 0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 Pads 70 0 62 7 0 LAYER 2 Top 70 0 62 -7 "
                             "0 LAYER 2 Frozen 70 1 62 7 0 ENDTAB 0 ENDSEC";
  const std::string circles =
      "0 CIRCLE 8 Pads 10 1 20 0 40 0.4 0 CIRCLE 8 TOP 10 2 20 0 40 0.4 0 CIRCLE 8 Frozen 10 3 20 0 40 0.4";
  const ReadDxf on = read_text(entities(circles, layers));
  ASSERT_EQ(on.drawing.holes.size(), 1U);
  EXPECT_THAT(on.drawing.notes, testing::ElementsAre(testing::HasSubstr("on other layers: 2")));
  const ReadDxf chosen = read_text(entities(circles, layers), {.unit = {}, .layers = {"top"}});
  EXPECT_EQ(chosen.drawing.holes.at(0).at, nm(2'000'000, 0));
  const ReadDxf none = read_text(entities(circles, layers), {.unit = {}, .layers = {"Drill"}});
  EXPECT_EQ(first_code(none), "dxf.no-layer");
}

// The same groups in the two binary forms.
std::string as_binary(const std::string& text, bool short_codes) {
  std::string bytes("AutoCAD Binary DXF\r\n\x1A\0", 22);
  std::istringstream lines(text);
  for (std::string code_text, value; std::getline(lines, code_text) && std::getline(lines, value);) {
    const int code = std::stoi(code_text);
    bytes += static_cast<char>(code);
    if (!short_codes) bytes += '\0';
    if (code >= 10 && code <= 59) {
      const double number = std::stod(value);
      char raw[8];
      std::memcpy(raw, &number, 8);
      bytes.append(raw, 8);
    } else if (code >= 60 && code <= 79) {
      bytes += static_cast<char>(std::stoi(value));
      bytes += '\0';
    } else {
      bytes += value + '\0';
    }
  }
  return bytes;
}

TEST(Dxf, binary_files_read_as_their_texts) {
  const std::string text = entities("0 CIRCLE 8 PADS 10 1.5 20 -2 40 0.4 0 LINE 8 0 10 0 20 0 11 3 21 4", in_mm);
  for (const bool short_codes : {false, true}) {
    const std::string bytes = as_binary(text, short_codes);
    EXPECT_TRUE(looks_like_dxf(bytes));
    const ReadDxf read = read_text(bytes);
    EXPECT_FALSE(read.found.any_error()) << render(read.found, false);
    ASSERT_EQ(read.drawing.holes.size(), 1U);
    EXPECT_EQ(read.drawing.holes[0].at, nm(1'500'000, -2'000'000));
    EXPECT_EQ(read.drawing.paths.size(), 1U);
    const ReadDxf cut = read_text(bytes.substr(0, bytes.size() - 30));
    EXPECT_EQ(first_code(cut), "dxf.cut-off");
    EXPECT_THAT(cut.found.all().front().message, testing::HasSubstr("at byte"));
  }
}

TEST(Dxf, what_is_wrong_is_told_with_its_place) {
  const ReadDxf number = read_text("0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\nwide\n");
  EXPECT_EQ(first_code(number), "dxf.bad-number");
  EXPECT_EQ(number.found.all().front().place, (SourceLocation{8, 1, 4}));
  const ReadDxf code = read_text("0\nSECTION\n2\nENTITIES\nten\n1\n");
  EXPECT_EQ(first_code(code), "dxf.bad-code");
  EXPECT_EQ(code.found.all().front().place.line, 5U);
  EXPECT_EQ(first_code(read_text("0\nSECTION\n2\n")), "dxf.cut-off");
  EXPECT_EQ(first_code(read_text("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n")), "dxf.no-entities");
  EXPECT_EQ(first_code(read_text(entities("0 INSERT 8 0 2 NONE 10 0 20 0", in_mm))), "dxf.no-block");
  EXPECT_EQ(first_code(read_text(entities("0 CIRCLE 8 0 10 1e30 20 0 40 1", in_mm))), "drawing.too-far");
}

TEST(Dxf, blocks_that_never_end_are_refused) {
  const std::string itself = in_mm + " 0 SECTION 2 BLOCKS 0 BLOCK 2 A 0 INSERT 2 A 0 ENDBLK 0 ENDSEC";
  EXPECT_EQ(first_code(read_text(entities("0 INSERT 2 A", itself))), "dxf.nested-too-deep");
  std::string bomb = in_mm + " 0 SECTION 2 BLOCKS 0 BLOCK 2 B0 0 POINT 10 0 20 0 0 ENDBLK";
  for (int i = 1; i < 12; ++i) {
    bomb += " 0 BLOCK 2 B" + std::to_string(i) + " 0 INSERT 2 B" + std::to_string(i - 1) + " 70 1000 71 1000 0 ENDBLK";
  }
  const ReadDxf read = read_text(entities("0 INSERT 2 B11", bomb + " 0 ENDSEC"));
  EXPECT_EQ(first_code(read), "drawing.too-large");
}

// Drawings of Debian's librecad-data and openscad-testing-data, if they are installed: all are read, none refused.
TEST(Dxf, reads_drawings_of_other_programs) {
  std::size_t files = 0;
  const char* const elsewhere = std::getenv("PASSO_DXF_FILES");
  for (const fs::path& folder : {fs::path("/usr/share/librecad"), fs::path("/usr/share/openscad/testdata"),
                                 fs::path(elsewhere == nullptr ? "" : elsewhere)}) {
    if (folder.empty() || !fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".dxf") continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const ReadDxf read = read_text(text);
      ++files;
      if (entry.path().stem() == "nothing-decimal-comma-separated") {  // no DXF, and OpenSCAD too reads nothing of it
        EXPECT_EQ(first_code(read), "dxf.bad-number");
        continue;
      }
      EXPECT_FALSE(read.found.any_error()) << entry.path() << "\n" << render(read.found, false);
    }
  }
  if (files == 0) GTEST_SKIP() << "neither librecad-data nor openscad-testing-data is installed";
}

}  // namespace
}  // namespace passo
