#include "passo/cam/gerber.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double pi = std::numbers::pi;

struct ReadGerber {
  GerberLayer layer;
  Diagnostics found;
  double area() const { return area_mm2(layer.dark); }
  const std::vector<std::string>& notes() const { return layer.strokes.notes; }
};
ReadGerber read_all(const std::string& text) {
  ReadGerber result;
  result.layer = read_gerber("board.gbr", text, result.found);
  return result;
}
// In mm, 2.3 digits: X1000 is 1 mm.
ReadGerber read_mm(const std::string& body) {
  return read_all("%FSLAX33Y33*%\n%MOMM*%\n" + body + "M02*\n");
}
ReadGerber flashed(const std::string& aperture) {
  return read_mm("%ADD10" + aperture + "*%\nD10*\nX0Y0D03*\n");
}
ReadGerber macro_flashed(const std::string& statements, const std::string& arguments = "") {
  return read_mm("%AMSHAPE*\n" + statements + "%\n%ADD10SHAPE" + arguments + "*%\nD10*\nX0Y0D03*\n");
}
std::string gerber_code(const ReadGerber& read) {
  return read.found.all().empty() ? "" : read.found.all().front().code;
}
DrawnPoint um(std::int64_t x, std::int64_t y) {
  return {{x * 1000}, {y * 1000}};
}
bool covers(const ReadGerber& read, std::int64_t x, std::int64_t y) {
  return contains(read.layer.dark, um(x, y));
}

