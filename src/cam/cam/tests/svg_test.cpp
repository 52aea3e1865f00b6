// SVG drawings: what is drawn lies where the page has it, and what is wrong is told.
#include "passo/cam/svg.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

struct ReadSvg {
  Drawing drawing;
  std::string words;  // of the findings
};
ReadSvg svg(const std::string& text, const SvgOptions& options = {}) {
  Diagnostics findings;
  ReadSvg read;
  read.drawing = read_svg("it.svg", text, options, findings);
  if (!findings.all().empty()) read.words = render(findings, false);
  return read;
}
// A page of 100 x 50 mm, of which a 1 is half a millimetre.
std::string page(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
         "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' width='100mm' height='50mm' viewBox='0 0 200 "
         "100'>" +
         inside + "</svg>";
}
double mm_x(const PathPoint& point) {
  return to_mm(point.at.x).value();
}
double mm_y(const PathPoint& point) {
  return to_mm(point.at.y).value();
}
void expect_at(const PathPoint& point, double x, double y) {
  EXPECT_NEAR(mm_x(point), x, 2e-6);
  EXPECT_NEAR(mm_y(point), y, 2e-6);
}

TEST(Svg, shapes_lie_on_the_page_with_y_up) {
  const ReadSvg read =
      svg(page("<circle cx='20' cy='10' r='4'/><rect x='10' y='20' width='40' height='30'/><line x1='0' y1='0' "
               "x2='100%' y2='100%'/><polygon points='0,0 10,0 10,10'/><polyline points='0 0 1-1'/><ellipse cx='50' "
               "cy='50' rx='20' ry='10'/>"));
  EXPECT_EQ(read.words, "");
  ASSERT_EQ(read.drawing.holes.size(), 1U);
  EXPECT_EQ(read.drawing.holes[0].diameter, to_nanometres(Mm(4)));
  EXPECT_EQ(read.drawing.holes[0].at, (DrawnPoint{to_nanometres(Mm(10)), to_nanometres(Mm(45))}));
  ASSERT_EQ(read.drawing.paths.size(), 5U);
  const DrawnPath& rect = read.drawing.paths[0];
  EXPECT_TRUE(rect.is_closed);
  ASSERT_EQ(rect.points.size(), 4U);
  expect_at(rect.points[0], 25, 40);
  expect_at(rect.points[2], 5, 25);
  expect_at(read.drawing.paths[1].points[1], 100, 0);
  EXPECT_TRUE(read.drawing.paths[2].is_closed);
  EXPECT_FALSE(read.drawing.paths[3].is_closed);
  expect_at(read.drawing.paths[3].points[1], 0.5, 50.5);
  for (const PathPoint& point : read.drawing.paths[4].points) {
    EXPECT_NEAR(std::pow((mm_x(point) - 25) / 10, 2) + std::pow((mm_y(point) - 25) / 5, 2), 1, 1e-6);
  }
}

TEST(Svg, a_path_has_all_commands_absolute_and_relative) {
  const ReadSvg read =
      svg(page("<path d='M10 10h20v-4H8V10zm100,0L120 10l10 10 1e1-1E1z'/><path d='m0 0 10 0 0 10'/>"));
  EXPECT_EQ(read.words, "");
  ASSERT_EQ(read.drawing.paths.size(), 3U);
  const DrawnPath& box = read.drawing.paths[0];
  EXPECT_TRUE(box.is_closed);
  ASSERT_EQ(box.points.size(), 5U);
  expect_at(box.points[2], 15, 47);
  expect_at(box.points[3], 4, 47);
  const DrawnPath& next = read.drawing.paths[1];
  ASSERT_EQ(next.points.size(), 4U);
  expect_at(next.points[0], 55, 45);  // a relative move after z counts from where the path began
  expect_at(next.points[3], 70, 45);
  EXPECT_EQ(read.drawing.paths[2].points.size(), 3U);
  EXPECT_FALSE(read.drawing.paths[2].is_closed);
}

