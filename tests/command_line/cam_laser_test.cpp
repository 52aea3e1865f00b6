// passo cam laser, as a user starts it.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string tag = checkout + "/examples/laser/key-tag.svg";
const std::string ball = checkout + "/examples/laser/ball.png";

class CamLaser : public passo::test::CommandLine {
 protected:
  // The error of a command that must be refused.
  std::string refused(const std::string& words) const {
    const Outcome outcome = passo("cam laser " + words + " -o " + path("no.ngc"));
    EXPECT_EQ(outcome.code, 2) << words;
    EXPECT_EQ(read(path("no.ngc")), "") << words;
    return outcome.err;
  }
};

TEST_F(CamLaser, scores_blue_lines_and_then_cuts_the_others_with_kerf) {
  const Outcome made =
      passo("cam laser " + tag + " --score-color blue --score-power 15 --score-feed 2000 --kerf 0.2 --json -o " +
            path("t.ngc") + " -p " + path("t.png"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_EQ(json["scored"], nlohmann::json({{"closed", 2}, {"open", 25}}));
  EXPECT_EQ(json["closed"], 3);
  EXPECT_EQ(json["open"], 0);
  EXPECT_EQ(json["least_s"], 150);
  EXPECT_EQ(json["most_s"], 800);
  // The tag reaches from 1 to 69 and from 1 to 39 mm; the beam stays 0.1 mm outside.
  const std::vector<double> box = json["burned_box_mm"];
  EXPECT_NEAR(box[0], 0.9, 0.004);
  EXPECT_NEAR(box[1], 0.9, 0.004);
  EXPECT_NEAR(box[2], 69.1, 0.004);
  EXPECT_NEAR(box[3], 39.1, 0.004);
  const std::string program = read(path("t.ngc"));
  EXPECT_LT(program.rfind("S150"), program.find("S800", program.find("M4 S0"))) << "something is scored after a cut";
  EXPECT_THAT(program, HasSubstr("\nM4 S0\n"));
  EXPECT_THAT(program, Not(HasSubstr(" Z")));
  EXPECT_THAT(read(path("t.png")), StartsWith("\x89PNG"));
  const auto all = nlohmann::json::parse(passo("cam laser " + tag + " --json -o " + path("a.ngc")).out);
  EXPECT_EQ(all["closed"], 5);
  EXPECT_EQ(all["open"], 25);
}

TEST_F(CamLaser, places_scored_and_cut_lines_together) {
  const std::string svg =
      write("two.svg",
            "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><g fill='none'><rect stroke='red' x='5' y='5' "
            "width='20' height='20'/><path stroke='blue' d='M2 30H30'/></g></svg>");
  const Outcome made = passo("cam laser " + svg + " --score-color blue --zero lower-left --json -o " + path("z.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["burned_box_mm"], nlohmann::json({0, 0, 28, 25}));
  EXPECT_THAT(read(path("z.ngc")), HasSubstr("X0 Y0"));
  const Outcome only = passo("cam laser " + svg + " --score-color blue --color blue --json -o " + path("o.ngc"));
  ASSERT_EQ(only.code, 0) << only.err;
  EXPECT_EQ(nlohmann::json::parse(only.out)["closed"], 0) << "what is scored is not cut";
}

TEST_F(CamLaser, engraves_a_picture_with_overscan) {
  const Outcome made =
      passo("cam laser " + ball + " --width 24 --line-distance 0.2 --feed 3000 --zero -10,0 --json -o " +
            path("b.ngc") + " -p " + path("b.png"));
  ASSERT_EQ(made.code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_EQ(json["columns"], 120);
  EXPECT_EQ(json["rows"], 90);
  EXPECT_EQ(json["overscan_mm"], 1.25);
  EXPECT_EQ(json["moved_box_mm"][0], 0) << "the head comes from X0";
  EXPECT_EQ(json["burned_box_mm"][2], 34);
  const Outcome checked = passo("check " + path("b.ngc") + passo::test::on_router);
  EXPECT_THAT(checked.out, HasSubstr("no errors"));
  const Outcome inches =
      passo("cam laser " + ball + " --width 1 --mirror x --mode dither --scan y --units inch -o " + path("i.ngc"));
  ASSERT_EQ(inches.code, 0) << inches.err;
  EXPECT_THAT(inches.out, HasSubstr("254 x 190 cells of 0.1 mm: 25.4 x 19 mm"));
  EXPECT_THAT(read(path("i.ngc")), HasSubstr("G17 G20"));
}

TEST_F(CamLaser, makes_a_test_grid) {
  const Outcome made =
      passo("cam laser --grid 3x2 --grid-power 10,30 --grid-feed 1000,2000 --air flood -o " + path("g.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(
      made.out,
      HasSubstr("test grid: 3 x 2 cells; from left to right 10 to 30 %, from top to bottom 1000 to 2000 mm/min"));
  const std::string program = read(path("g.ngc"));
  EXPECT_NE(program.find("(X0 Y0 is the lower left corner of the lower left square)"), std::string::npos);
  EXPECT_NE(program.find("\nM8\nM4 S0\n"), std::string::npos);
  EXPECT_TRUE(program.ends_with("\nM5\nM9\nG0 X0 Y0\nM2\n"));
}

TEST_F(CamLaser, keeps_s_words_of_arcs_for_other_controllers) {
  const std::string svg =
      write("c.svg", "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><circle cx='20' cy='20' r='10'/></svg>");
  ASSERT_EQ(passo("cam laser " + svg + " --for grbl -o " + path("c.nc")).code, 0);
  EXPECT_THAT(read(path("c.nc")), HasSubstr(" F1000 S800\n"));
}

TEST_F(CamLaser, refuses_what_it_cannot_burn) {
  EXPECT_THAT(refused(""), HasSubstr("expected either a drawing or picture (FILE), or --grid"));
  EXPECT_THAT(refused(tag + " --grid 3x3"), HasSubstr("expected either"));
  EXPECT_THAT(refused("--grid 3"), HasSubstr("--grid: expected COLUMNSxROWS, from 1x1 to 20x20, found '3'"));
  EXPECT_THAT(refused("--grid 3x3 --grid-power 50,20"), HasSubstr("--grid-power: expected LEAST,MOST in percent"));
  EXPECT_THAT(refused("--grid 3x3 --grid-feed 50"), HasSubstr("--grid-feed: expected LEAST,MOST"));
  EXPECT_THAT(refused("--grid 3x3 --cell 1"), HasSubstr("--cell: expected 2 to 100 mm"));
  EXPECT_THAT(refused(tag + " " + ball), HasSubstr("expected drawings, or a single picture"));
  EXPECT_THAT(refused(tag + " --kerf -1"), HasSubstr("--kerf: expected a width from 0 to 10 mm"));
  EXPECT_THAT(refused(tag + " --lead 1"), HasSubstr("--lead: expected --kerf above 0"));
  EXPECT_THAT(refused(tag + " --passes 2 --step 1"), HasSubstr("--step: expected also --focus"));
  EXPECT_THAT(refused(tag + " --power 0"), HasSubstr("--power: expected more than 0 %"));
  EXPECT_THAT(refused(tag + " --score-color bleu"), HasSubstr("--score-color: expected a colour"));
  EXPECT_THAT(refused(tag + " -p x.svg"), HasSubstr("--picture: expected a name that ends with .png"));
  EXPECT_THAT(refused(ball + " --least-power 90"), HasSubstr("--least-power: expected at most --power"));
  EXPECT_THAT(refused(ball + " --width 1000 --line-distance 0.01"), HasSubstr("[laser.too-fine]"));
  EXPECT_THAT(refused(ball + " --sheet 50,50"), HasSubstr("[profile.off-sheet]"));
  EXPECT_THAT(refused(ball + " --feed 100000 --acceleration 1"), HasSubstr("overscan: expected 0 to 1000 mm"));
  EXPECT_THAT(refused(ball + " --mode threshold --threshold 0"), HasSubstr("there is nothing to burn"));
  EXPECT_THAT(refused(write("e.svg", "<svg width='4mm' height='4mm'/>")), HasSubstr("there is nothing to burn"));
  EXPECT_THAT(refused(write("e.png", "\x89PNG\r\n\x1a\nno")), HasSubstr("[picture.broken]"));
}

}  // namespace