TEST(Gerber, coordinates_are_exact_in_every_format) {
  const auto place = [](const std::string& format, const std::string& words) {
    const ReadGerber read = read_all(format + "%ADD10C,0.1*%D10*" + words + "D03*M02*");
    EXPECT_TRUE(read.found.all().empty()) << render(read.found, false);
    return read.layer.pads.empty() ? DrawnPoint{} : read.layer.pads.back().at;
  };
  EXPECT_EQ(place("%FSLAX24Y24*%%MOIN*%", "X10005Y-1"), (DrawnPoint{{25'412'700}, {-2'540}}));
  EXPECT_EQ(place("%FSTAX24Y24*%%MOIN*%", "X01Y-000001"), (DrawnPoint{{25'400'000}, {-2'540}}));
  EXPECT_EQ(place("%FSLAX46Y46*%%MOMM*%", "X123456789Y1"), (DrawnPoint{{123'456'789}, {1}}));
  EXPECT_EQ(place("%FSDAX33Y42*%%MOMM*%", "X001500Y000150"), um(1500, 1500));
  EXPECT_EQ(place("%FSLAN2X33Y33*MOMM*%", "X1500Y1500"), um(1500, 1500)) << "two commands between two percent signs";
  EXPECT_EQ(place("%FSLIX33Y33*%%MOMM*%", "X1000Y0D02*X500Y500"), um(1500, 500)) << "incremental";
  EXPECT_EQ(place("%FSLAX33Y33*%G71*", "X1.5Y2"), (DrawnPoint{{1'500'000}, {2'000}})) << "a decimal point";
}

TEST(Gerber, standard_apertures_have_their_areas) {
  EXPECT_NEAR(flashed("C,2").area(), pi, 0.004);
  EXPECT_NEAR(flashed("C,2X1").area(), pi * 0.75, 0.004);
  EXPECT_DOUBLE_EQ(flashed("R,2X3").area(), 6);
  EXPECT_NEAR(flashed("R,2X3X1").area(), 6 - pi / 4, 0.002);
  EXPECT_DOUBLE_EQ(flashed("R,2X3X1X0.5").area(), 5.5);
  EXPECT_NEAR(flashed("O,1X3").area(), 2 + pi / 4, 0.002);
  EXPECT_NEAR(flashed("O,3X1").area(), 2 + pi / 4, 0.002);
  EXPECT_NEAR(flashed("P,2X4").area(), 2, 1e-6);
  EXPECT_NEAR(flashed("P,2X6X10X0.5").area(), 1.5 * std::sqrt(3) - pi / 16, 0.002);
  EXPECT_DOUBLE_EQ(flashed("C,0").area(), 0);
  const ReadGerber square = flashed("P,2X4X45");
  EXPECT_TRUE(covers(square, 700, 700)) << "turned by 45 degrees: a square that stands";
  EXPECT_FALSE(covers(square, 900, 0));
  const GerberAperture told = flashed("O,1X3").layer.apertures.at(0);
  EXPECT_EQ(told.code, 10U);
  EXPECT_EQ(told.shape, "O");
  EXPECT_EQ(told.across, Nanometres{1'000'000});
  EXPECT_EQ(told.up, Nanometres{3'000'000});
}

TEST(Gerber, macro_primitives_have_their_areas) {
  EXPECT_NEAR(macro_flashed("1,1,2,5,0*").area(), pi, 0.004);
  EXPECT_NEAR(macro_flashed("20,1,0.5,0,0,3,4,0*").area(), 2.5, 1e-5);
  EXPECT_NEAR(macro_flashed("2,1,0.5,0,0,3,4,30*").area(), 2.5, 1e-5);
  EXPECT_NEAR(macro_flashed("21,1,2,1,0,0,30*").area(), 2, 1e-5);
  EXPECT_DOUBLE_EQ(macro_flashed("22,1,2,1,1,1,0*").area(), 2);
  EXPECT_DOUBLE_EQ(macro_flashed("4,1,3,0,0,2,0,0,2,0,0,0*").area(), 2);
  EXPECT_DOUBLE_EQ(macro_flashed("4,1,3,0,0,0,1,1,1,1,0,0*").area(), 1) << "the last corner is not the first";
  EXPECT_NEAR(macro_flashed("5,1,6,0,0,2,0*").area(), 1.5 * std::sqrt(3), 1e-5);
  // Rings of 10 and 8 outside, 0.5 thick, and a cross of 12 by 0.1 that covers parts of the rings.
  const double rings = pi / 4 * (100 - 81 + 49 - 36);
  EXPECT_NEAR(macro_flashed("6,0,0,10,0.5,1,2,0,0,0*").area(), rings, 0.02);
  const double cross = 2 * 12 * 0.1 - 0.01 - 4 * (0.5 + 0.5) * 0.1;
  EXPECT_NEAR(macro_flashed("6,0,0,10,0.5,1,2,0.1,12,30*").area(), rings + cross, 0.03);
  EXPECT_NEAR(macro_flashed("7,0,0,4,2,0.01,45*").area(), pi * 3 - 4 * 1 * 0.01, 0.01);
}

TEST(Gerber, macros_turn_about_zero_count_and_take_away) {
  const ReadGerber moved = macro_flashed("21,1,1,1,3,0,90*");
  EXPECT_TRUE(covers(moved, 0, 3000)) << "turned about zero, not about the square's middle";
  EXPECT_NEAR(macro_flashed("0 $1 is a width*$2=$1x(1+1)-$1/4*21,1,$1,$2,0,0,0*", ",2").area(), 7, 1e-6);
  EXPECT_NEAR(macro_flashed("21,1,$1,$2,0,0,0*", ",2").area(), 0, 1e-9) << "a missing variable is 0";
  EXPECT_DOUBLE_EQ(macro_flashed("21,1,4,4,0,0,0*21,0,2,2,0,0,0*21,1,1,1,0,0,0*").area(), 13);
  const ReadGerber below =
      read_mm("%AMHOLED*21,1,4,4,0,0,0*21,0,2,2,0,0,0*%%ADD10HOLED*%%ADD11R,1X1*%D11*X0Y0D03*D10*X0Y0D03*");
  EXPECT_DOUBLE_EQ(below.area(), 13) << "a hole of a macro takes nothing away from what is below";
}

TEST(Gerber, strokes_are_as_wide_as_their_aperture) {
  EXPECT_NEAR(read_mm("%ADD10C,1*%D10*X0Y0D02*X3000Y4000D01*").area(), 5 + pi / 4, 0.007)
      << "its rim of 13 mm is at most 0.5 um inside";
  EXPECT_NEAR(read_mm("%ADD10C,1*%D10*X0Y0D02*X5000D01*Y5000D01*").area(), 10 + pi / 4 + pi / 16 - 0.25, 0.004);
  EXPECT_NEAR(read_mm("%ADD10R,1X1*%D10*X0Y0D02*X5000D01*").area(), 6, 1e-9);
  EXPECT_NEAR(read_mm("%ADD10R,1X1*%D10*X0Y0D02*X5000Y5000D01*").area(), 11, 1e-9);
  const ReadGerber chain = read_mm("%ADD10C,0.2*%D10*X0Y0D02*X5000D01*Y5000D01*X0Y0D01*X0Y9000D02*X1000D01*");
  ASSERT_EQ(chain.layer.strokes.paths.size(), 2U);
  EXPECT_TRUE(chain.layer.strokes.paths[0].is_closed);
  EXPECT_EQ(chain.layer.strokes.paths[0].points.size(), 3U);
  EXPECT_EQ(chain.layer.strokes.paths[0].width, Nanometres{200'000});
  EXPECT_EQ(chain.layer.strokes.layers.at(0), "D10");
}

TEST(Gerber, arcs_turn_as_both_modes_say) {
  const std::string pen = "%ADD10C,0.2*%D10*";
  const double ring = 2 * pi * 5 * 0.2;
  EXPECT_NEAR(read_mm(pen + "G75*G03*X5000Y0D02*X5000Y0I-5000J0D01*").area(), ring, 0.005);
  EXPECT_NEAR(read_mm(pen + "G75*G02*X5000Y0D02*X0Y5000I-5000J0D01*").area(), ring * 3 / 4 + pi / 100, 0.005);
  EXPECT_NEAR(read_mm(pen + "G74*G03*X5000Y0D02*X0Y5000I5000J0D01*").area(), ring / 4 + pi / 100, 0.005);
  const ReadGerber clockwise = read_mm(pen + "G74*G02*X5000Y0D02*X0Y-5000I5000J0D01*");
  EXPECT_TRUE(covers(clockwise, 3535, -3535));
  EXPECT_NEAR(clockwise.layer.strokes.paths.at(0).points.at(0).bulge, -std::tan(pi / 8), 1e-9);
  EXPECT_THAT(read_mm(pen + "G03*X5000Y0D02*X0Y5000I-5000J0D01*").notes(),
              testing::ElementsAre(testing::HasSubstr("G75, because I or J is negative")));
  EXPECT_EQ(gerber_code(read_mm(pen + "G74*G03*X5000Y0D02*X-5000Y1I5000J0D01*")), "gerber.bad-arc");
}

TEST(Gerber, regions_have_contours_with_arcs_and_cut_ins) {
  EXPECT_DOUBLE_EQ(read_mm("G36*X0Y0D02*X4000D01*Y3000D01*X0D01*Y0D01*G37*").area(), 12);
  EXPECT_DOUBLE_EQ(read_mm("G36*X0Y0D02*X4000D01*Y3000D01*X0D01*Y0D01*X5000Y0D02*X6000D01*Y1000D01*G37*").area(), 12.5)
      << "two contours, the second without its last side";
  EXPECT_NEAR(read_mm("G75*G36*X-1000Y0D02*G01*X1000D01*G03*X-1000Y0I-1000J0D01*G37*").area(), pi / 2, 0.002);
  EXPECT_DOUBLE_EQ(read_mm("G36*X0Y0D02*X2000D01*Y1000D01*X1000D01*Y2000D01*X3000D01*Y1000D01*X2000D01*Y0D01*X4000D01*"
                           "Y3000D01*X0D01*Y0D01*G37*")
                       .area(),
                   12 - 2)
      << "the cut-in leads to a hole and back on its own way";
}

TEST(Gerber, clear_takes_away_what_is_below_alone) {
  const std::string tools = "%ADD10R,4X4*%%ADD11R,2X2*%%ADD12R,1X1*%";
  const ReadGerber read = read_mm(tools + "D10*X0Y0D03*%LPC*%D11*X0Y0D03*%LPD*%D12*X0Y0D03*");
  EXPECT_DOUBLE_EQ(read.area(), 16 - 4 + 1);
  EXPECT_EQ(read.layer.pads.size(), 2U) << "what is clear is no pad";
}

TEST(Gerber, apertures_are_mirrored_turned_and_scaled) {
  const std::string flag = "%AMFLAG*22,1,2,1,0,0,0*%%ADD10FLAG*%D10*";
  EXPECT_TRUE(covers(read_mm(flag + "X0Y0D03*"), 1900, 900));
  EXPECT_TRUE(covers(read_mm(flag + "%LMX*%X0Y0D03*"), -1900, 900));
  EXPECT_TRUE(covers(read_mm(flag + "%LMXY*%X0Y0D03*"), -1900, -900));
  EXPECT_TRUE(covers(read_mm(flag + "%LR90*%X0Y0D03*"), -900, 1900));
  EXPECT_TRUE(covers(read_mm(flag + "%LMX*%%LR90*%X0Y0D03*"), -900, -1900)) << "mirrored before it is turned";
  EXPECT_DOUBLE_EQ(read_mm(flag + "%LS1.5*%X0Y0D03*").area(), 4.5);
  EXPECT_DOUBLE_EQ(read_mm(flag + "%LMX*%X0Y0D03*%LMN*%X0Y0D03*").area(), 4);
}

TEST(Gerber, blocks_and_repeats_go_into_one_another) {
  const std::string dot = "%ADD10R,1X1*%%ADD11R,0.5X0.5*%";
  const ReadGerber panel = read_mm(dot + "%SRX3Y2I5.0J4.0*%D10*X0Y0D03*%LPC*%D11*X0Y0D03*%LPD*%%SR*%X50000Y0D03*");
  EXPECT_DOUBLE_EQ(panel.area(), 6 * 0.75 + 0.25);
  EXPECT_EQ(panel.layer.pads.size(), 7U);
  EXPECT_EQ(panel.layer.pads[1].at, um(0, 4000)) << "columns are filled first";
  const ReadGerber block = read_mm(dot +
                                   "%ABD20*%%ABD21*%D10*X0Y0D03*%LPC*%D11*X0Y0D03*%LPD*%%AB*%D21*X0Y0D03*X10000Y0D03*%"
                                   "AB*%D20*X0Y0D03*%LR90*%X0Y20000D03*%LR0*%");
  EXPECT_DOUBLE_EQ(block.area(), 4 * 0.75);
  EXPECT_TRUE(covers(block, 400, 30'400));
  const ReadGerber inverted =
      read_mm(dot + "%ADD12R,9X9*%%ABD20*%D10*X0Y0D03*%LPC*%D11*X0Y0D03*%LPD*%%AB*%D12*X0Y0D03*%LPC*%D20*X0Y0D03*");
  EXPECT_DOUBLE_EQ(inverted.area(), 81 - 1 + 0.25) << "a clear block turns its polarities over";
}

TEST(Gerber, old_codes_move_the_image) {
  const std::string flash = "%ADD10R,1X1*%D10*X1000Y2000D03*";
  EXPECT_TRUE(covers(read_mm("%OFA1B0*%" + flash), 2000, 2000));
  EXPECT_TRUE(covers(read_mm("%MIA1B0*%" + flash), -1000, 2000));
  EXPECT_TRUE(covers(read_mm("%SFA2B2*%" + flash), 2000, 4000));
  EXPECT_TRUE(covers(read_mm("%ASAYBX*%" + flash), 2000, 1000));
  EXPECT_TRUE(covers(read_mm("%IR90*%" + flash), -2000, 1000));
  EXPECT_TRUE(read_mm("%IPNEG*%" + flash).layer.is_negative);
  EXPECT_EQ(gerber_code(read_mm("%KOCX0Y0I5J5*%" + flash)), "gerber.unsupported");
  const ReadGerber old =
      read_all("%FSLAX24Y24*%%MOIN*%%ADD10C,0.05*%N10G54D10*N20G01X10Y10D02*Y20D01*X30*M00*garbage*");
  EXPECT_TRUE(old.found.all().empty());
  EXPECT_EQ(old.layer.strokes.paths.at(0).points.size(), 3U) << "D01 stays; M00 ends the file";
}

TEST(Gerber, attributes_tell_layer_apertures_and_nets) {
  const ReadGerber read = read_mm(
      "%TF.FileFunction,Copper,L1,Top*%%TF.GenerationSoftware,KiCad,Pcbnew,8*%%TA.AperFunction,ViaPad*%%ADD10C,1*%%TD*%"
      "D10*%TO.N,GND*%X0Y0D03*%TO.N,+5V*%X5000Y0D03*%TD.N*%X9000Y0D03*");
  EXPECT_EQ(read.layer.function, "Copper,L1,Top");
  EXPECT_EQ(read.layer.software, "KiCad,Pcbnew,8");
  EXPECT_EQ(read.layer.apertures.at(0).function, "ViaPad");
  EXPECT_THAT(read.layer.nets, testing::ElementsAre("", "GND", "+5V"));
  ASSERT_EQ(read.layer.pads.size(), 3U);
  EXPECT_EQ(read.layer.pads[1].net, 2U);
  EXPECT_EQ(read.layer.pads[2].net, 0U);
  EXPECT_EQ(read_mm("G04 #@! TF.FileFunction,Profile,NP*").layer.function, "Profile,NP");
}

TEST(Gerber, what_is_guessed_is_told) {
  const ReadGerber silent = read_all("%ADD10C,0.05*%D10*X10000Y0D03*");
  EXPECT_FALSE(silent.found.any_error());
  EXPECT_EQ(silent.layer.pads.at(0).at, (DrawnPoint{{25'400'000}, {0}}));
  EXPECT_THAT(silent.notes(),
              testing::ElementsAre(testing::HasSubstr("inch is assumed"), testing::HasSubstr("2.4 digits are assumed"),
                                   testing::HasSubstr("does not end with M02")));
  EXPECT_EQ(read_all("%ADD10C,1*%%FSLAX33Y33*%D10*X0Y0D03*G71*M02*").layer.apertures.at(0).across,
            Nanometres{1'000'000})
      << "the unit comes late";
}

TEST(Gerber, what_old_programs_write_beside_the_format_is_read) {
  const ReadGerber square = flashed("R,0.5");
  EXPECT_NEAR(square.area(), 0.25, 1e-9);
  EXPECT_THAT(square.notes(), testing::Contains(testing::HasSubstr("the height is assumed to be the same")));
  EXPECT_NEAR(macro_flashed("1,1,2,0,0*\n*").area(), macro_flashed("1,1,2,0,0*").area(), 1e-9)
      << "a lone * ends the macro";
  const ReadGerber point = flashed("R,0.5250.525");
  EXPECT_NEAR(point.area(), 0.525 * 0.525, 1e-9);
  EXPECT_THAT(point.notes(), testing::Contains(testing::HasSubstr("'0.5250.525' is read as 0.525")));
  const ReadGerber rest = read_mm("%ADD10C,2*X.015%\nD10*\nX0Y0D03*\n");
  EXPECT_NEAR(rest.area(), flashed("C,2").area(), 1e-9);
  EXPECT_THAT(rest.notes(), testing::Contains(testing::HasSubstr("'X.015' after the end of a command")));
}

TEST(Gerber, what_is_wrong_is_told_with_its_place) {
  const ReadGerber early = read_mm("D12*\nX0Y0D03*\n");
  EXPECT_EQ(gerber_code(early), "gerber.no-aperture");
  EXPECT_EQ(early.found.all().front().place, (SourceLocation{4, 1, 7}));
  const ReadGerber separate = read_mm("D12*\nX0Y0D03*\nX1D03*\nX2D01*\nD13*\nX3D03*\nD12*\nX4D03*\n");
  EXPECT_EQ(separate.found.all().size(), 2U) << "RS-274-D: one error for each aperture";
  EXPECT_THAT(std::string(separate.found.all().front().expected), testing::HasSubstr("RS-274-D"));
  const ReadGerber digits = read_mm("%ADD10C,1*%D10*\nX0\nY1-2D03*\n");
  EXPECT_EQ(gerber_code(digits), "gerber.bad-number");
  EXPECT_EQ(digits.found.all().front().place, (SourceLocation{5, 1, 4})) << "a command on two lines";
  EXPECT_EQ(digits.found.all().front().text, "Y1-2D03*");
  EXPECT_EQ(gerber_code(read_mm("hello*")), "gerber.unknown-command");
  EXPECT_EQ(gerber_code(read_mm("%ZZ*%")), "gerber.unknown-command");
  EXPECT_EQ(gerber_code(read_mm("G12*")), "gerber.unknown-command");
  EXPECT_EQ(gerber_code(read_mm("%ADD10Q,1*%")), "gerber.bad-aperture");
  EXPECT_EQ(gerber_code(read_mm("%ADD10P,1*%")), "gerber.bad-aperture");
  EXPECT_EQ(gerber_code(read_mm("%ADD10C,x*%")), "gerber.bad-number");
  EXPECT_EQ(gerber_code(read_all("%FSLAX*%M02*")), "gerber.bad-format");
  EXPECT_EQ(gerber_code(read_mm("%LPX*%")), "gerber.bad-mode");
  EXPECT_EQ(gerber_code(read_mm("%AB*%")), "gerber.bad-block");
  EXPECT_EQ(gerber_code(read_mm("%ADD10C,1*%D10*G36*X0Y0D03*G37*")), "gerber.bad-region");
  EXPECT_EQ(gerber_code(read_mm("%ADD10C,1*%%ABD11*%D10*X0Y0D03*%AB*%D11*X5Y5D01*")), "gerber.bad-stroke");
  EXPECT_EQ(gerber_code(read_all("%FSLAX66Y66*%%MOIN*%%ADD10C,1*%D10*X999999999999Y0D03*")), "gerber.bad-number");
  const ReadGerber macro = read_mm("%AMBAD*\n1,1,$1,0,0*\n9,1*\n%\n%ADD10BAD,1*%");
  EXPECT_EQ(gerber_code(macro), "gerber.bad-macro");
  EXPECT_EQ(macro.found.all().front().place.line, 5U) << "in the macro, not where it is used";
  EXPECT_EQ(gerber_code(macro_flashed("21,1,(((2,1,0,0,0*")), "gerber.bad-macro");
}

TEST(Gerber, strokes_of_an_aperture_without_a_face_cover_nothing) {
  const ReadGerber read = read_mm("%AMT*7,0,0,1,0,2,0*%\n%ADD10T*%\nD10*\nX0Y0D02*\nX5000Y0D01*\nX5000Y5000D03*\n");
  EXPECT_EQ(gerber_code(read), "");
  EXPECT_TRUE(read.layer.dark.empty());
}

// Each of the dark ones meets those clear ones that are near, and no others: all of them would be too many.
TEST(Gerber, hundreds_of_pads_have_hundreds_of_openings) {
  constexpr int side = 45;
  std::string pads;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      pads += "X" + std::to_string(3000 * column + 7 * row) + "Y" + std::to_string(3000 * row + 11 * column) + "D03*\n";
    }
  }
  const ReadGerber read = read_mm("%ADD10C,2*%\n%ADD11C,1*%\nD10*\n" + pads + "%LPC*%\nD11*\n" + pads);
  EXPECT_EQ(gerber_code(read), "");
  EXPECT_NEAR(read.area(), side * side * flashed("C,2X1").area(), 0.01);
}

TEST(Gerber, bombs_end_at_the_limit) {
  std::string bomb = "%ADD10C,1*%%ABD11*%D10*X0Y0D03*X9Y9D03*%AB*%";
  for (int i = 12; i < 80; ++i) {
    bomb += "%ABD" + std::to_string(i) + "*%D" + std::to_string(i - 1) + "*X0Y0D03*X9Y9D03*%AB*%";
  }
  EXPECT_EQ(gerber_code(read_mm(bomb)), "gerber.too-large");
  EXPECT_EQ(gerber_code(read_mm("%ADD10C,1*%%SRX100000Y100000I0.001J0.001*%D10*X0Y0D03*%SR*%")), "gerber.too-large");
  std::string tangle = "%ADD10C,0.1*%D10*G36*X0Y0D02*";
  for (int i = 0; i < 20'000; ++i) {
    tangle += "X" + std::to_string(i * 7919 % 99'991) + "Y" + std::to_string(i % 2 * 90'000 + i) + "D01*";
  }
  EXPECT_EQ(gerber_code(read_mm(tangle + "G37*")), "gerber.too-large") << "too many crossings";
  std::string deep;
  for (int i = 10; i < 60; ++i) deep += "%ABD" + std::to_string(i) + "*%";
  EXPECT_EQ(gerber_code(read_mm(deep)), "gerber.nested-too-deep");
}

}  // namespace
}  // namespace passo