TEST(Svg, arcs_of_circles_stay_arcs) {
  // A half circle over the top, as seen on the page: clockwise with Y up.
  const ReadSvg half = svg(page("<path d='M20 20 A10 10 0 0 1 40 20'/>"));
  ASSERT_EQ(half.drawing.paths.size(), 1U);
  ASSERT_EQ(half.drawing.paths[0].points.size(), 2U);
  EXPECT_NEAR(half.drawing.paths[0].points[0].bulge, -1, 1e-9);
  // The large and the small arc, both ways, and radii that are too small.
  const ReadSvg four =
      svg(page("<path d='M20 20A20 20 0 0040 40'/><path d='M20 20A20 20 0 0 1 40 40'/><path d='M20 20A20 20 0 1 0 40 "
               "40'/><path d='M20 20a5 5 0 11 20 20'/>"));
  ASSERT_EQ(four.drawing.paths.size(), 4U);
  const double quarter = std::tan(M_PI / 8);
  EXPECT_NEAR(four.drawing.paths[0].points[0].bulge, quarter, 1e-9);
  EXPECT_NEAR(four.drawing.paths[1].points[0].bulge, -quarter, 1e-9);
  ASSERT_EQ(four.drawing.paths[2].points.size(), 3U) << "three quarters are two arcs";
  EXPECT_NEAR(four.drawing.paths[2].points[0].bulge, std::tan(M_PI * 3 / 16), 1e-9);
  EXPECT_NEAR(four.drawing.paths[3].points[0].bulge, -1, 1e-6) << "the circle grows to a half one";
  // Turned and mirrored it stays an arc; stretched it becomes chords of an ellipse.
  const ReadSvg turned =
      svg(page("<path transform='rotate(30) scale(-2,2)' d='M20 20 A10 10 0 0 1 40 20'/><path transform='scale(2,1)' "
               "d='M20 20 A10 10 0 0 1 40 20'/>"));
  EXPECT_NEAR(turned.drawing.paths[0].points[0].bulge, 1, 1e-9);
  EXPECT_GT(turned.drawing.paths[1].points.size(), 20U);
  for (const PathPoint& point : turned.drawing.paths[1].points) {
    EXPECT_NEAR(std::pow((mm_x(point) - 30) / 10, 2) + std::pow((mm_y(point) - 40) / 5, 2), 1, 1e-6);
  }
}

TEST(Svg, rounded_corners_are_arcs) {
  const ReadSvg read = svg(
      page("<rect x='10' y='10' width='60' height='40' rx='6'/><rect x='10' y='10' width='20' height='20' rx='30'/>"));
  ASSERT_EQ(read.drawing.paths.size(), 2U);
  ASSERT_EQ(read.drawing.paths[0].points.size(), 8U);
  double length = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const PathPoint& point = read.drawing.paths[0].points[i];
    length += way_nm(point.at, read.drawing.paths[0].points[(i + 1) % 8].at, point.bulge) / nanometres_per_mm;
    EXPECT_NEAR(point.bulge, i % 2 == 0 ? -std::tan(M_PI / 8) : 0, 1e-9);
  }
  EXPECT_NEAR(length, 2 * (24 + 14) + 2 * M_PI * 3, 1e-5);
  EXPECT_EQ(read.drawing.paths[1].points.size(), 4U) << "a circle of four arcs";
}

