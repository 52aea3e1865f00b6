// passo cam profile and passo cam pocket, as a user starts them: from a drawing to a program that a machine can run.
#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

const std::string bracket = checkout + "/examples/parts/bracket.svg";

class CamPart : public passo::test::CommandLine {
 protected:
  void expect_cuts_well(const std::string& program, const std::string& stock) const {
    const Outcome checked = passo("check " + program + on_router);
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("no errors"));
    EXPECT_THAT(checked.out + checked.err, Not(HasSubstr("warning")));
    const Outcome cut = passo("simulate " + program + " --tool flat:3 --cell 0.2 --stock " + stock);
    EXPECT_EQ(cut.code, 0) << cut.out << cut.err;
  }
};

TEST_F(CamPart, a_bracket_is_cut_out_of_a_sheet) {
  const Outcome made =
      passo("cam profile " + bracket + " --layer cut --tool 3 --depth -6 --step 2 --tabs 4 --ramp 5 -o " +
            path("b.ngc") + " -p " + path("b.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, HasSubstr("drawn: X 10 to 110, Y 5 to 75 mm\n"));
  EXPECT_THAT(made.out, HasSubstr("1 outside and 6 insides, 8 tabs; 0 mm² of the part lost\n"));
  EXPECT_THAT(read(path("b.ngc")), HasSubstr("\nM3 S12000\n"));
  EXPECT_GT(std::filesystem::file_size(path("b.png")), 10'000U);
  expect_cuts_well(path("b.ngc"), "X5:115,Y0:80,Z-6:0");
}

TEST_F(CamPart, its_pocket_is_cleared_around_an_island) {
  const Outcome made = passo("cam pocket " + bracket + " --layer pocket --tool 3 --depth -3 --step 1.5 --json -o " +
                             path("p.ngc") + " -p " + path("p.svg"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("\"pockets\": 1"));
  EXPECT_THAT(made.out, HasSubstr("\"lost_mm2\": 0.0"));
  EXPECT_THAT(read(path("p.svg")), HasSubstr("<svg"));
  expect_cuts_well(path("p.ngc"), "X5:115,Y0:80,Z-6:0");
}

TEST_F(CamPart, a_contour_drawn_twice_counts_once) {
  const std::string begin = "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='60mm' viewBox='0 0 100 60'>";
  const std::string circle = "<circle cx='30' cy='30' r='15'/>";
  const std::string rounded = "<rect x='5' y='5' width='60' height='20' rx='4'/>";
  const std::string sharp = "<path d='M5 5H65V25H5Z'/>";
  for (const auto& [first, second, area] : {std::tuple(circle, circle, "706.8"), std::tuple(rounded, rounded, "1186"),
                                            std::tuple(sharp, std::string("<path d='M5 5V25H65V5Z'/>"), "1200")}) {
    const std::string twice = write("twice.svg", begin + first + second + "</svg>");
    const Outcome pocket = passo("cam pocket " + twice + " --tool 3 --depth -3 -o " + path("twice.ngc"));
    EXPECT_EQ(pocket.code, 0) << pocket.err;
    EXPECT_THAT(pocket.out, HasSubstr(std::string("1 pocket of ") + area + " mm²"));
    EXPECT_THAT(pocket.err, HasSubstr("1 closed contour that repeats another is ignored"));
    const Outcome profile = passo("cam profile " + twice + " --tool 3 --depth -3 -o " + path("twice.ngc"));
    EXPECT_THAT(profile.out, HasSubstr("1 outside and 0 insides"));
  }
}

TEST_F(CamPart, what_gerber_layers_draw_is_cleared) {
  const std::string begin = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10R,3X2*%\n%ADD11R,2X2*%\nD10*\n";
  const std::string mask = write("mask.gbr", "%TF.FilePolarity,Negative*%\n" + begin + "X5000000Y5000000D03*\nM02*\n");
  // A second layer, which overlaps the first: overlapping areas are one pocket.
  const std::string more = write("more.gbr", begin + "D11*\nX7000000Y5000000D03*\nX20000000Y5000000D03*\nM02*\n");
  const Outcome made =
      passo("cam pocket " + mask + " " + more + " --tool 0.5 --depth -0.1 --ramp 0 --zero lower-left -o " +
            path("p.ngc") + " -p " + path("p.svg"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("drawn: X 0 to 17.5, Y 0 to 2 mm"));
  EXPECT_THAT(made.out, HasSubstr("2 pockets of 13 mm²"));
  EXPECT_THAT(read(path("p.ngc")), HasSubstr("Z-0.1"));
  const Outcome selected = passo("cam pocket " + mask + " --layer 0 --tool 0.5 -o " + path("x.ngc"));
  EXPECT_EQ(selected.code, 2);
  EXPECT_THAT(selected.err, HasSubstr("a Gerber file is a single layer"));
  const Outcome both = passo("cam pocket " + mask + " " + checkout + "/examples/parts/bracket.svg -o " + path("x.ngc"));
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("either drawings or Gerber layers"));
  EXPECT_FALSE(std::filesystem::exists(path("x.ngc")));
}

TEST_F(CamPart, points_are_dots_where_lines_are_followed) {
  const std::string points = write("points.dxf",
                                   "0\nSECTION\n2\nENTITIES\n0\nPOINT\n8\n0\n10\n4\n20\n3\n0\nLINE\n8\n0\n"
                                   "10\n10\n20\n0\n11\n20\n21\n0\n0\nENDSEC\n0\nEOF\n");
  const std::string input = " --input mm --depth -0.5 -o " + path("dots.ngc");
  const Outcome on = passo("cam profile " + points + " --side on" + input);
  EXPECT_EQ(on.code, 0) << on.err;
  EXPECT_THAT(on.out, HasSubstr("1 open line, 1 dot"));
  EXPECT_THAT(on.err, Not(HasSubstr("ignored")));
  EXPECT_THAT(read(path("dots.ngc")), HasSubstr("G0 X4 Y3\n"));
}

TEST_F(CamPart, walls_are_finished_and_reported) {
  const std::string pocket =
      "cam pocket " + bracket + " --layer pocket --tool 3 --depth -6 --step 2 -o " + path("f.ngc");
  const Outcome made = passo(pocket + " --finish-pass --spring-passes 1 --finish-feed 150 --floor-allowance 0.2");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out,
              HasSubstr("finishing: 2 laps of 0.15 mm at full depth, and 1 spring lap each\nclimb milling\n"));
  EXPECT_THAT(read(path("f.ngc")), HasSubstr("(climb milling)\n"));
  EXPECT_THAT(read(path("f.ngc")), HasSubstr(" F150\n"));
  expect_cuts_well(path("f.ngc"), "X5:115,Y0:80,Z-6:0");
  const Outcome left = passo(pocket + " --allowance 0.3 --conventional");
  EXPECT_THAT(left.out, HasSubstr("allowance: 0.3 mm left on the walls\nconventional milling\n"));
  EXPECT_THAT(passo(pocket + " --allowance 1").err, HasSubstr("--allowance: expected 0 to a quarter"));
  EXPECT_THAT(passo(pocket + " --finish-pass --allowance 0").err, HasSubstr("needs an --allowance above 0"));
  EXPECT_THAT(passo(pocket + " --floor-allowance 3").err, HasSubstr("--floor-allowance: expected 0 to --step"));
  const Outcome cut_out =
      passo("cam profile " + bracket + " --layer cut --tool 3 --depth -6 --step 2 --finish-pass -o " + path("c.ngc"));
  EXPECT_THAT(cut_out.out, HasSubstr(" laps of 0.15 mm at full depth\n"));
  expect_cuts_well(path("c.ngc"), "X5:115,Y0:80,Z-6:0");
}

TEST_F(CamPart, a_chamfer_is_milled_along_the_contours) {
  const std::string chamfer = "cam profile " + bracket + " --layer cut --chamfer 0.5 -o " + path("v.ngc");
  const Outcome made = passo(chamfer + " --tip 0.2");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("chamfer 0.5: the tip is at Z-0.6 mm, its centre 0.2 mm beside the edge\n"));
  EXPECT_THAT(made.out, HasSubstr("0 mm² of the part lost"));
  // On Y75 the upper edge ends.
  EXPECT_THAT(read(path("v.ngc")), HasSubstr("Y75.202"));
  EXPECT_THAT(passo("check " + path("v.ngc") + on_router).out, HasSubstr("no errors"));
  EXPECT_THAT(passo(chamfer + " --angle 60").out, HasSubstr("the tip is at Z-1.039 mm, its centre 0.1 mm beside"));
  EXPECT_THAT(passo(chamfer + " --finish-pass").err, HasSubstr("--chamfer cannot be combined with"));
}

TEST_F(CamPart, a_hole_as_wide_as_the_cutter_is_cut) {
  const std::string svg = write("h.svg",
                                "<svg width='40mm' height='30mm' viewBox='0 0 40 30'><rect x='5' y='5' width='30' "
                                "height='20'/><circle cx='12' cy='15' r='1.5'/></svg>");
  const Outcome made = passo("cam profile " + svg + " --tool 3 --depth -2 --step 1 -o " + path("h.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, HasSubstr("1 cut as wide as the cutter, within 0.02 mm, along the centre line\n"));
  EXPECT_THAT(read(path("h.ngc")), HasSubstr("G0 X12 Y15\nG0 Z0.5\nF60\nG1 Z0\nG1 Z-1\nG0 Z0\nG0 Z-0.8\nG1 Z-2\n"));
}

TEST_F(CamPart, on_the_line_open_lines_are_cut_too) {
  const std::string svg =
      write("a.svg", "<svg width='20mm' height='20mm' viewBox='0 0 20 20'><path d='M2 2H18V18'/></svg>");
  const Outcome made = passo("cam profile " + svg + " --side on --depth -0.5 --spindle 0");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("G0 X2 Y18\nG0 Z0.5\nF60\nG1 Z-0.5\nF200\nG1 X18 Y18\nG1 X18 Y2\nG0 Z2\n"));
  EXPECT_THAT(made.out, Not(HasSubstr("M3")));
  const Outcome closed = passo("cam profile " + svg + " -o " + path("x.ngc"));
  EXPECT_EQ(closed.code, 2);
  EXPECT_THAT(closed.err, HasSubstr("[outline.open]"));
  EXPECT_FALSE(std::filesystem::exists(path("x.ngc")));
}

TEST_F(CamPart, letters_are_carved_and_a_machine_can_run_it) {
  const Outcome made = passo("cam engrave --text 'Ab\\nc' --height 12 -o " + path("e.ngc") + " -p " + path("e.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("tool 1: V of 60 degrees, 6 mm: "));
  EXPECT_THAT(made.out, HasSubstr(" mm² carved, at most "));
  const Outcome checked = passo("check " + path("e.ngc") + on_router);
  EXPECT_THAT(checked.out, HasSubstr("no errors"));
  const Outcome flat =
      passo("cam engrave " + bracket + " --layer pocket --angle 90 --depth -2 --clear 2 -o " + path("f.ngc"));
  EXPECT_EQ(flat.code, 0) << flat.err;
  EXPECT_THAT(flat.out, HasSubstr("tool 1: flat cutter 2 mm: "));
  EXPECT_EQ(passo("cam engrave").code, 2);
  EXPECT_THAT(passo("cam engrave --text A --font " + bracket).err, HasSubstr("[engrave.no-font]"));
  EXPECT_THAT(passo("cam engrave --text A --tip 7").err, HasSubstr("--tip: expected a width"));
}

TEST_F(CamPart, lines_of_letters_and_plots_are_followed) {
  const Outcome letters = passo("cam engrave --text 'No 7' --font simplex --depth -0.2 -o " + path("l.ngc"));
  EXPECT_EQ(letters.code, 0) << letters.err;
  EXPECT_THAT(letters.out, HasSubstr("0.2 mm deep, 0.2309 mm wide\n"));
  EXPECT_THAT(passo("check " + path("l.ngc") + on_router).out, HasSubstr("no errors"));
  const Outcome bold = passo("cam engrave --text A --font 'dejavu sans:bold' -o " + path("b.ngc"));
  EXPECT_EQ(bold.code, 0) << bold.err;
  EXPECT_THAT(bold.err, HasSubstr("--font dejavu sans:bold: DejaVu Sans Bold, /"));
  EXPECT_THAT(passo("cam engrave --text A --font 'Dejavu Sanz'").err, HasSubstr("a family such as DejaVu Sans"));
  const std::string plot = write("p.plt", "IN;SP1;PU400,400;PD800,400;");
  const Outcome lines = passo("cam engrave " + plot + " --on-line --depth -0.5 --spindle 0");
  EXPECT_EQ(lines.code, 0) << lines.err;
  EXPECT_THAT(lines.out, HasSubstr("G0 X10 Y10\nG0 Z0.5\nF60\nG1 Z-0.5\nF200\nG1 X20 Y10\nG0 Z2\n"));
  const std::string dots = write("dots.plt", "IN;SP1;PU400,400;PD;PU;");
  EXPECT_THAT(passo("cam engrave " + dots + " --on-line --depth -0.5 --spindle 0").out,
              HasSubstr("G0 X10 Y10\nG0 Z0.5\nF60\nG1 Z-0.5\nG0 Z2\n"));
  EXPECT_THAT(passo("cam drill " + dots + " --drill 1 -o " + path("d.ngc")).out, HasSubstr("1 hole"));
  EXPECT_THAT(passo("cam engrave --text A --arc 90,0").err, HasSubstr("--arc also needs --around R"));
  EXPECT_THAT(passo("cam engrave --text A --arc 90 --around 9").err, HasSubstr("--arc: expected FROM,TO"));
}

// A grey TIFF picture without compression, of one strip. It is bright beyond 200 pixels.
std::string grey_tiff(unsigned columns, unsigned rows, const std::function<bool(unsigned, unsigned)>& is_dark) {
  std::string bytes = "II";
  const auto add = [&](unsigned value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  add(42, 2);
  add(8, 4);
  constexpr unsigned entries = 8;
  const unsigned pixels_at = 8 + 2 + 12 * entries + 4;
  add(entries, 2);
  const std::pair<unsigned, unsigned> tags[entries] = {
      {256, columns}, {257, rows}, {258, 8}, {259, 1}, {262, 1}, {273, pixels_at}, {278, rows}, {279, columns * rows}};
  for (const auto& [tag, value] : tags) {
    add(tag, 2);
    add(4, 2);
    add(1, 4);
    add(value, 4);
  }
  add(0, 4);
  bytes.resize(pixels_at + columns * rows, '\xF0');
  for (unsigned row = 0; row < std::min(rows, 200U); ++row) {
    for (unsigned column = 0; column < std::min(columns, 200U); ++column) {
      if (is_dark(column, row)) bytes[pixels_at + row * columns + column] = '\x10';
    }
  }
  return bytes;
}

TEST_F(CamPart, the_dark_areas_of_a_picture_are_traced_and_carved) {
  const auto in_disc = [](unsigned x, unsigned y) { return std::hypot(x + 0.5 - 100, y + 0.5 - 60) < 50; };
  const std::string picture = write("disc.tif", grey_tiff(200, 120, in_disc));
  const std::string trace = "cam engrave " + picture + " --angle 90 --tool 40 --width 40 --json -o " + path("d.ngc");
  EXPECT_EQ(passo(trace).code, 2) << "a picture is no drawing";
  const Outcome made = passo(trace + " --trace");
  if (made.err.find("potrace: not found; apt install potrace") != std::string::npos) {
    EXPECT_EQ(made.code, 2);
    EXPECT_THAT(made.err, HasSubstr("[trace.no-potrace]"));
    GTEST_SKIP() << "potrace is not installed";
  }
  ASSERT_EQ(made.code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_NEAR(json["area_mm2"], M_PI * 10 * 10, 4);
  EXPECT_NEAR(json["deepest_mm"], -10, 0.1);
  const auto inverted = nlohmann::json::parse(passo(trace + " --trace --invert").out);
  EXPECT_NEAR(inverted["area_mm2"], 40 * 24 - M_PI * 10 * 10, 4);
  EXPECT_THAT(passo(trace + " --trace --threshold 0").err, HasSubstr("[trace.nothing]"));
  EXPECT_THAT(passo("cam engrave " + bracket + " --trace").err, HasSubstr("[trace.no-picture]"));
  EXPECT_THAT(passo("cam engrave --text A --trace").err, HasSubstr("--trace: expected a picture"));
  const std::string large = write("large.tif", grey_tiff(4200, 4000, in_disc));
  EXPECT_THAT(passo("cam engrave " + large + " --trace").err, HasSubstr("[trace.too-large]"));
}

TEST_F(CamPart, plots_are_drawn_by_a_pen_or_cut_by_a_knife) {
  const std::string svg = write(
      "p.svg", "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><path d='M5 5H15V25H35V35H5z M20 5H30'/></svg>");
  const Outcome pen = passo("cam plot " + svg + " --pen-down -0.4 -o " + path("p.ngc") + " -p " + path("p.png"));
  EXPECT_EQ(pen.code, 0) << pen.err;
  EXPECT_THAT(pen.out, HasSubstr("1 closed line, 1 open line and 0 dots: 130.0 mm drawn"));
  EXPECT_THAT(passo("check " + path("p.ngc") + on_router).out, HasSubstr("no errors"));
  EXPECT_THAT(read(path("p.ngc")), Not(HasSubstr("M3")));
  const Outcome knife = passo("cam plot " + svg + " --knife 0.25 --servo 90,30 --json -o " + path("k.ngc"));
  EXPECT_EQ(knife.code, 0) << knife.err;
  EXPECT_THAT(knife.out, HasSubstr("\"closed\": 1"));
  EXPECT_THAT(read(path("k.ngc")), HasSubstr("\nM3 S90\nG4 P0.2\n"));
  EXPECT_THAT(read(path("k.ngc")), Not(HasSubstr("G0 Z")));
  EXPECT_THAT(read(path("k.ngc")), Not(HasSubstr("G1 Z")));
  EXPECT_THAT(passo("check " + path("k.ngc") + on_router).out, HasSubstr("no errors"));
  EXPECT_THAT(passo("cam plot " + svg + " --servo up").err, HasSubstr("--servo: expected DOWN or DOWN,UP"));
  EXPECT_THAT(passo("cam plot " + svg + " --pen-up -1").err, HasSubstr("--pen-up: expected a Z above --pen-down"));
  EXPECT_EQ(passo("cam plot " + write("no.svg", "<svg width='40mm' height='40mm'/>")).code, 2);
}

TEST_F(CamPart, an_option_without_effect_is_a_warning) {
  const std::string svg = write(
      "s.svg", "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><rect x='5' y='5' width='30' height='30'/></svg>");
  const auto warned = [&](const std::string& command, const std::string& warning) {
    const Outcome made = passo(command + " -o " + path("s.ngc"));
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr(warning)) << command;
  };
  warned("cam profile " + svg + " --spring-passes 2",
         "--spring-passes: warning: it has no effect: it works only with finish-pass [option.no-effect]");
  warned("cam pocket " + svg + " --finish-feed 100", "--finish-feed: warning: it has no effect");
  warned("cam profile " + svg + " --chamfer 0.5 --depth -3 --step 1", "--step: warning: it has no effect: a chamfer");
  EXPECT_EQ(passo("cam profile " + svg + " --finish-pass --spring-passes 1 -o " + path("s.ngc")).err, "");
}

TEST_F(CamPart, an_inlay_has_a_pocket_and_a_mirrored_plug) {
  const std::string svg =
      write("l.svg", "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><path d='M5 5H15V25H35V35H5z'/></svg>");
  const std::string both = "cam engrave " + svg + " --tool 8 --clear 2 --inlay ";
  EXPECT_EQ(passo(both + "pocket -o " + path("pocket.ngc")).code, 0);
  const Outcome plug = passo(both + "plug -o " + path("plug.ngc"));
  EXPECT_EQ(plug.code, 0) << plug.err;
  EXPECT_THAT(plug.out, HasSubstr("drawn: X -35 to -5"));
  EXPECT_THAT(plug.out, HasSubstr("at most 4.5 mm deep"));
  EXPECT_THAT(passo("check " + path("plug.ngc") + on_router).out, HasSubstr("no errors"));
  EXPECT_THAT(passo("cam engrave " + svg + " --tool 4 --inlay plug").err, HasSubstr("--tool: expected 5.2 mm or more"));
  const Outcome floor = passo("cam engrave " + svg + " --tool 8 --inlay pocket -o " + path("floor.ngc"));
  EXPECT_EQ(floor.code, 2);
  EXPECT_THAT(floor.err, HasSubstr("so the halves would not fit into each other: expected --clear D"));
}

// The flat cutter does not fit between the walls: the V-bit mills the floor.
TEST_F(CamPart, the_floor_of_an_inlay_is_flat_where_the_flat_cutter_is_too_wide) {
  const std::string svg =
      write("bar.svg",
            "<svg width='40mm' height='10mm' viewBox='0 0 40 10'><rect x='5' y='3' width='30' height='4.5'/></svg>");
  const Outcome made = passo("cam engrave " + svg +
                             " --angle 60 --tool 6 --inlay pocket --inlay-depth 2 --clear 3 -o " + path("bar.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, Not(HasSubstr("not reached")));
  EXPECT_THAT(made.err, Not(HasSubstr("not cleared")));
  const Outcome cut =
      passo("simulate " + path("bar.ngc") + " --tool vee:60:6 --cell 0.05 --stock X0:40,Y0:10,Z-4:0 --json");
  EXPECT_EQ(cut.code, 0) << cut.out << cut.err;
}

TEST_F(CamPart, the_core_of_a_wing_has_room_for_skin_and_spars) {
  const std::string wing = "cam wire " + checkout + "/examples/foam/naca2412.dat --chord 220 ";
  const std::string out = " -o " + path("c.ngc");
  const Outcome made = passo(wing + "--skin 1.5 --spar 30%,6,5 --spar 30%,6,5,below" + out);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("mm² of the part lost"));
  EXPECT_THAT(passo(wing + "--skin 30" + out).err, HasSubstr("[wire.thick-skin]"));
  EXPECT_THAT(passo(wing + "--spar 30%,6,40" + out).err, HasSubstr("[wire.no-spar]"));
  EXPECT_THAT(passo(wing + "--spar 30%,0.5,5" + out).err, HasSubstr("expected a wider slot"));
  EXPECT_THAT(passo(wing + "--spar 30%" + out).err, HasSubstr("--spar: expected AT,WIDTH,DEPTH"));
  EXPECT_THAT(passo(wing + "--spar 130%,6,5" + out).err, HasSubstr("from 0% to 100%"));
}

TEST_F(CamPart, foam_is_cut_by_two_ends_of_a_wire) {
  const std::string foam = checkout + "/examples/foam";
  const std::string wing = "cam wire " + foam + "/naca2412.dat " + foam + "/naca0010.dat --chord 220,140 ";
  const Outcome made =
      passo(wing + "--span 900 --width 600 --kerf 1.2 --zero -30,-60 -o " + path("w.ngc") + " -p " + path("w.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("right: "));
  EXPECT_THAT(made.out, HasSubstr("0 mm² of the part lost"));
  const std::string foam_cutter = " -m " + checkout + "/examples/machines/foam.toml";
  EXPECT_THAT(passo("check " + path("w.ngc") + foam_cutter).out, HasSubstr("no errors"));
  const Outcome letter = passo("cam wire " + bracket + " --layer pocket --kerf 1");
  EXPECT_THAT(letter.err, HasSubstr("[wire.several-lines]"));
  EXPECT_THAT(passo(wing + "--span 900").err, HasSubstr("--width (of the block)"));
  EXPECT_THAT(passo("cam wire " + foam + "/naca2412.dat").err, HasSubstr("give --chord"));
  EXPECT_THAT(passo(wing + "--span 900 --width 600 --kerf 1@100,2@100").err, HasSubstr("--kerf: expected WIDTH"));
}

TEST_F(CamPart, what_is_wrong_is_told) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = passo("cam " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
  };
  refused("profile " + path("none.svg"), "[drawing.unreadable]");
  refused("profile " + write("a.txt", "hello\n"), "[drawing.unknown-kind]");
  refused("profile " + write("b.svg", "<svg><path d='M0 0 L x'/></svg>"), "[svg.path]");
  refused("pocket " + write("c.svg", "<svg width='9' height='9'/>"), "[pocket.no-area]");
  refused("profile " + bracket + " --layer cut --sheet 30,200", "[profile.off-sheet]");
  refused("profile " + bracket + " --sheet 30,-200", "--sheet: expected W,H above 0");
  refused("profile " + bracket + " --side on --tab 1,1", "--side on");
  refused("pocket " + bracket + " --tool 0", "--tool: expected a length above 0");
  refused("pocket " + bracket + " --depth -3 --step 0.0001", "--step: expected 0.001 mm or more");
  refused("pocket " + bracket + " --engagement 10", "--engagement: expected 0, or 30 to 150 degrees, found 10");
  refused("profile " + bracket + " --depth 3", "--depth: expected a length below 0");
  refused("profile " + bracket + " -o " + bracket, "the file");
  const Outcome layer = passo("cam pocket " + bracket + " --layer pokket");
  EXPECT_EQ(layer.code, 2);
  EXPECT_THAT(layer.err, HasSubstr("there is no layer 'pokket'"));
}

TEST_F(CamPart, a_compressed_drawing_is_read_and_a_broken_one_refused) {
  // <svg width="20mm" height="10mm" viewBox="0 0 20 10"><rect x="2" y="2" width="16" height="6"/></svg>
  const unsigned char bytes[] = {
      0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x45, 0x8c, 0x51, 0x0a, 0xc2, 0x30, 0x10, 0x44,
      0xaf, 0xb2, 0xcc, 0x01, 0xba, 0x9b, 0x08, 0xfd, 0x90, 0x24, 0x1f, 0x5e, 0x45, 0x43, 0x12, 0x30, 0x56, 0xda,
      0xa5, 0xdb, 0xde, 0xde, 0x5a, 0x04, 0x7f, 0x06, 0x66, 0x78, 0xf3, 0xc2, 0xb2, 0x16, 0xda, 0xfa, 0xf3, 0xb5,
      0x44, 0x54, 0xd5, 0xf7, 0x95, 0xd9, 0xcc, 0x06, 0xbb, 0x0c, 0xd3, 0x5c, 0xd8, 0x8b, 0x08, 0x1f, 0x04, 0xc8,
      0xda, 0x43, 0x6b, 0x84, 0x97, 0xde, 0x41, 0x35, 0xb7, 0x52, 0x35, 0xc2, 0x9d, 0x6d, 0x6d, 0xd9, 0x6e, 0xd3,
      0x16, 0x21, 0x24, 0xe4, 0x85, 0x9c, 0x20, 0x85, 0x39, 0xdf, 0x95, 0x8e, 0xcd, 0x83, 0xf6, 0x33, 0x7f, 0x02,
      0x37, 0xfe, 0xef, 0x23, 0x38, 0x85, 0xaf, 0x3e, 0x7d, 0x00, 0xc7, 0x2b, 0xf1, 0x29, 0x86, 0x00, 0x00, 0x00};
  const std::string whole(reinterpret_cast<const char*>(bytes), sizeof bytes);
  const Outcome made = passo("cam pocket " + write("a.svgz", whole) + " --tool 2 --depth -1 -o " + path("a.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("drawn: X 2 to 18, Y 2 to 8 mm"));
  for (const std::string& broken : {whole.substr(0, 60), whole.substr(0, 20) + std::string(40, 'x')}) {
    const Outcome refused = passo("cam pocket " + write("b.svgz", broken) + " --tool 2 --depth -1");
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("[drawing.bad-gzip]"));
  }
}

TEST_F(CamPart, deep_letters_are_carved_in_layers) {
  const std::string engrave = "cam engrave " + bracket + " --layer pocket --angle 60 --tool 12 -o " + path("e.ngc");
  EXPECT_THAT(passo(engrave).out, Not(HasSubstr("layers")));
  const Outcome made = passo(engrave + " --step 2");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("layers\n"));
  EXPECT_EQ(passo(engrave + " --step 0.001").code, 2);
}

TEST_F(CamPart, parts_are_nested_on_sheets_with_a_program_each) {
  const std::string drawing =
      write("l.svg",
            "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='60mm' viewBox='0 0 60 60'>"
            "<path d='M0 0h40v15h-25v25h-15z'/><circle cx='8' cy='8' r='4'/><circle cx='50' cy='50' r='6'/></svg>");
  const std::string order = "cam profile " + drawing + " --tool 3 --depth -3 --tabs 2 --quantity 9";
  const std::string pair = "cam profile " + drawing + " --tool 3 --depth -3 --tabs 2 --nest 100,60";
  const Outcome wide = passo(pair + " --json -o " + path("w.ngc"));
  ASSERT_EQ(wide.code, 0) << wide.err;
  EXPECT_EQ(nlohmann::json::parse(wide.out)["nest"]["gap_mm"], 7.0) << "two cuts, and 1 mm that the tabs end in";
  EXPECT_THAT(wide.err, Not(HasSubstr("nest.tabs")));
  EXPECT_THAT(passo(pair + " --gap 6 -o " + path("w.ngc")).err, HasSubstr("[nest.tabs]"));
  EXPECT_THAT(passo(pair + " --gap 6 --no-tabs -o " + path("w.ngc")).err, Not(HasSubstr("nest.tabs")));
  const Outcome made = passo(order + " --nest 130,90 --gap 4 --json -p " + path("n.svg") + " -o " + path("n.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  const nlohmann::json told = nlohmann::json::parse(made.out);
  EXPECT_EQ(told["nest"]["gap_mm"], 4.0);
  ASSERT_EQ(told["nest"]["sheets"].size(), 2U);
  EXPECT_EQ(told["nest"]["sheets"][0]["copies"].size() + told["nest"]["sheets"][1]["copies"].size(), 18U);
  EXPECT_EQ(told["programs"].size(), 2U);
  for (const char* file : {"n-1.ngc", "n-2.ngc"}) expect_cuts_well(path(file), "X-2:132,Y-2:92,Z-3:0");
  EXPECT_THAT(read(path("n-2.svg")), HasSubstr("Offcut"));

  EXPECT_THAT(passo(order + " --nest 130,90 --gap 4").err, HasSubstr("2 sheets have a program each"));
  EXPECT_THAT(passo(order + " --nest 35,60 -o " + path("x.ngc")).err,
              HasSubstr("of 40 x 40 mm does not fit on a sheet of 35 x 60 mm with a margin of 4 mm"));
  EXPECT_THAT(passo(order + " --nest 130,90 --gap 2 -o " + path("x.ngc")).err,
              HasSubstr("--gap: expected at least 3 mm, which the cutter and its lead-in need, found '2'"));
  EXPECT_THAT(passo(order + " --nest 130 -o " + path("x.ngc")).err, HasSubstr("--nest: expected X,Y, found '130'"));
}

}  // namespace
