// Boards of EAGLE and EasyEDA, written here as their programs write them.
#include "passo/cam/design_board.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/region.hpp"

namespace passo {
namespace {

DrawnPoint board_place(double x, double y) {
  return {to_nanometres(Mm(x)), to_nanometres(Mm(y))};
}

std::string eagle_with(const std::string& plain, const std::string& package, const std::string& elements,
                       const std::string& signals, const std::string& rules = "") {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!DOCTYPE eagle SYSTEM \"eagle.dtd\">\n<eagle "
         "version=\"9.6.2\">\n"
         "<drawing><layers><layer number=\"1\" name=\"Top\"/></layers><board>\n<plain>" +
         plain +
         "<wire x1=\"0\" y1=\"0\" x2=\"30\" y2=\"0\" width=\"0\" layer=\"20\"/>"
         "<wire x1=\"30\" y1=\"0\" x2=\"30\" y2=\"20\" width=\"0\" layer=\"20\"/>"
         "<wire x1=\"30\" y1=\"20\" x2=\"0\" y2=\"20\" width=\"0\" layer=\"20\"/>"
         "<wire x1=\"0\" y1=\"20\" x2=\"0\" y2=\"0\" width=\"0\" layer=\"20\"/></plain>\n"
         "<libraries><library name=\"lib\"><packages><package name=\"P\">" +
         package + "</package></packages></library></libraries>\n<designrules name=\"d\">" + rules +
         "</designrules>\n<elements>" + elements + "</elements>\n<signals>" + signals +
         "</signals></board></drawing></eagle>\n";
}

DesignBoard good(const std::string& text) {
  Diagnostics found;
  EXPECT_TRUE(looks_like_design_board(text));
  DesignBoard board = read_design_board("board.brd", text, found);
  for (const Diagnostic& one : found.all()) ADD_FAILURE() << one.code << " " << one.message;
  return board;
}
std::string code_of(const std::string& text) {
  Diagnostics found;
  read_design_board("board.brd", text, found);
  return found.all().empty() ? "" : found.all().front().code;
}
const GerberLayer& layer(const DesignBoard& board, const std::string& name) {
  const auto found = std::ranges::find(board.copper, name, &DesignLayer::name);
  EXPECT_NE(found, board.copper.end()) << name;
  return found == board.copper.end() ? board.edge : found->layer;
}

TEST(EagleBoard, elements_are_turned_then_mirrored_to_the_other_side) {
  const std::string smd = "<smd name=\"1\" x=\"2\" y=\"1\" dx=\"1\" dy=\"0.4\" layer=\"1\"/>";
  const DesignBoard board =
      good(eagle_with("", smd,
                      "<element name=\"A\" library=\"lib\" package=\"P\" x=\"10\" y=\"10\" rot=\"R90\"/>"
                      "<element name=\"B\" library=\"lib\" package=\"P\" x=\"20\" y=\"10\" rot=\"MR90\"/>",
                      "<signal name=\"GND\"><contactref element=\"A\" pad=\"1\"/></signal>"));
  // (2, 1) rotated by 90 degrees is (-1, 2), and then mirrored (1, 2).
  const GerberLayer& top = layer(board, "Top");
  EXPECT_NEAR(area_mm2(top.dark), 0.4, 1e-6);
  EXPECT_TRUE(contains(top.dark, board_place(9, 12.45)));
  ASSERT_EQ(top.pads.size(), 1U);
  EXPECT_EQ(top.nets.at(top.pads[0].net), "GND");
  EXPECT_EQ(top.pads[0].at, board_place(9, 12));
  const GerberLayer& bottom = layer(board, "Bottom");
  EXPECT_NEAR(area_mm2(bottom.dark), 0.4, 1e-6);
  EXPECT_TRUE(contains(bottom.dark, board_place(21, 12.45)));
}

TEST(EagleBoard, pads_have_the_shape_and_the_ring_of_the_design_rules) {
  const DesignBoard board = good(
      eagle_with("",
                 "<pad name=\"1\" x=\"0\" y=\"0\" drill=\"1\" shape=\"square\"/>"
                 "<pad name=\"2\" x=\"5\" y=\"0\" drill=\"1\" diameter=\"2\" shape=\"long\" rot=\"R90\"/>"
                 "<hole x=\"0\" y=\"5\" drill=\"3\"/>",
                 "<element name=\"A\" library=\"lib\" package=\"P\" x=\"10\" y=\"10\"/>",
                 "<signal name=\"N\"><via x=\"20\" y=\"5\" extent=\"1-16\" drill=\"0.6\"/>"
                 "<wire x1=\"10\" y1=\"10\" x2=\"20\" y2=\"10\" width=\"0.4\" layer=\"16\" curve=\"-180\"/></signal>",
                 "<param name=\"rvPadTop\" value=\"0.25\"/><param name=\"rlMinPadTop\" value=\"10mil\"/>"
                 "<param name=\"rlMinViaOuter\" value=\"8mil\"/>"));
  const Region& top = layer(board, "Top").dark;
  // A square of 1 mm + 2 x 10 mil, and a long pad that stands upright: 4 mm long, 2 mm wide.
  EXPECT_TRUE(contains(top, board_place(10.75, 10.75)));
  EXPECT_FALSE(contains(top, board_place(10.76, 10)));
  EXPECT_TRUE(contains(top, board_place(15, 11.9)));
  EXPECT_FALSE(contains(top, board_place(16.1, 10)));
  // The via: 0.6 mm and 8 mil around it.
  EXPECT_TRUE(contains(top, board_place(20.49, 5)));
  EXPECT_FALSE(contains(top, board_place(20.51, 5)));
  // A half circle to the right of its direction, i.e. above.
  EXPECT_TRUE(contains(layer(board, "Bottom").dark, board_place(15, 15)));
  ASSERT_EQ(board.drills.holes.size(), 4U);
  EXPECT_EQ(std::ranges::count(board.drills.holes, 1U, &DrawnHole::layer), 1);
  EXPECT_EQ(board.edge.strokes.paths.size(), 4U);
}

// EAGLE stores only the outline of a polygon.
TEST(EagleBoard, polygons_are_poured_around_other_nets_and_without_islands) {
  const DesignBoard board = good(eagle_with(
      "", "<smd name=\"1\" x=\"0\" y=\"0\" dx=\"2\" dy=\"2\" layer=\"1\"/>",
      "<element name=\"A\" library=\"lib\" package=\"P\" x=\"8\" y=\"10\"/>"
      "<element name=\"B\" library=\"lib\" package=\"P\" x=\"22\" y=\"10\"/>",
      "<signal name=\"GND\"><contactref element=\"A\" pad=\"1\"/><polygon width=\"0.2\" layer=\"1\" isolate=\"0.5\">"
      "<vertex x=\"2\" y=\"2\"/><vertex x=\"28\" y=\"2\"/><vertex x=\"28\" y=\"18\"/><vertex x=\"2\" "
      "y=\"18\"/></polygon>"
      "</signal><signal name=\"VCC\"><contactref element=\"B\" pad=\"1\"/>"
      "<wire x1=\"26\" y1=\"-5\" x2=\"26\" y2=\"25\" width=\"0.4\" layer=\"1\"/></signal>"));
  const GerberLayer& top = layer(board, "Top");
  EXPECT_TRUE(contains(top.dark, board_place(15, 10)));
  EXPECT_TRUE(contains(top.dark, board_place(20.45, 10)));  // up to 0.5 mm from the pad of VCC
  EXPECT_FALSE(contains(top.dark, board_place(20.6, 10)));
  EXPECT_FALSE(contains(top.dark, board_place(25.4, 10)));  // and from its wire
  EXPECT_FALSE(contains(top.dark, board_place(27.5, 10)));  // an island beyond the wire
  EXPECT_TRUE(contains(top.dark, board_place(1.95, 10)));   // the rim is a line of 0.2 mm
  EXPECT_EQ(parts_of(top.dark).size(), 3U);
  ASSERT_EQ(top.strokes.notes.size(), 1U);
  EXPECT_THAT(top.strokes.notes[0], testing::HasSubstr("a polygon is poured by Passo, without thermal reliefs"));
}

TEST(EagleBoard, wrong_files_are_refused) {
  EXPECT_EQ(code_of("<eagle version=\"9\"><drawing><board><plain></board></drawing></eagle>"), "eagle.syntax");
  EXPECT_EQ(code_of("<eagle version=\"9\"><drawing><schematic/></drawing></eagle>"), "eagle.no-board");
  EXPECT_EQ(code_of(eagle_with("<wire x1=\"a\" y1=\"0\" x2=\"1\" y2=\"0\" width=\"1\" layer=\"1\"/>", "", "", "")),
            "eagle.bad-number");
  EXPECT_EQ(code_of(eagle_with("<hole x=\"1e9\" y=\"0\" drill=\"1\"/>", "", "", "")), "eagle.bad-number");
  EXPECT_EQ(code_of(eagle_with("", "", "<element name=\"A\" library=\"lib\" package=\"Q\" x=\"0\" y=\"0\"/>", "")),
            "eagle.no-package");
  std::string deep = "<eagle version=\"9\">";
  for (int i = 0; i < 100; ++i) deep += "<a>";
  EXPECT_EQ(code_of(deep), "eagle.too-large");
}

std::string easyeda_with(const std::string& shapes, const std::string& kind = "3") {
  return R"({"head":{"docType":")" + kind + R"(","x":"4000","y":"3000"},"canvas":"CA~1000~1000","shape":[)" + shapes +
         R"(],"layers":["1~TopLayer~#FF0000~true~true~true~","21~Inner1~#999966~false~false~false~"]})";
}

TEST(EasyedaBoard, shapes_lie_where_they_are_drawn_from_the_zero_of_the_canvas) {
  const DesignBoard board = good(easyeda_with(
      R"("TRACK~3.937~1~GND~4100 3000 4200 2900~gge1~0","VIA~4200~2900~6~GND~1.5~gge2~0",)"
      R"("HOLE~4300~2900~5.9055~gge3~0","CIRCLE~4050~2950~10~2~2~gge4~0~VCC",)"
      R"("LIB~4100~3000~package`R`~0~~gge5~1#@$PAD~RECT~4100~3000~10~20~1~GND~1~0~4095 2990 4105 2990 4105 3010 4095 3010)"
      R"(~0~gge6~0~~Y#@$PAD~OVAL~4150~2950~20~10~11~VCC~2~2~~90~gge7~8~4150 2948 4150 2952~Y",)"
      R"("TRACK~1~10~~4000 3000 4400 3000 4400 2800 4000 2800 4000 3000~gge8~0")"));
  const GerberLayer& top = layer(board, "TopLayer");
  EXPECT_EQ(board.copper.size(), 2U);                        // the inner layer is not used
  EXPECT_TRUE(contains(top.dark, board_place(38.1, 12.7)));  // on the track, 150 units to the right and 50 up
  EXPECT_TRUE(contains(top.dark, board_place(26.6, -2.5)));  // a corner of the pad
  EXPECT_TRUE(contains(top.dark, board_place(38.1, 15.2)));  // the oval stands upright
  EXPECT_FALSE(contains(top.dark, board_place(39.7, 15.2)));
  EXPECT_TRUE(contains(layer(board, "BottomLayer").dark, board_place(15.24, 12.7)));
  ASSERT_EQ(board.drills.holes.size(), 2U);
  EXPECT_NEAR(to_mm(board.drills.holes[0].diameter).value(), 0.762, 1e-6);
  EXPECT_NEAR(to_mm(board.drills.holes[1].diameter).value(), 3, 1e-4);
  EXPECT_EQ(board.drills.holes[1].layer, 1U);
  ASSERT_EQ(board.drills.paths.size(), 1U);
  EXPECT_NEAR(to_mm(board.drills.paths[0].width).value(), 1.016, 1e-6);
  EXPECT_EQ(board.edge.strokes.paths.size(), 1U);
  std::vector<std::string> nets = top.nets;
  std::ranges::sort(nets);
  EXPECT_EQ(nets, (std::vector<std::string>{"", "GND", "VCC"}));
}

TEST(EasyedaBoard, copper_areas_are_poured_and_arcs_are_round) {
  const DesignBoard board = good(easyeda_with(
      R"("COPPERAREA~1~1~GND~M 4010 2990 L 4390 2990 L 4390 2810 L 4010 2810 Z~10~solid~gge1~spoke~none~[]",)"
      R"("TRACK~4~1~GND~4020 2980 4040 2980~gge2","TRACK~4~1~VCC~4100 2900 4200 2900~gge3",)"
      R"("SOLIDREGION~1~~M 4300 2900 L 4320 2900 L 4320 2880 Z~cutout~gge4",)"
      R"("ARC~4~2~N~M4100,2900 A50,50 0 0 1 4200,2900~~gge5")"));
  const Region& top = layer(board, "TopLayer").dark;
  EXPECT_TRUE(contains(top, board_place(12.7, 40)));
  EXPECT_FALSE(contains(top, board_place(38.1, 25.4 + 2.9)));  // 10 units of clearance and half of the track
  EXPECT_TRUE(contains(top, board_place(38.1, 25.4 + 3.2)));
  EXPECT_FALSE(contains(top, board_place(80.5, 26.5)));  // the cutout
  // Clockwise on the screen, where Y points down: above.
  EXPECT_TRUE(contains(layer(board, "BottomLayer").dark, board_place(38.1, 25.4 + 12.7)));
}

TEST(EasyedaBoard, wrong_files_are_refused) {
  EXPECT_EQ(code_of(R"({"shape": [ "canvas")"), "easyeda.syntax");
  EXPECT_EQ(code_of(R"({"shape": 3, "canvas":""})"), "easyeda.no-board");
  EXPECT_EQ(code_of(easyeda_with("", "1")), "easyeda.no-board");
  EXPECT_EQ(code_of(easyeda_with(R"("TRACK~x~1~~0 0 1 1")")), "easyeda.bad-number");
  EXPECT_EQ(code_of(easyeda_with(R"("HOLE~1e12~0~3")")), "easyeda.bad-number");
  EXPECT_EQ(code_of(easyeda_with(R"("ARC~1~1~~M 0 0 Q~~")")), "easyeda.bad-path");
  EXPECT_EQ(code_of(easyeda_with(R"(7, null, {}, "", "PAD", "LIB~1~2#@$", "NEW~1")")), "");
}

}  // namespace
}  // namespace passo