TEST(Svg, curves_become_chords_within_the_tolerance) {
  const double k = 0.5522847498;
  const std::string cubic = "M100 50C100 " + std::to_string(50 - 40 * k) + " " + std::to_string(60 + 40 * k) +
                            " 10 60 10S20 " + std::to_string(50 - 40 * k) + " 20 50";
  for (const double tolerance : {0.05, 0.002}) {
    const ReadSvg read = svg(page("<path d='" + cubic + "'/>"), {.tolerance = Mm(tolerance)});
    ASSERT_EQ(read.drawing.paths.size(), 1U);
    const std::vector<PathPoint>& points = read.drawing.paths[0].points;
    EXPECT_GT(points.size(), 5U);
    for (std::size_t i = 1; i < points.size(); ++i) {
      // Four cubics come within 0.00027 of a circle.
      const double x = (mm_x(points[i - 1]) + mm_x(points[i])) / 2 - 30;
      const double y = (mm_y(points[i - 1]) + mm_y(points[i])) / 2 - 25;
      EXPECT_NEAR(std::hypot(x, y), 20, tolerance + 20 * 0.0004);
    }
  }
  // T mirrors the control point of the curve before: a wave.
  const ReadSvg wave = svg(page("<path d='M0 50Q10 0 20 50T40 50t20 0'/>"));
  double low = 50;
  double high = 0;
  for (const PathPoint& point : wave.drawing.paths[0].points) {
    low = std::min(low, mm_y(point));
    high = std::max(high, mm_y(point));
  }
  EXPECT_NEAR(low, 25 - 12.5, 0.02);
  EXPECT_NEAR(high, 25 + 12.5, 0.02);
}

TEST(Svg, groups_symbols_uses_and_views_are_placed) {
  const ReadSvg read =
      svg(page("<defs><circle id='dot' r='2'/><symbol id='s' viewBox='0 0 10 10'><circle cx='5' cy='5' "
               "r='5'/></symbol></defs><g transform='translate(20,10)'><use href='#dot' x='4'/></g><use "
               "xlink:href='#s' x='100' y='20' width='40' height='20'/><svg x='50' y='50' width='20' height='20' "
               "viewBox='0 0 2 2'><circle cx='1' cy='1' r='1'/></svg>"));
  EXPECT_EQ(read.words, "");
  ASSERT_EQ(read.drawing.holes.size(), 3U);
  const auto expect_hole = [&](std::size_t i, double x, double y, double diameter) {
    EXPECT_NEAR(to_mm(read.drawing.holes[i].at.x).value(), x, 1e-6);
    EXPECT_NEAR(to_mm(read.drawing.holes[i].at.y).value(), y, 1e-6);
    EXPECT_NEAR(to_mm(read.drawing.holes[i].diameter).value(), diameter, 1e-6);
  };
  expect_hole(0, 12, 45, 2);
  expect_hole(1, 60, 35, 10);  // in the middle of a view that is too wide
  expect_hole(2, 30, 20, 10);
}

TEST(Svg, what_is_not_displayed_or_no_line_is_left_out_and_told) {
  const ReadSvg read =
      svg(page("<g style='stroke:red; display : none'><circle r='1'/></g><circle r='1' visibility='hidden'/><text "
               "x='1' y='1'>A</text><image href='a.png'/><clipPath><circle r='1'/></clipPath>"));
  EXPECT_TRUE(read.drawing.holes.empty());
  EXPECT_THAT(read.drawing.notes,
              testing::UnorderedElementsAre("ignored: 2 elements that are not displayed, first in line 1",
                                            "ignored: 1 pictures and foreign objects, first in line 1",
                                            "ignored: 1 texts (convert them to paths), first in line 1"));
}

// The number of circles with these radii that are read.
std::string diameters(const ReadSvg& read) {
  std::string all;
  for (const DrawnHole& hole : read.drawing.holes) all += fmt::format("{:g} ", to_mm(hole.diameter).value());
  return all;
}

