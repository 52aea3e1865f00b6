// passo cam isolate, outline and board, as a user starts them: from Gerber files to programs that run.
#include "kit/command_line.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

class CamMill : public passo::test::CommandLine {
 protected:
  static constexpr const char* begin = "%FSLAX46Y46*%\n%MOMM*%\n%LPD*%\n";
  // Two pads 0.15 mm apart, a third one with a track.
  std::string copper(const std::string& name = "board-F_Cu.gbr", const std::string& side = "Copper,L1,Top") const {
    return write(name, "%TF.FileFunction," + side + "*%\n" + begin +
                           "%ADD10R,2.0X2.0*%\n%ADD11C,0.4*%\nD10*\nX5000000Y5000000D03*\nX7150000Y5000000D03*\n"
                           "X15000000Y5000000D03*\nD11*\nX15000000Y5000000D02*\nX15000000Y12000000D01*\nM02*\n");
  }
  // 20 x 15 mm with round corners of 2 mm on the right.
  std::string edge() const {
    return write(
        "board-Edge_Cuts.gbr",
        "%TF.FileFunction,Profile,NP*%\n" + std::string(begin) +
            "%ADD10C,0.1*%\nD10*\nG75*\nX0Y0D02*\nG01*\nX18000000Y0D01*\nG03*\nX20000000Y2000000I0J2000000D01*\n"
            "G01*\nX20000000Y13000000D01*\nG03*\nX18000000Y15000000I-2000000J0D01*\nG01*\nX0Y15000000D01*\n"
            "X0Y0D01*\nM02*\n");
  }
  std::string drills() const {
    return write("board-PTH.drl", "M48\nMETRIC,TZ\nT1C0.800\n%\nG90\nG05\nT1\nX5.0Y5.0\nX15.0Y5.0\nM30\n");
  }
  Outcome cam(const std::string& arguments) const { return passo("cam " + arguments); }
  Outcome check(const std::string& program) const {
    return passo("check " + program + " -m " + std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml");
  }
};

TEST_F(CamMill, an_isolated_layer_loses_no_copper_and_its_program_is_good) {
  const Outcome made = cam("isolate " + copper() + " --tool 0.12 -o " + path("f.ngc") + " -p " + path("f.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr(", 0 of "));
  EXPECT_THAT(made.out, HasSubstr("3 nets, all apart"));
  const std::string program = read(path("f.ngc"));
  EXPECT_THAT(program, HasSubstr("\nG2 "));
  EXPECT_THAT(program, testing::EndsWith("M2\n"));
  EXPECT_GT(std::filesystem::file_size(path("f.png")), 1000U);
  EXPECT_EQ(check(path("f.ngc")).code, 0);
}

// A negative layer draws what the board has not: an opening around a pad, and the ground beside the edge.
TEST_F(CamMill, a_negative_layer_covers_the_board_but_what_it_draws) {
  const std::string plane =
      write("plane.gbr", std::string(begin) +
                             "%TF.FilePolarity,Negative*%\n%ADD10C,4.0*%\n%ADD11C,2.0*%\nD10*\nX10000000Y7500000D03*\n"
                             "%LPC*%\nD11*\nX10000000Y7500000D03*\nM02*\n");
  const std::string isolate = "isolate " + plane + " --tool 0.5 -o " + path("plane.ngc");
  const Outcome alone = cam(isolate);
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.err, HasSubstr("--edge FILE"));
  EXPECT_THAT(alone.err, HasSubstr("[isolation.negative]"));
  const Outcome made = cam(isolate + " --edge " + edge());
  EXPECT_EQ(made.code, 0) << made.err;
  // 20 x 15 mm with two round corners, less a ring of 2 and 1 mm of radius.
  EXPECT_THAT(made.out, HasSubstr("0 of 288.9 mm\u00B2 of copper lost; 2 nets, all apart"));
}

TEST_F(CamMill, ways_midway_between_islands_end_at_the_edge) {
  const std::string options = "isolate " + copper() + " --edge " + edge() + " --tool 0.12 --voronoi";
  const Outcome made = cam(options + " -o " + path("v.ngc") + " -p " + path("v.svg"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr(", 0 of "));
  EXPECT_THAT(made.out, HasSubstr("3 nets, all apart"));
  EXPECT_EQ(check(path("v.ngc")).code, 0);
  EXPECT_THAT(cam(options + " --clear").err, HasSubstr("--clear and --voronoi cannot be combined"));
}

TEST_F(CamMill, nets_that_stay_joined_are_told_and_fail) {
  const std::string isolate = "isolate " + copper() + " --v 30,0.15 --depth -0.1 --allow-loss 0 -o " + path("f.ngc");
  const Outcome made = cam(isolate + " --json");
  EXPECT_EQ(made.code, 1);
  EXPECT_THAT(made.err, HasSubstr("two islands are still joined at X6.0750 Y"));
  EXPECT_THAT(made.err, HasSubstr("where they are 0.15 mm apart"));
  EXPECT_THAT(made.err, HasSubstr("2 nets are still joined"));
  EXPECT_THAT(made.out, HasSubstr("\"joined\": 2"));
  EXPECT_THAT(made.out, HasSubstr("\"lost_mm2\": 0.0"));
  EXPECT_EQ(check(path("f.ngc")).code, 0) << "it is written all the same";
  EXPECT_EQ(cam(isolate + " --accept-joined").code, 0);
  // What is advised was tried.
  EXPECT_THAT(made.err, HasSubstr("--allow-loss 0.03mm was tried: all nets are apart"));
  const Outcome parted = cam("isolate " + copper() + " --v 30,0.15 --depth -0.1 -o " + path("f.ngc"));
  EXPECT_EQ(parted.code, 0) << parted.err;
  EXPECT_THAT(parted.out, HasSubstr("3 nets, all apart"));
}

// What a person reads on standard error is what a script reads in the JSON.
TEST_F(CamMill, every_command_adds_its_notes_and_warnings_to_its_json) {
  const std::string copper_file = copper();
  const std::string edge_file = edge();
  // It gives neither its unit nor its number format.
  const std::string old = write("old.gbr", "%ADD10C,0.02*%\nD10*\nX0Y0D02*\nX5000D01*\nM02*\n");
  const std::string drawn =
      write("drawn.svg",
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20mm\" height=\"20mm\" "
            "viewBox=\"0 0 20 20\"><text x=\"3\" y=\"3\">A</text><path d=\"M2 2H8V8H2Z\"/></svg>");
  const std::string drill_file = write("old.drl", "M48\nT1C0.0315\n%\nT1\nX1000Y1000\nM30\n");
  const std::string to = " --json -o " + path("n.ngc");
  for (const std::string& command :
       {"isolate " + old + " --tool 0.2" + to,
        "isolate " + copper_file + " --v 30,0.15 --depth -0.1 --allow-loss 0" + to,
        "outline " + edge_file + " --tool 2 --tab-height 0.2" + to, "drill " + drill_file + to, "plot " + drawn + to,
        "wire " + drawn + to, "profile " + drawn + " --tool 1" + to, "show " + old + " --json",
        "board " + std::string(PASSO_SOURCE_DIR) + "/examples/boards --json -o " + path("job")}) {
    const Outcome made = cam(command);
    const auto json = nlohmann::json::parse(made.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << command << "\n" << made.out << made.err;
    std::size_t shown = 0;
    for (std::size_t at = made.err.find(": note: "); at != std::string::npos; at = made.err.find(": note: ", at + 1))
      ++shown;
    EXPECT_GT(shown, 0U) << command << "\n" << made.err;
    ASSERT_TRUE(json.contains("notes")) << command << "\n" << made.err;
    EXPECT_EQ(json["notes"].size(), shown) << command << "\n" << made.err;
    for (const auto& words : json["notes"]) EXPECT_THAT(made.err, HasSubstr(": note: " + words.get<std::string>()));
  }
}

TEST_F(CamMill, copper_outside_the_board_does_not_count) {
  const std::string beside =
      write("beside.gbr", std::string(begin) +
                              "%ADD10R,2.0X2.0*%\nD10*\nX5000000Y5000000D03*\nX5000000Y9000000D03*\n"
                              "X5000000Y-20000000D03*\nX7050000Y-20000000D03*\nM02*\n");
  const std::string isolate = "isolate " + beside + " --tool 0.2 -o " + path("b.ngc");
  EXPECT_EQ(cam(isolate).code, 1);
  const Outcome made = cam(isolate + " --edge " + edge());
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("2 islands of copper are outside the board and ignored"));
  EXPECT_THAT(made.out, HasSubstr("2 nets, all apart"));
}

TEST_F(CamMill, a_cleared_back_is_turned_over_about_two_holes) {
  const Outcome made =
      cam("isolate " + copper("b.gbr") + " --zero -5,-5 --edge " + edge() +
          " --tool 1,0.2 --clear --align -5,7,25,7 --conventional --spindle 10000 -o " + path("b.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  const std::string program = read(path("b.ngc"));
  EXPECT_THAT(program, HasSubstr("flipped from left to right, about X10 mm"));
  EXPECT_THAT(program, HasSubstr("T2 M6"));
  EXPECT_THAT(program, HasSubstr("M3 S10000"));
  EXPECT_EQ(check(path("b.ngc")).code, 0);
}

TEST_F(CamMill, an_outline_keeps_its_arcs_and_has_tabs) {
  const Outcome made = cam("outline " + edge() + " --zero -5,-5 --tool 2 --tabs 4 --ramp 5 -o " + path("o.ngc") +
                           " -p " + path("o.svg"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("1 outline and 0 openings"));
  EXPECT_THAT(made.out, HasSubstr("4 tabs; 0 mm² of it lost"));
  EXPECT_THAT(read(path("o.ngc")), HasSubstr("\nG2 "));
  EXPECT_EQ(check(path("o.ngc")).code, 0);
  EXPECT_THAT(cam("outline " + edge() + " -o " + path("o.ngc")).out, HasSubstr(", 4 tabs;"));
  EXPECT_THAT(cam("outline " + edge() + " --no-tabs -o " + path("o.ngc")).out, HasSubstr(", 0 tabs;"));
  EXPECT_EQ(cam("outline " + edge() + " --no-tabs --tab 1,1 -o " + path("o.ngc")).code, 2);
}

TEST_F(CamMill, wrong_options_are_told) {
  EXPECT_THAT(cam("isolate " + copper()).err, HasSubstr("expected a cutter, e.g. --tool 0.2"));
  EXPECT_THAT(cam("isolate " + copper() + " --v 200").err, HasSubstr("expected ANGLE,TIP"));
  EXPECT_THAT(cam("outline " + edge() + " --depth 2").err, HasSubstr("expected a length below 0"));
  EXPECT_THAT(cam("outline " + edge() + " --zero left").err, HasSubstr("expected file, lower-left or X,Y"));
  EXPECT_THAT(cam("isolate " + copper() + " --tool 0.2 --align 1,2,3,4").err, HasSubstr("the same Y or the same X"));
  EXPECT_EQ(cam("isolate nowhere.gbr --tool 0.2").code, 2);
}

TEST_F(CamMill, a_whole_board_gets_numbered_programs_and_a_page) {
  copper();
  copper("board-B_Cu.gbr", "Copper,L2,Bot");
  edge();
  drills();
  const std::string profile = write("profile.toml", "[isolate]\ntool = \"0.14\"\n[outline]\ntabs = 2\ndepth = -1.6\n");
  const Outcome made = cam("board " + path("") + " --profile " + profile + " -m " + std::string(PASSO_SOURCE_DIR) +
                           "/examples/machines/router.toml -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  for (const char* name : {"1-drill.ngc", "2-isolate-front.ngc", "3-isolate-back.ngc", "4-outline.ngc"}) {
    EXPECT_EQ(check(path("job/" + std::string(name))).code, 0) << name;
  }
  const std::string page = read(path("job/board.html"));
  EXPECT_THAT(page, HasSubstr("Flip it from left to right"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("<dt>Time</dt>"));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  // Both sides lie in the same place: the pads of the back are mirrored about the middle of the board.
  EXPECT_THAT(read(path("job/1-drill.ngc")), HasSubstr("X5 Y17.5"));
  EXPECT_THAT(read(path("job/3-isolate-back.ngc")), HasSubstr("about X10 mm"));
}

TEST_F(CamMill, programs_of_a_board_are_for_one_controller) {
  const std::string files = copper() + " " + edge() + " " + drills() + " ";
  const Outcome made = cam("board " + files + "--accept-joined --for grbl --change-height 8 -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  for (const char* name : {"1-drill.ngc", "2-isolate-front.ngc", "3-outline.ngc"}) {
    const std::string program = read(path("job/" + std::string(name)));
    EXPECT_THAT(program, Not(HasSubstr("G81"))) << name;
    EXPECT_THAT(program, Not(HasSubstr("M6"))) << name;
    EXPECT_THAT(program, HasSubstr("Z8\n")) << name;
  }
  const Outcome probing = cam("board " + files + "--heights 4x3 --for grbl -o " + path("none"));
  EXPECT_EQ(probing.code, 2);
  EXPECT_THAT(probing.err, HasSubstr("only passo and linuxcnc run"));
  EXPECT_FALSE(std::filesystem::exists(path("none")));
}

TEST_F(CamMill, all_programs_of_a_board_can_be_one_route_and_have_coolant) {
  const std::string drill = write("board-PTH.drl",
                                  "M48\nMETRIC,TZ\nT1C0.800\nT2C1.000\n%\nG90\nG05\nT1\nX5.0Y5.0\nX15.0Y5.0\nT2\n"
                                  "X16.0Y12.0\nX4.0Y12.0\nM30\n");
  const std::string files = "board " + copper() + " " + edge() + " " + drill + " --accept-joined ";
  const Outcome made = cam(files + "--park last -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  const auto parks = [&](const std::string& name) {
    const std::string program = read(path(name));
    return std::pair(program.find("G0 X0 Y0\n") != std::string::npos, program);
  };
  const auto [drill_parks, drilling] = parks("job/1-drill.ngc");
  EXPECT_FALSE(drill_parks);
  // The second drill begins at the hole beside the last one of the first drill.
  EXPECT_THAT(drilling, HasSubstr("X25 Y15\nG80"));
  EXPECT_THAT(drilling, HasSubstr("T2 M6\nG0 Z20\nM3 S12000\nG4 P2 (the spindle reaches its speed)\nG0 X26 Y22\n"));
  EXPECT_FALSE(parks("job/2-isolate-front.ngc").first);
  EXPECT_TRUE(parks("job/3-outline.ngc").first);
  EXPECT_EQ(check(path("job/1-drill.ngc")).code, 0);
  EXPECT_EQ(cam(files + "--park 0,50 -o " + path("far")).code, 0);
  EXPECT_THAT(read(path("far/2-isolate-front.ngc")), HasSubstr("G0 X0 Y50\nM2\n"));
  EXPECT_EQ(cam(files + "--coolant flood -o " + path("wet")).code, 0);
  for (const char* const name : {"wet/1-drill.ngc", "wet/2-isolate-front.ngc", "wet/3-outline.ngc"}) {
    EXPECT_THAT(read(path(name)), HasSubstr("\nM8\n")) << name;
  }
  const Outcome wrong = cam(files + "--park there -o " + path("none"));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--park: expected X,Y or last, found 'there'"));
}

TEST_F(CamMill, a_contour_of_the_edge_that_is_drawn_twice_is_reported) {
  const std::string square = "X0Y0D02*\nX20000000Y0D01*\nX20000000Y15000000D01*\nX0Y15000000D01*\nX0Y0D01*\n";
  const std::string twice =
      write("twice.gbr", std::string(begin) + "%ADD10C,0.1*%\nD10*\n" + square + square + "M02*\n");
  const Outcome made = cam("outline " + twice + " -o " + path("twice.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("1 closed contour that repeats another is ignored"));
  EXPECT_THAT(made.out, HasSubstr("1 outline and 0 openings"));
}

TEST_F(CamMill, an_edge_with_gaps_is_joined_where_that_is_asked_for) {
  const std::string open =
      write("open-Edge_Cuts.gbr", "%TF.FileFunction,Profile,NP*%\n" + std::string(begin) +
                                      "%ADD10C,0.1*%\nD10*\nX0Y0D02*\nX20000000Y0D01*\nX20000000Y15000000D01*\n"
                                      "X0Y15000000D01*\nX0Y300000D01*\nM02*\n");
  const std::string board = "board " + copper() + " " + open + " -o " + path("job");
  const Outcome refused = cam(board);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("it ends at X0 Y0 and at X0 Y0.3 mm"));
  EXPECT_THAT(refused.err, HasSubstr("--join 0.3mm closes it"));
  const Outcome made = cam(board + " --join 0.3mm");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(std::filesystem::exists(path("job/2-outline.ngc")));
  EXPECT_EQ(cam(board + " --join near").code, 2);
  const std::string isolate = "isolate " + copper() + " --tool 0.2 -o " + path("i.ngc") + " --edge " + open;
  EXPECT_EQ(cam(isolate).code, 2);
  EXPECT_EQ(cam(isolate + " --join 0.3mm").code, 0);
}

TEST_F(CamMill, what_a_file_is_can_be_said_and_the_steps_are_told_as_json) {
  copper();
  copper("odd.gbr", "Soldermask,Bot");
  edge();
  drills();
  const Outcome made =
      cam("board " + path("") + " --as odd.gbr='bottom copper' --as board-PTH.drl=nothing --json -o " + path("job"));
  ASSERT_EQ(made.code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_EQ(json["turn"], "x");
  EXPECT_EQ(json["holes"], "pins");
  std::string steps;
  for (const auto& step : json["steps"]) steps += step["step"].get<std::string>() + " ";
  EXPECT_EQ(steps, "blank drill front turn back edge ");
  EXPECT_EQ(json["steps"][2]["program"], "2-isolate-front.ngc");
  for (const auto& file : json["files"]) {
    EXPECT_EQ(file["told_by"] == "you", file["name"] == "odd.gbr" || file["name"] == "board-PTH.drl") << file;
    EXPECT_EQ(file["drill_file"], file["name"] == "board-PTH.drl") << file;
  }
  EXPECT_THAT(read(path("job/1-drill.ngc")), Not(HasSubstr("0.8")));
  EXPECT_THAT(read(path("job/board.html")), HasSubstr("bottom copper (given with --as)"));
  EXPECT_THAT(read(path("job/board.svg")), HasSubstr("<svg"));
  const std::string board = "board " + path("") + " -o " + path("job");
  EXPECT_THAT(cam(board + " --as odd.gbr").err, HasSubstr("expected FILE=LAYER"));
  EXPECT_THAT(cam(board + " --as odd.gbr=copper").err, HasSubstr("is not a layer: expected top copper"));
  EXPECT_THAT(cam(board + " --as odd.gbr=drill").err, HasSubstr("is not a drill file"));
  EXPECT_THAT(cam(board + " --as board-PTH.drl=outline").err, HasSubstr("is a drill file"));
  EXPECT_EQ(cam(board + " --as none.gbr=outline").code, 2);
  // What was read is told also where nothing can be made of it.
  const Outcome refused = cam("board " + path("odd.gbr") + " --json -o " + path("job"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(nlohmann::json::parse(refused.out)["files"][0]["layer"], "bottom mask");
}

// The probe's programs speak of the same places as those that mill.
TEST_F(CamMill, the_probe_finds_a_board_that_was_turned_over_and_its_heights) {
  copper();
  copper("board-B_Cu.gbr", "Copper,L2,Bot");
  edge();
  const Outcome made = cam("board " + path("") + " --probe-holes --heights 4x3 -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  for (const char* name : {"1-drill.ngc", "2-heights-front.ngc", "3-isolate-front.ngc", "4-find-holes.ngc",
                           "5-heights-back.ngc", "6-isolate-back.ngc", "7-outline.ngc"}) {
    EXPECT_EQ(check(path("job/" + std::string(name))).code, 0) << name;
  }
  EXPECT_THAT(read(path("job/1-drill.ngc")), HasSubstr("X5 Y17.5"));
  EXPECT_THAT(read(path("job/4-find-holes.ngc")), HasSubstr("X5.0000 Y17.5000 (the first bore"));
  EXPECT_THAT(read(path("job/4-find-holes.ngc")), HasSubstr("G0 X35.0000 Y17.5000"));
  EXPECT_THAT(read(path("job/5-heights-back.ngc")), HasSubstr("(LOG,30.0000,25.0000,#5063)"));
  EXPECT_THAT(read(path("job/board.html")),
              HasSubstr("passo level 6-isolate-back.ngc --map heights-back.csv -o 6-isolate-back-level.ngc"));
  EXPECT_EQ(cam("board " + path("board-F_Cu.gbr") + " --heights 4 -o " + path("job")).code, 2);
  EXPECT_EQ(cam("board " + path("board-F_Cu.gbr") + " --heights 1x900 -o " + path("job")).code, 2);
}

TEST_F(CamMill, a_job_takes_the_place_of_the_one_before_it_and_only_as_a_whole) {
  const std::string job = copper() + " " + edge() + " " + drills();
  const auto names = [&] {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path("job"))) found.push_back(entry.path().filename());
    return found;
  };
  EXPECT_EQ(cam("board " + job + " --heights 4 -o " + path("job")).code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("job")));
  EXPECT_EQ(cam("board " + job + " --heights 3x3 -o " + path("job")).code, 0);
  write("job/heights-front.csv", "0,0,0\n");
  const auto before = names();
  EXPECT_THAT(before, testing::Contains("4-outline.ngc"));
  EXPECT_EQ(cam("board " + job + " --heights 4 -o " + path("job")).code, 2);
  EXPECT_THAT(names(), testing::UnorderedElementsAreArray(before));
  EXPECT_EQ(cam("board " + job + " -o " + path("job")).code, 0);
  EXPECT_THAT(names(), testing::UnorderedElementsAre("1-drill.ngc", "1-drill.svg", "2-isolate-front.ngc",
                                                     "2-isolate-front.svg", "3-outline.ngc", "3-outline.svg",
                                                     "board.html", "board.svg", "heights-front.csv"));
}

TEST_F(CamMill, layers_of_two_boards_are_told) {
  const std::string twice = copper() + " " + copper("other-F_Cu.gbr");
  const Outcome both = cam("board " + twice + " -o " + path("job"));
  EXPECT_EQ(both.code, 0);
  EXPECT_THAT(both.err, HasSubstr("are both top copper"));
  const Outcome one = cam("board " + twice + " --as other-F_Cu.gbr=nothing -o " + path("job"));
  EXPECT_THAT(one.err, Not(HasSubstr("are both")));
  const std::string kicad = write("a.kicad_pcb",
                                  "(kicad_pcb (layers (0 \"F.Cu\" signal))\n(segment (start 1 1) (end 9 1) "
                                  "(width 0.5) (layer \"F.Cu\") (net 1)))\n");
  const Outcome mixed = cam("board " + kicad + " " + copper() + " -o " + path("mixed"));
  EXPECT_EQ(mixed.code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("[board.two-boards]"));
  EXPECT_FALSE(std::filesystem::exists(path("mixed")));
}

// With a KiCad of a few lines: the button makes the programs and opens their page, or shows why not.
TEST_F(CamMill, the_plugin_of_kicad_makes_the_programs_of_the_open_board) {
  if (std::system("python3 -c 1") != 0) GTEST_SKIP() << "no python3";
  write("my board.kicad_pcb",
        "(kicad_pcb (layers (0 \"F.Cu\" signal))\n(segment (start 1 1) (end 9 1) (width 0.5) (layer "
        "\"F.Cu\") (net 1)))\n");
  const std::string kicad = write("kicad.py", R"(
import runpy, sys, types, webbrowser
plugins = []
class ActionPlugin:
    def register(self):
        self.defaults()
        plugins.append(self)
board = types.SimpleNamespace(GetFileName=lambda: name)
sys.modules["pcbnew"] = types.SimpleNamespace(ActionPlugin=ActionPlugin, GetBoard=lambda: board)
sys.modules["wx"] = types.SimpleNamespace(OK=4, ICON_ERROR=512, MessageBox=lambda words, title, style: print("box:", words))
webbrowser.open = lambda address: print("opened:", address)
runpy.run_path(sys.argv[1], run_name="passo_board")
for name in sys.argv[2:]:
    plugins[0].Run()
)");
  const std::string command = "PASSO=" PASSO_PROGRAM " python3 " + kicad + " " + std::string(PASSO_SOURCE_DIR) +
                              "/examples/kicad/passo_board.py '" + path("my board.kicad_pcb") + "' '" +
                              path("none.kicad_pcb") + "' '' >" + path("said") + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string said = read(path("said"));
  EXPECT_THAT(said, HasSubstr("opened: file://"));
  EXPECT_THAT(said, HasSubstr("my%20board-passo/board.html\n"));
  EXPECT_THAT(said, HasSubstr("none.kicad_pcb: error: cannot be read"));
  EXPECT_THAT(said, HasSubstr("box: The board has no file yet"));
  EXPECT_TRUE(std::filesystem::exists(path("my board-passo/1-isolate-front.ngc")));
}

TEST_F(CamMill, a_board_without_an_edge_is_not_cut_out) {
  copper();
  write("board-Edge_Cuts.gbr", "%TF.FileFunction,Profile,NP*%\n" + std::string(begin) + "M02*\n");
  const Outcome made =
      cam("board " + path("board-F_Cu.gbr") + " " + path("board-Edge_Cuts.gbr") + " -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("no closed outline"));
  EXPECT_TRUE(std::filesystem::exists(path("job/1-isolate-front.ngc")));
}

TEST_F(CamMill, options_are_remembered_for_a_machine_until_others_are_given) {
  const std::string machine =
      write("mine.toml", read(std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml"));
  const std::string isolate = "isolate " + copper() + " -o " + path("f.ngc") + " -m " + machine;
  EXPECT_EQ(cam(isolate).code, 2) << "no cutter is known yet";
  EXPECT_EQ(cam(isolate + " --tool 0.12 --depth -0.07 --conventional --zero 1,2 --remember").code, 0);
  EXPECT_EQ(read(path("mine.cam.toml")),
            "# Written by passo cam --remember. The tables are commands, the keys their options.\n\n[isolate]\n"
            "tool = \"0.12\"\ndepth = \"-0.07\"\nconventional = true\n");
  const Outcome again = cam(isolate);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("mine.cam.toml: --tool=0.12 --depth=-0.07 --conventional"));
  EXPECT_THAT(read(path("f.ngc")), HasSubstr("G1 Z-0.07"));
  // What is given counts; another kind of cutter takes the place of the one that was remembered.
  EXPECT_EQ(cam(isolate + " --v 20,0.1 --remember").code, 0);
  EXPECT_THAT(read(path("f.ngc")), HasSubstr("(tool 1: V 20 degrees"));
  EXPECT_THAT(read(path("f.ngc")), Not(HasSubstr("(tool 2")));
  EXPECT_THAT(read(path("mine.cam.toml")), HasSubstr("v = \"20,0.1\""));
  EXPECT_THAT(read(path("mine.cam.toml")), Not(HasSubstr("tool =")));
  const Outcome board = cam("board " + path("board-F_Cu.gbr") + " -m " + machine + " -o " + path("job"));
  EXPECT_EQ(board.code, 0) << board.err;
  EXPECT_THAT(read(path("job/1-isolate-front.ngc")), HasSubstr("V 20 degrees"));
  EXPECT_EQ(cam("isolate " + path("board-F_Cu.gbr") + " --tool 1 --remember").code, 2);
  EXPECT_EQ(cam("isolate " + path("board-F_Cu.gbr") + " --tool 1 -m " + path("none.toml")).code, 3);
  write("mine.cam.toml", "[isolate]\nsteed = 1\n");
  EXPECT_THAT(cam(isolate).err, HasSubstr("mine.cam.toml:1: [isolate]:"));
}

TEST_F(CamMill, a_wrong_profile_is_told) {
  const std::string profile = write("profile.toml", "[isolate]\ntoool = 1\n");
  const Outcome made = cam("board " + copper() + " --profile " + profile + " -o " + path("job"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("[isolate]"));
}

TEST_F(CamMill, copies_in_a_grid_are_made_tool_by_tool_in_one_report) {
  const std::string board = "board " + copper() + " " + edge() + " " + drills() + " -o " + path("panel");
  const Outcome made = cam(board + " --copies 3x2 --gap 6");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("18 nets (3 in each of 6 copies), all apart"));
  EXPECT_THAT(made.out, HasSubstr("12 holes"));
  EXPECT_THAT(made.out, HasSubstr("6 outlines and 0 openings"));
  EXPECT_THAT(made.out, HasSubstr("24 tabs"));
  const std::string drilling = read(path("panel/1-drill.ngc"));
  // The first hole of the last copy: two boards and two gaps to the right, one up.
  EXPECT_THAT(drilling, HasSubstr(fmt::format("X{} Y{}", 10 + 5 + 2 * 26, 10 + 5 + 21)));
  EXPECT_THAT(drilling, Not(HasSubstr("T2 M6")));
  EXPECT_THAT(read(path("panel/board.html")), HasSubstr("6 boards of 20 x 15 mm in 3 columns and 2 rows, 6 mm apart"));
  for (const char* const program : {"1-drill.ngc", "2-isolate-front.ngc", "3-outline.ngc"})
    EXPECT_EQ(check(path("panel/") + program).code, 0);
  const Outcome narrow = cam(board + " --copies 3x2 --gap 4.9");
  EXPECT_EQ(narrow.code, 2);
  EXPECT_THAT(narrow.err, HasSubstr("--gap: expected at least 5 mm"));
  for (const char* const wrong : {"3", "0x2", "3x4x5", "101x1", "-1x2"}) {
    const Outcome refused = cam(board + " --copies=" + wrong);
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_THAT(refused.err, HasSubstr("--copies: expected COLUMNSxROWS"));
  }
}

TEST_F(CamMill, joined_nets_of_a_panel_are_told_by_copy) {
  const std::string named =
      write("named-F_Cu.gbr", "%TF.FileFunction,Copper,L1,Top*%\n" + std::string(begin) +
                                  "%ADD10R,2.0X2.0*%\nD10*\n%TO.N,GND*%\nX5000000Y5000000D03*\n%TO.N,VCC*%\n"
                                  "X7050000Y5000000D03*\nM02*\n");
  const Outcome made = cam("board " + named + " " + edge() + " --copies 2x1 -o " + path("panel"));
  EXPECT_EQ(made.code, 1);
  EXPECT_THAT(made.out, HasSubstr("4 nets (2 in each of 2 copies), 4 of them still joined in 2 pieces"));
  EXPECT_THAT(made.err, HasSubstr("GND of copy 2 and VCC of copy 2 are still joined"));
}

TEST_F(CamMill, the_flip_is_shown_with_its_holes_and_the_back_is_mirrored_about_their_middle) {
  const Outcome made = cam("board " + copper() + " " + copper("board-B_Cu.gbr", "Copper,L2,Bot") + " " + edge() + " " +
                           drills() + " --pins 4 --accept-joined --json -o " + path("two"));
  EXPECT_EQ(made.code, 0) << made.err;
  const nlohmann::json report = nlohmann::json::parse(made.out);
  const nlohmann::json& holes = report["registration"]["holes"];
  const double axis = report["registration"]["axis_mm"];
  EXPECT_NEAR(axis, 20, 1e-9);
  EXPECT_NEAR(holes[0]["x_mm"].get<double>(), 6, 1e-9);
  EXPECT_NEAR(holes[0]["x_mm"].get<double>() + holes[1]["x_mm"].get<double>(), 2 * axis, 1e-9);
  EXPECT_EQ(holes[0]["y_mm"], holes[1]["y_mm"]);
  const std::string drilling = read(path("two/1-drill.ngc"));
  EXPECT_THAT(drilling, HasSubstr("X6 Y17.5"));
  EXPECT_THAT(drilling, HasSubstr("X34 Y17.5"));
  EXPECT_THAT(read(path("two/3-flip.svg")), HasSubstr("After: the back is up"));
  EXPECT_THAT(read(path("two/board.html")), HasSubstr("after the flip, hole 1 is where hole 2 was"));
}

TEST_F(CamMill, a_mask_is_cleared_after_each_side_and_a_stencil_is_cut_last) {
  const std::string mask = write(
      "board-F_Mask.gbr", "%TF.FileFunction,Soldermask,Top*%\n%TF.FilePolarity,Negative*%\n" + std::string(begin) +
                              "%ADD10R,2.2X2.2*%\n%ADD11R,0.35X0.35*%\nD10*\n"
                              "X5000000Y5000000D03*\nX15000000Y5000000D03*\nD11*\n"
                              "X10000000Y10000000D03*\nM02*\n");
  const std::string paste = write("board-F_Paste.gbr", "%TF.FileFunction,Paste,Top*%\n" + std::string(begin) +
                                                           "%ADD10R,1.8X1.8*%\nD10*\nX5000000Y5000000D03*\nM02*\n");
  const std::string files = copper() + " " + edge() + " ";
  const Outcome made =
      cam("board " + files + mask + " " + paste + " --mask 0.4 --stencil 0.3 --accept-joined -o " + path("job"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("3 openings of 9.803 mm² in the solder mask cleared"));
  EXPECT_THAT(made.out, HasSubstr("1 of 1 opening in the film, 3.24 mm²"));
  EXPECT_THAT(made.err, HasSubstr("an opening is narrower than the cutter and stays closed; --mask 0.3mm was tried"));
  const std::string clearing = read(path("job/2-mask-front.ngc"));
  EXPECT_THAT(clearing, HasSubstr("Z-0.05"));
  EXPECT_THAT(read(path("job/4-stencil-front.ngc")), HasSubstr("Z-0.15"));
  EXPECT_EQ(check(path("job/2-mask-front.ngc")).code, 0);
  EXPECT_EQ(check(path("job/4-stencil-front.ngc")).code, 0);
  const Outcome without = cam("board " + files + " --mask 0.4 -o " + path("none"));
  EXPECT_EQ(without.code, 2);
  EXPECT_THAT(without.err, HasSubstr("--mask: expected a solder mask layer"));
}

}  // namespace
