// passo cam drill, as a user starts it: from a layout program's files to a program that runs.
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

class CamDrill : public passo::test::CommandLine {
 protected:
  // Pads of two circuits and a connector, drawn in mm; the layout program's DXF names no unit.
  std::string pads() const {
    std::string text = "0\nSECTION\n2\nENTITIES\n";
    for (int row = 0; row < 2; ++row) {
      for (int i = 0; i < 8; ++i) {
        text += "0\nCIRCLE\n8\nPads\n10\n" + std::to_string(5.08 + i * 2.54) + "\n20\n" +
                std::to_string(10.16 + row * 7.62) + "\n40\n0.4\n";
      }
    }
    return write("pads.dxf", text + "0\nENDSEC\n0\nEOF\n");
  }
  std::string drill_file() const {
    return write("board.drl",
                 "M48\nMETRIC,TZ\nT1C0.800\nT2C3.200\n%\nG90\nG05\nT1\nX10.0Y10.0\nX40.0Y30.0\nX10.0Y30.0\nX40.0Y10.0\n"
                 "X20.0Y20.0G85X24.0Y20.0\nT2\nX5.0Y5.0\nM30\n");
  }
  Outcome drill(const std::string& arguments) const { return passo("cam drill " + arguments); }
  static std::string machine(const std::string& name) {
    return std::string(PASSO_SOURCE_DIR) + "/examples/machines/" + name;
  }
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// The classic chain: drawn in mm, scaled by 0.1, made in cm.
TEST_F(CamDrill, the_classic_chain_makes_a_program_in_centimetres) {
  const Outcome made = drill(pads() + " --scale 0.1 --units cm --drill 0.075 --clearance 0.2 --depth -0.3 -o " +
                             path("fori.gc") + " -p " + path("fori.svg"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, HasSubstr("tool 1: drill 0.075 cm, 16 holes, 0 slots; rapids "));
  const std::string program = read(path("fori.gc"));
  EXPECT_THAT(program, HasSubstr("centimetres"));
  EXPECT_THAT(program, HasSubstr("G0 Z0.2\n"));
  EXPECT_THAT(program, HasSubstr("Z-0.3 R0.05\n"));
  EXPECT_THAT(program, HasSubstr("X0.762 Y1.016\n"));
  EXPECT_THAT(program, Not(HasSubstr("M6")));
  EXPECT_GT(std::filesystem::file_size(path("fori.svg")), 1000U);
  const Outcome checked = passo("check " + path("fori.gc") + " -m " + machine("forty-eight.toml"));
  EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(CamDrill, the_classic_chain_in_millimetres_runs_on_the_virtual_machine) {
  const Outcome made = drill(pads() + " --drill 0.075cm --clearance 0.2cm --depth -0.3cm -o " + path("fori.gc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("mm is assumed"));
  for (const char* name : {"forty-eight.toml", "pantograph.toml"}) {
    const Outcome checked = passo("check " + path("fori.gc") + " -m " + machine(name));
    EXPECT_EQ(checked.code, 0) << checked.err;
    const Outcome run = passo("run --yes --json " + path("fori.gc") + " -m " + machine(name));
    EXPECT_EQ(run.code, 0) << run.err;
  }
  const Outcome canon = passo("canon --machine-units mm " + path("fori.gc"));
  EXPECT_EQ(canon.code, 0) << canon.err;
  EXPECT_EQ(count_of(canon.out, ", -3.0000, "), 16U) << "each hole is fed to its depth once\n" << canon.out;
}

TEST_F(CamDrill, tools_change_slots_and_wide_holes_are_milled_and_all_of_it_runs) {
  const Outcome made =
      drill(drill_file() + " --mill 0.8 --spindle 8000 --peck 0.7 -o " + path("b.ngc") + " -p " + path("b.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("5 holes, 1 slot, 0 other paths"));
  EXPECT_THAT(made.out, HasSubstr("tool 2: mill 0.8 mm, 1 hole, 1 slot"));
  const std::string program = read(path("b.ngc"));
  EXPECT_THAT(program, HasSubstr("(MSG, tool 2: mill 0.8 mm)\nT2 M6\n"));
  EXPECT_THAT(program, HasSubstr("G3 X6.2 Y5 Z-0.5 I-1.2 J0\n"));
  for (const std::string plain : {"", " --plain"}) {
    for (const std::string units : {"mm", "inch"}) {
      EXPECT_EQ(
          drill(drill_file() + " --mill 0.8mm --spindle 8000 --units " + units + plain + " -o " + path("b.ngc")).code,
          0);
      const Outcome run = passo("run --yes --quiet " + path("b.ngc") + " -m " + machine("router.toml"));
      EXPECT_EQ(run.code, 0) << run.err;
    }
  }
}

TEST_F(CamDrill, the_lower_left_hole_becomes_zero) {
  const Outcome made = drill(drill_file() + " --drill 1 --zero lower-left --plain");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("G0 X0 Y0\nG0 Z0.5\nG1 Z-2\n"));
  EXPECT_THAT(made.out, HasSubstr("G0 X35 Y25\n"));
}

TEST_F(CamDrill, the_same_files_make_the_same_bytes) {
  EXPECT_EQ(drill(drill_file()).out, drill(drill_file()).out);
}

TEST_F(CamDrill, what_is_wrong_is_told_and_nothing_is_written) {
  const Outcome rack = drill(drill_file() + " --tools 0.8 -o " + path("b.ngc"));
  EXPECT_EQ(rack.code, 2);
  EXPECT_THAT(rack.err, HasSubstr("board.drl:15:1: error: no tool can make 1 hole or slot of 3.2 mm"));
  const Outcome file = drill(write("broken.drl", "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Yq\n") + " -o " + path("b.ngc"));
  EXPECT_EQ(file.code, 2);
  EXPECT_THAT(file.err, HasSubstr("broken.drl:6:5: error: 'Y' has no number [excellon.unknown-command]"));
  EXPECT_EQ(drill(write("text.txt", "hello\n")).code, 2);
  EXPECT_EQ(drill(path("none.drl")).code, 2);
  EXPECT_EQ(drill(drill_file() + " --depth 2").code, 2);
  EXPECT_EQ(drill(drill_file() + " --clearance 0.2m").code, 2);
  EXPECT_EQ(drill(drill_file() + " --depth +-5").code, 2) << "not -5";
  EXPECT_EQ(drill(drill_file() + " --drill 1 --tools 1").code, 2);
  EXPECT_EQ(drill(drill_file() + " -o " + drill_file()).code, 2) << "the file itself would be overwritten";
  EXPECT_FALSE(std::filesystem::exists(path("b.ngc")));
}

TEST_F(CamDrill, layers_of_a_job_are_told_and_drawn) {
  const std::string boards = std::string(PASSO_SOURCE_DIR) + "/examples/boards";
  const Outcome shown = passo("cam show " + boards + " -p " + path("board.svg"));
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("bottom copper     attribute"));
  EXPECT_THAT(shown.out, HasSubstr("25 holes, 2 slots"));
  EXPECT_THAT(shown.out, HasSubstr("board: 55.88 x 45.72 mm"));
  EXPECT_THAT(read(path("board.svg")), HasSubstr("<svg"));
  const Outcome json = passo("cam show --json " + boards);
  EXPECT_THAT(json.out, HasSubstr("\"layer\": \"bottom mask\""));
  const Outcome wrong = passo("cam show " + write("x.gbr", "%FSLAX33Y33*%\n%MOMM*%\nD10*\nX0Y0D03*\nM02*\n"));
  EXPECT_NE(wrong.code, 0);
  EXPECT_THAT(wrong.err, HasSubstr("x.gbr:4:1: error"));
  EXPECT_THAT(wrong.err, HasSubstr("[gerber.no-aperture]"));
}

TEST_F(CamDrill, shapes_of_a_drawing_are_told_as_operations_select_them) {
  const std::string drawing =
      write("two.svg",
            "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' "
            "width='40mm' height='20mm' viewBox='0 0 40 20'><g inkscape:groupmode='layer' inkscape:label='cut'>"
            "<rect id='r' x='10' y='5' width='20' height='10' stroke='red'/><circle cx='4' cy='4' r='2'/></g></svg>");
  const Outcome shown = passo("cam show --shapes " + drawing);
  EXPECT_EQ(shown.code, 0) << shown.err;
  const nlohmann::json told = nlohmann::json::parse(shown.out);
  EXPECT_EQ(told["layers"], nlohmann::json({"cut"}));
  EXPECT_EQ(told["box"], nlohmann::json({2, 5, 30, 18}));
  ASSERT_EQ(told["shapes"].size(), 2U);
  EXPECT_EQ(told["shapes"][0]["color"], "#ff0000");
  EXPECT_EQ(told["shapes"][0]["names"], nlohmann::json({"cut", "r"}));
  EXPECT_EQ(told["shapes"][0]["d"], "M30 15L30 5L10 5L10 15Z");
  EXPECT_EQ(told["shapes"][1]["layer"], "cut");
  EXPECT_NE(passo("cam show --shapes " + drawing + " " + drawing).code, 0);
  EXPECT_NE(passo("cam show --shapes " + write("x.svg", "<svg")).code, 0);
}

TEST_F(CamDrill, shapes_of_a_dxf_drawing_have_their_colours_and_names) {
  const std::string drawing = write(
      "two.dxf",
      "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nHOLES\n70\n0\n62\n3\n0\nENDTAB\n0\nENDSEC\n"
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nPAD\n10\n0\n20\n0\n0\nCIRCLE\n5\n1F\n8\n0\n62\n0\n10\n0\n20\n0\n40\n1\n"
      "0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n5\n2A\n8\nHOLES\n10\n5\n20\n5\n40\n2\n"
      "0\nINSERT\n5\n2B\n2\nPAD\n8\nHOLES\n62\n30\n10\n20\n20\n5\n0\nENDSEC\n0\nEOF\n");
  const Outcome shown = passo("cam show --shapes " + drawing);
  EXPECT_EQ(shown.code, 0) << shown.err;
  const nlohmann::json told = nlohmann::json::parse(shown.out);
  EXPECT_EQ(told["layers"], nlohmann::json({"HOLES"}));
  ASSERT_EQ(told["shapes"].size(), 2U) << shown.out;
  EXPECT_EQ(told["shapes"][0]["color"], "#00ff00") << "that of the layer";
  EXPECT_EQ(told["shapes"][0]["names"], nlohmann::json({"2A"}));
  EXPECT_EQ(told["shapes"][1]["layer"], "HOLES");
  EXPECT_EQ(told["shapes"][1]["color"], "30") << "that of the INSERT";
  EXPECT_EQ(told["shapes"][1]["names"], nlohmann::json({"1F", "2B", "PAD"}));
  // What is told selects the shape.
  for (const char* const by : {"--color 30", "--name 1F", "--name 2B", "--name PAD"}) {
    const Outcome drilled = drill(drawing + " --drill 2 " + by);
    EXPECT_EQ(drilled.code, 0) << by << drilled.err;
    EXPECT_THAT(drilled.out, HasSubstr("X20 Y5")) << by;
    EXPECT_THAT(drilled.out, testing::Not(HasSubstr("X5 Y5"))) << by;
  }
}

// The operations of the API, which a test holds to their description.
TEST_F(CamDrill, is_a_command_as_all_operations_are) {
  const nlohmann::json document = nlohmann::json::parse(read(PASSO_SOURCE_DIR "/docs/api/openapi.json"));
  const auto& body = document["paths"]["/cam"]["post"]["requestBody"]["content"]["application/json"]["schema"];
  EXPECT_GE(body["properties"]["job"]["enum"].size(), 9U);
  for (const auto& job : body["properties"]["job"]["enum"]) {
    const auto name = job.get<std::string>();
    const Outcome help = passo("cam " + name + " --help");
    EXPECT_EQ(help.code, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("passo cam " + name + " ")) << "examples";
  }
}

}  // namespace