TEST(Svg, style_sheets_hide_by_element_class_id_and_attribute) {
  const std::string shapes =
      "<circle id='a' r='1'/><circle class='x guide' r='2'/><g class='g'><a><circle r='3'/></a><circle r='4'/></g>"
      "<circle r='5' fill='none'/>";
  const auto shown = [&](const std::string& css) {
    return diameters(svg(page("<style>" + css + "</style>" + shapes)));
  };
  EXPECT_EQ(shown("#a,.guide{display:none}"), "3 4 5 ");
  EXPECT_EQ(shown("/* all */ circle { fill:red } circle.guide { Display : None }"), "1 3 4 5 ");
  EXPECT_EQ(shown(".g circle{display:none}"), "1 2 5 ");
  EXPECT_EQ(shown(".g > circle{display:none}"), "1 2 3 5 ");
  EXPECT_EQ(shown("[fill=\"none\"] {display:none}"), "1 2 3 4 ");
  EXPECT_EQ(shown("*{display:none} circle{display:inline}"), "") << "groups do not show";
  EXPECT_EQ(shown("circle{display:none} [class~=guide]{display:inline}"), "2 ");
  EXPECT_EQ(shown("@media print{circle{display:none}} @media screen{#a{display:none}}"), "2 3 4 5 ");
  EXPECT_EQ(shown("@font-face{src:url(a;b{)}"), "1 2 3 4 5 ");
  EXPECT_EQ(shown("circle{r:1"), "1 1 1 1 1 ") << "a style sheet places shapes, too";
}

TEST(Svg, style_sheets_follow_the_cascade) {
  const auto is_shown = [](const std::string& css, const std::string& attributes) {
    const ReadSvg read =
        svg(page("<style><![CDATA[" + css + "]]></style><circle id='a' class='b' r='1' " + attributes + "/>"));
    EXPECT_EQ(read.words, "");
    return read.drawing.holes.size() == 1;
  };
  EXPECT_FALSE(is_shown("#a{display:none} .b{display:inline} circle{display:inline}", "")) << "an id is more specific";
  EXPECT_TRUE(is_shown(".b{display:none} .b{display:inline}", "")) << "the later rule";
  EXPECT_TRUE(is_shown("circle.b{display:inline} .b{display:none}", "")) << "the more specific rule";
  EXPECT_TRUE(is_shown("#a{display:none}", "style='display:inline'")) << "the style attribute";
  EXPECT_FALSE(is_shown("circle{display:none !important}", "style='display:inline'")) << "an important rule";
  EXPECT_TRUE(is_shown("#a{display:none!important}", "style='display:inline !important'"));
  EXPECT_TRUE(is_shown(".b{display:inline}", "display='none'")) << "an attribute is the weakest";
  EXPECT_FALSE(is_shown(".c{display:inline}", "display='none'"));
}

TEST(Svg, rules_that_are_not_read_are_told) {
  const ReadSvg read = svg("<?xml-stylesheet href='a.css'?>" +
                           page("<style>circle:hover{display:none} rect:hover{fill:red}</style><circle r='1'/>"));
  EXPECT_EQ(read.drawing.holes.size(), 1U);
  EXPECT_THAT(read.drawing.notes, testing::ElementsAre(HasSubstr("ignored: 2 style rules")));
}

TEST(Svg, what_is_visible_in_a_hidden_group_is_drawn) {
  EXPECT_EQ(
      diameters(svg(page("<g visibility='hidden'><circle r='1'/><g style='visibility:visible'><circle r='2'/></g>"
                         "</g><g visibility='collapse'><use href='#c'/></g><defs><circle id='c' r='3'/></defs>"))),
      "2 ");
}

TEST(Svg, a_transform_has_an_origin) {
  const auto x_of = [](const std::string& attributes) {
    const ReadSvg read = svg(page("<circle cx='20' cy='10' r='4' " + attributes + "/>"));
    EXPECT_EQ(read.words, "");
    return to_mm(read.drawing.holes.at(0).at.x).value();
  };
  EXPECT_NEAR(x_of("transform='scale(2)'"), 20, 1e-6);
  EXPECT_NEAR(x_of("transform='scale(2)' transform-origin='20 10'"), 10, 1e-6);
  EXPECT_NEAR(x_of("style='transform:scale(2);transform-origin:right 10px'"), 2 * 10 - 100, 1e-6);
  EXPECT_NEAR(x_of("style='transform:scale(2);transform-origin:top left'"), 20, 1e-6);
  EXPECT_NEAR(x_of("transform='rotate(180)' transform-origin='50% 50%'"), 90, 1e-6);
  EXPECT_THAT(svg(page("<circle r='4' transform='scale(2)' style='transform-box:fill-box'/>")).drawing.notes,
              testing::ElementsAre(HasSubstr("ignored: 1 origins of transforms")));
}

double area_of(const Drawing& drawing) {
  double area = 0;
  for (const DrawnPath& path : drawing.paths) {
    double sum = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const PathPoint& a = path.points[i];
      const PathPoint& b = path.points[(i + 1) % path.points.size()];
      sum += mm_x(a) * mm_y(b) - mm_x(b) * mm_y(a);
    }
    area += path.is_closed ? sum / 2 : 0;
  }
  return area;
}

const std::string left_half = "<clipPath id='c'><rect width='100' height='100'/></clipPath>";  // X below 50 mm

TEST(Svg, a_clip_path_cuts_areas_and_lines) {
  const ReadSvg half = svg(page(left_half + "<g clip-path='url(#c)'><circle cx='100' cy='50' r='20'/></g>"));
  EXPECT_TRUE(half.drawing.holes.empty());
  ASSERT_EQ(half.drawing.paths.size(), 1U);
  EXPECT_NEAR(std::abs(area_of(half.drawing)), M_PI * 100 / 2, 0.05);
  for (const PathPoint& point : half.drawing.paths[0].points) EXPECT_LE(mm_x(point), 50 + 1e-6);
  const ReadSvg ring = svg(page(left_half + "<path clip-path='url(#c)' d='M80 30h40v40h-40zM90 40h20v20h-20z'/>"));
  EXPECT_NEAR(std::abs(area_of(ring.drawing)), 10 * 20 - 5 * 10, 1e-4) << "what is left is one area";
  const ReadSvg line = svg(page(left_half + "<line clip-path='url(#c)' x1='20' y1='50' x2='180' y2='50'/>"));
  ASSERT_EQ(line.drawing.paths.size(), 1U);
  EXPECT_NEAR(std::abs(mm_x(line.drawing.paths[0].points[0]) - mm_x(line.drawing.paths[0].points[1])), 40, 1e-4);
  const ReadSvg inside = svg(page(left_half + "<circle clip-path='url(#c)' cx='80' cy='50' r='20'/>"));
  EXPECT_EQ(inside.drawing.holes.size(), 1U) << "a circle that touches the clip stays a circle";
  const ReadSvg outside = svg(page(left_half + "<circle style='clip-path:url(\"#c\")' cx='150' cy='50' r='20'/>"));
  EXPECT_TRUE(outside.drawing.holes.empty() && outside.drawing.paths.empty());
  EXPECT_THAT(outside.drawing.notes, testing::ElementsAre(HasSubstr("1 elements outside of their clip path")));
}

TEST(Svg, clip_paths_have_rules_units_transforms_and_clips_of_their_own) {
  const auto area = [](const std::string& clip, const std::string& shape) {
    return std::abs(area_of(svg(page(clip + shape)).drawing));
  };
  const std::string square = "<rect clip-path='url(#c)' x='20' y='20' width='40' height='40'/>";  // 20 x 20 mm
  EXPECT_NEAR(
      area("<clipPath id='c'><path clip-rule='evenodd' d='M0 0h100v100h-100zM30 30h20v20h-20z'/></clipPath>", square),
      400 - 100, 1e-3);
  EXPECT_NEAR(area("<clipPath id='c'><path d='M0 0h100v100h-100zM30 30h20v20h-20z'/></clipPath>", square), 400, 1e-3);
  EXPECT_NEAR(
      area("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='.25'/></clipPath>", square),
      400 / 8.0, 1e-3);
  EXPECT_NEAR(area("<clipPath id='c' transform='translate(10,0)'><rect x='30' y='0' width='9' height='100'/><use "
                   "href='#r'/></clipPath><defs><rect id='r' width='20' height='100'/></defs>",
                   square),
              5 * 20 + 4.5 * 20, 1e-3);
  EXPECT_NEAR(area(left_half + "<clipPath id='d' clip-path='url(#c)'><rect y='30' width='200' height='5'/></clipPath>",
                   "<rect clip-path='url(#d)' x='90' y='20' width='40' height='40'/>"),
              5 * 2.5, 1e-3);
  EXPECT_NEAR(area(left_half,
                   "<g clip-path='url(#c)' transform='translate(-60,0)'><rect x='90' y='20' width='40' "
                   "height='40'/></g>"),
              5 * 20, 1e-3)
      << "the clip path moves with what it clips";
}

TEST(Svg, clips_that_are_not_obeyed_are_told_with_their_lines) {
  const ReadSvg read =
      svg(page("\n<circle clip-path='circle(50%)' r='1'/>\n<circle clip-path='url(#no)' r='1'/>\n<circle "
               "mask='url(#m)' r='1'/><line x2='3' style='marker-end:url(#arrow)'/>"));
  EXPECT_EQ(read.drawing.holes.size(), 3U);
  EXPECT_THAT(read.drawing.notes, testing::UnorderedElementsAre(
                                      "ignored: 1 clip paths by CSS shapes: what they hide is drawn, first in line 2",
                                      "ignored: 1 clip paths that the drawing does not have, first in line 3",
                                      "ignored: 1 masks: what they hide is drawn, first in line 4",
                                      "ignored: 1 markers of lines, first in line 4"));
  EXPECT_THAT(svg(page("<clipPath id='c' clip-path='url(#c)'><rect width='1' height='1'/></clipPath><rect "
                       "clip-path='url(#c)' width='1' height='1'/>"))
                  .words,
              HasSubstr("[svg.nested-too-deep]"));
}

TEST(Svg, a_nested_view_shows_nothing_beside_itself) {
  const std::string inside = "<circle cx='20' cy='10' r='5'/>";
  EXPECT_NEAR(std::abs(area_of(svg(page("<svg width='20' height='20'>" + inside + "</svg>")).drawing)), M_PI * 6.25 / 2,
              0.01);
  EXPECT_EQ(svg(page("<svg width='20' height='20' overflow='visible'>" + inside + "</svg>")).drawing.holes.size(), 1U);
}

TEST(Svg, old_inkscape_has_90_pixels_in_an_inch) {
  const auto width = [](const std::string& attributes) {
    const ReadSvg read = svg("<svg xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' " + attributes +
                             "><rect width='90' height='90'/></svg>");
    EXPECT_EQ(read.words, "");
    return mm_x(read.drawing.paths.at(0).points[0]);
  };
  EXPECT_NEAR(width("inkscape:version='0.48.4 r9939' width='744.09' height='1052.36'"), 25.4, 1e-5);
  EXPECT_NEAR(width("inkscape:version='0.91 r13725' width='210mm' height='297mm'"), 25.4, 1e-5);
  EXPECT_NEAR(width("inkscape:version='0.91 r13725' width='100mm' height='50mm' viewBox='0 0 200 100'"), 45, 1e-5);
  EXPECT_NEAR(width("inkscape:version='0.48' width='200' height='100' viewBox='0 0 100 50'"), 50.8, 1e-5);
  EXPECT_NEAR(width("inkscape:version='0.92.3' width='960' height='960'"), 25.4 * 90 / 96, 1e-5);
  EXPECT_NEAR(width("inkscape:version='1.2 (dc2aeda)' width='960' height='960'"), 25.4 * 90 / 96, 1e-5);
  EXPECT_NEAR(width("ns0:version='0.47 r1' xmlns:ns0='http://www.inkscape.org/namespaces/inkscape' width='9'"), 25.4,
              1e-5);
}

TEST(Svg, shapes_are_chosen_by_the_colour_of_their_line_or_area) {
  const std::string text = page(
      "<style>.s{stroke:#0f0;fill:none}</style><g stroke='red' fill='none'><circle cx='20' cy='10' r='4'/>"
      "<circle cx='40' cy='10' r='4' style='stroke:rgb(0, 0, 255)'/><circle cx='60' cy='10' r='4' class='s'/></g>"
      "<circle cx='80' cy='10' r='4' fill='#ff0000'/><circle cx='90' cy='10' r='4'/>");
  const auto places = [&](const char* color) {
    std::vector<double> all;
    for (const DrawnHole& hole : svg(text, {.colors = {color}}).drawing.holes) all.push_back(to_mm(hole.at.x).value());
    return all;
  };
  EXPECT_EQ(places("red"), (std::vector<double>{10, 40}));
  EXPECT_EQ(places("#F00"), (std::vector<double>{10, 40}));
  EXPECT_EQ(places("blue"), std::vector<double>{20});
  EXPECT_EQ(places("lime"), std::vector<double>{30});
  EXPECT_EQ(places("black"), std::vector<double>{45});
  EXPECT_EQ(svg(text).drawing.holes.size(), 5U);
  EXPECT_THAT(svg(text, {.colors = {"pink"}}).drawing.notes,
              testing::Contains("nothing that is read has the colour 'pink'"));
}

TEST(Svg, shapes_are_chosen_by_their_names_and_those_of_their_groups) {
  const std::string text = page(
      "<g id='g1' inkscape:label='motor'><circle cx='20' cy='10' r='4'/><circle id='shaft' cx='40' cy='10' r='4'/></g>"
      "<circle cx='60' cy='10' r='4'/>");
  EXPECT_EQ(svg(text, {.names = {"motor"}}).drawing.holes.size(), 2U);
  EXPECT_EQ(svg(text, {.names = {"g1"}}).drawing.holes.size(), 2U);
  EXPECT_EQ(svg(text, {.names = {"shaft"}}).drawing.holes.size(), 1U);
  EXPECT_THAT(svg(text, {.names = {"shift"}}).drawing.notes, testing::Contains("nothing has the id or label 'shift'"));
}

TEST(Svg, layers_are_chosen_by_their_names) {
  const std::string text = page(
      "<g inkscape:groupmode='layer' inkscape:label='cut'><circle r='1'/></g><g inkscape:groupmode='layer' "
      "inkscape:label='notes'><circle r='2'/></g><circle r='3'/>");
  EXPECT_EQ(svg(text).drawing.holes.size(), 3U);
  const ReadSvg one = svg(text, {.layers = {"cut"}});
  ASSERT_EQ(one.drawing.holes.size(), 1U);
  EXPECT_EQ(one.drawing.layers[one.drawing.holes[0].layer], "cut");
  EXPECT_THAT(svg(text, {.layers = {"gut"}}).drawing.notes, testing::Contains("there is no layer 'gut'"));
}

TEST(Svg, shapes_tell_their_layer_colour_and_names) {
  const std::string text = page(
      "<g inkscape:groupmode='layer' inkscape:label='cut' id='l1' stroke='red'><g inkscape:label='motor'>"
      "<circle id='shaft' r='1'/></g><circle r='2' stroke='none'/></g><circle r='3' fill='#00F'/>");
  const ReadSvg read = svg(text, {.tells_shapes = true});
  std::vector<std::string> told;
  for (const DrawnHole& hole : read.drawing.holes) told.push_back(read.drawing.layers[hole.layer]);
  EXPECT_EQ(told,
            (std::vector<std::string>{"cut\n#ff0000\nl1\ncut\nmotor\nshaft", "cut\n#000000\nl1\ncut", "\n#0000ff"}));
}

TEST(Svg, a_page_without_a_size_is_in_pixels) {
  const ReadSvg pixels = svg("<svg><circle cx='96' cy='96' r='48'/></svg>");
  ASSERT_EQ(pixels.drawing.holes.size(), 1U);
  EXPECT_NEAR(to_mm(pixels.drawing.holes[0].diameter).value(), 25.4, 1e-6);
  EXPECT_NEAR(to_mm(pixels.drawing.holes[0].at.y).value(), -25.4, 1e-6);
  EXPECT_THAT(pixels.drawing.notes, testing::ElementsAre(HasSubstr("has no size")));
  const ReadSvg box = svg("<svg viewBox='0 0 96 96'><circle cx='0' cy='96' r='48'/></svg>", {.scale = 2});
  EXPECT_NEAR(to_mm(box.drawing.holes[0].at.y).value(), 0, 1e-6);
  EXPECT_NEAR(to_mm(box.drawing.holes[0].diameter).value(), 50.8, 1e-6);
}

TEST(Svg, what_is_wrong_is_told_with_its_line) {
  EXPECT_THAT(svg("<svg>\n<g>\n</svg>").words,
              HasSubstr("it.svg:3:3: error: the drawing cannot be read: mismatched tag"));
  EXPECT_THAT(svg("<html/>").words, HasSubstr("[svg.no-drawing]"));
  EXPECT_THAT(svg("").words, HasSubstr("[svg.syntax]"));
  EXPECT_THAT(svg(page("\n<path d='M0 0 L1 x'/>")).words, HasSubstr("it.svg:2:1: error: the path data is wrong"));
  EXPECT_THAT(svg(page("<path d='L1 1'/>")).words, HasSubstr("M, the start of a path"));
  EXPECT_THAT(svg(page("<path d='M0 0 A1 1 0 2 0 5 5'/>")).words, HasSubstr("[svg.path]"));
  EXPECT_THAT(svg(page("<path d='M0 0z1 1'/>")).words, HasSubstr("[svg.path]"));
  EXPECT_THAT(svg(page("<g transform='spin(3)'/>")).words, HasSubstr("[svg.transform]"));
  EXPECT_THAT(svg(page("<circle r='2lightyears'/>")).words, HasSubstr("[svg.length]"));
  EXPECT_THAT(svg(page("<use href='#none'/>")).words, HasSubstr("[svg.no-element]"));
  EXPECT_THAT(svg(page("<g id='a'><use href='#a'/></g>")).words, HasSubstr("[svg.nested-too-deep]"));
  EXPECT_THAT(svg(page("<circle cx='1e12' r='1'/>")).words, HasSubstr("[drawing.too-far]"));
  EXPECT_THAT(svg(page("<path d='M0 0C1e9 1e9 -1e9 1e9 9 9'/>")).words, HasSubstr("error"));
}

// Uses that double at each step would draw 2^30 circles.
TEST(Svg, uses_that_explode_are_refused) {
  std::string text = "<g id='g0'><circle r='1'/></g>";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = std::to_string(i - 1);
    text += "<g id='g" + std::to_string(i) + "'><use href='#g" + before + "'/><use href='#g" + before + "'/></g>";
  }
  EXPECT_THAT(svg(page("<defs>" + text + "</defs><use href='#g30'/>")).words, HasSubstr("error"));
}

TEST(Svg, a_text_that_ends_anywhere_is_read_or_refused) {
  const std::string text = page(
      "<path transform='rotate(3,4,5)' d='M1 2C3 4 5 6 7 8A1 2 3 0 1 9 9zm1 1h3'/><rect width='3' height='2' rx='1'/>");
  for (std::size_t size = 0; size < text.size(); ++size) EXPECT_NE(svg(text.substr(0, size)).words, "");
}

}  // namespace
}  // namespace passo
