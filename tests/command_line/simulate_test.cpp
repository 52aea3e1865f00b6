// passo simulate, as a user starts it: what it says, what it writes, and how it ends.
#include <cmath>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

class Simulate : public passo::test::CommandLine {
 protected:
  // Two slots, 6 mm wide and 2 mm deep, 40 mm from end to end of the tip's way.
  std::string slots(const std::string& between = "G0 Z5\n") const {
    return write("slots.ngc",
                 "G21 G90 G0 Z5\nT1 M6\nG0 X10 Y10\nG1 Z-2 F600\nX50\n" + between + "G0 Y30\nG1 Z-2\nX10\nG0 Z5\nM2\n");
  }
  Outcome simulate(const std::string& arguments) const { return passo("simulate " + arguments); }
  nlohmann::json json_of(const std::string& arguments) const {
    return nlohmann::json::parse(simulate(arguments + " --json").out);
  }
};

TEST_F(Simulate, tells_what_a_program_takes_off) {
  const Outcome done = simulate(slots() + " --tool flat:6 --stock X0:60,Y0:40,Z-10:0 --cell 0.1");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(done.out, HasSubstr("X 0 to 60, Y 0 to 40, Z -10 to 0; 600 x 400 cells of 0.1 mm"));
  EXPECT_THAT(done.out, HasSubstr("T1 flat end, 6 mm"));
  EXPECT_THAT(done.out, HasSubstr("depth of cut    2.000 mm at most"));
  const nlohmann::json json = json_of(slots() + " --tool flat:6 --stock X0:60,Y0:40,Z-10:0");
  const double slot = 2 * (40 * 6 + 3.14159265 * 9);
  EXPECT_NEAR(json["removed_mm3"], 2 * slot, 5);
  EXPECT_NEAR(json["removed_mm3"].get<double>() + json["left_mm3"].get<double>(), 60 * 40 * 10, 1);
  EXPECT_NEAR(json["largest_engagement"]["of_diameter"], 1, 0.02);
  EXPECT_TRUE(json["good"]);
}

TEST_F(Simulate, without_a_stock_it_is_as_large_as_the_feeds_need) {
  const nlohmann::json json = json_of(slots() + " --tool flat:6");
  EXPECT_NEAR(json["stock"]["low"]["x"], 7, 1e-9);
  EXPECT_NEAR(json["stock"]["high"]["y"], 33, 1e-9);
  EXPECT_NEAR(json["stock"]["low"]["z"], -4, 1e-9);
  EXPECT_NEAR(json["stock"]["high"]["z"], 0, 1e-9);
}

TEST_F(Simulate, a_rapid_through_the_stock_is_told_with_its_line_and_fails) {
  const Outcome done = simulate(slots("") + " --tool flat:6");
  EXPECT_EQ(done.code, 1);
  EXPECT_THAT(done.err, HasSubstr("slots.ngc:6"));
  EXPECT_THAT(done.err, HasSubstr("the rapid of T1 goes through the stock, 2.000 mm deep"));
  EXPECT_THAT(done.err, HasSubstr("[simulate.rapid]"));
}

TEST_F(Simulate, holder_flutes_clamps_and_table_are_told) {
  const std::string tools = write("tools.toml",
                                  "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\nflute_length_mm = 1.5\n"
                                  "holder_diameter_mm = 20\nholder_from_mm = 1.8\n");
  const Outcome done = simulate(slots() + " --tool-table " + tools +
                                " --clamp X55:70,Y25:35,Z10 --clamp X50:60,Y5:15,Z8 --stock Z-1.9:0");
  EXPECT_EQ(done.code, 1);
  for (const char* code : {"simulate.holder", "simulate.flutes", "simulate.clamp", "simulate.below"}) {
    EXPECT_THAT(done.err, HasSubstr(code));
  }
}

TEST_F(Simulate, a_tool_without_a_shape_is_refused_with_a_hint) {
  const Outcome done = simulate(slots());
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.err, HasSubstr("no shape given for tool T1 [simulate.no-tool]"));
  EXPECT_THAT(done.err, HasSubstr("--tool 1=flat:6"));
}

TEST_F(Simulate, takes_every_shape_of_tool) {
  // A plunge to a depth of 2 mm, and the volume of the hole.
  const std::string plunge = write("plunge.ngc", "G21 G90 G0 Z5\nG0 X10 Y10\nG1 Z-2 F600\nG0 Z5\nM2\n");
  const auto volume = [&](const std::string& tool) {
    return json_of(plunge + " --stock X0:20,Y0:20,Z-5:0 --cell 0.05 --tool " + tool)["removed_mm3"].get<double>();
  };
  constexpr double pi = 3.14159265;
  EXPECT_NEAR(volume("flat:6"), 18 * pi, 0.1);
  EXPECT_NEAR(volume("ball:6"), pi * 4 * (3 - 2 / 3.0), 0.1);
  EXPECT_NEAR(volume("vee:90:6"), pi * 8 / 3, 0.1);
  EXPECT_NEAR(volume("vee:90:6:2"), pi * 2 / 3 * (9 + 3 + 1), 0.1);
  // A cone of 45 degrees a side whose apex lies sqrt(2) - 1 below the tip of the ball, without what is below the ball.
  const double depth = 2 + std::sqrt(2.0) - 1;
  const double tangent = std::sqrt(0.5);
  const double cap = 1 - tangent;
  const double without = pi * tangent * tangent * tangent / 3 - pi * cap * cap * (1 - cap / 3);
  EXPECT_NEAR(volume("taper:2:45:6"), pi * depth * depth * depth / 3 - without, 0.1);
  EXPECT_LT(volume("bull:6:1"), volume("flat:6"));
  EXPECT_GT(volume("bull:6:1"), volume("ball:6"));
}

TEST_F(Simulate, wrong_words_are_refused) {
  for (const char* arguments :
       {"--tool round:6", "--tool flat", "--tool flat:-3", "--tool vee:60", "--tool bull:6:4", "--tool x=flat:3",
        "--tool flat:6 --stock X0:10,Q3:4", "--tool flat:6 --stock X5:2", "--tool flat:6 --clamp X0:5",
        "--tool flat:6 --cell 0", "--tool flat:6 --stock X0:9000,Y0:9000,Z-1:0 --cell 0.1", "--tool flat:6 -p part.bmp",
        "--tool flat:6 --compare part.png"}) {
    const Outcome done = simulate(slots() + " " + arguments);
    EXPECT_EQ(done.code, 2) << arguments << "\n" << done.err;
    EXPECT_NE(done.err, "") << arguments;
  }
}

TEST_F(Simulate, writes_pictures_and_a_body) {
  const Outcome done = simulate(slots() + " --tool ball:6 --cell 0.5 -p " + path("a.png") + " -p " + path("a.svg") +
                                " --stl " + path("a.stl"));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(read(path("a.png")), testing::StartsWith("\x89PNG"));
  EXPECT_THAT(read(path("a.svg")), HasSubstr("<svg"));
  EXPECT_GT(std::filesystem::file_size(path("a.stl")), 10'000U);
}

TEST_F(Simulate, compares_with_a_body_and_with_another_program) {
  const std::string block = " --stock X0:60,Y0:40,Z-10:0 --cell 0.2 --tool flat:6 ";
  EXPECT_EQ(simulate(slots() + block + "--stl " + path("part.stl")).code, 0);
  const nlohmann::json same = json_of(slots() + block + "--compare " + path("part.stl"));
  EXPECT_EQ(same["gouges"]["cells"], 0);
  EXPECT_EQ(same["material_left"]["cells"], 0);
  const std::string half = write("half.ngc", "G21 G90 G0 Z5\nT1 M6\nG0 X10 Y10\nG1 Z-2.5 F600\nX50\nG0 Z5\nM2\n");
  const nlohmann::json other = json_of(half + block + "--compare " + slots());
  EXPECT_NEAR(other["gouges"]["largest_mm"], 0.5, 1e-4);
  EXPECT_NEAR(other["material_left"]["largest_mm"], 2, 1e-4);
  EXPECT_NEAR(other["material_left"]["place"]["y"], 30, 3);
  const Outcome told = simulate(half + block + "--compare " + slots());
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.err, HasSubstr("[simulate.gouge]"));
}

TEST_F(Simulate, tool_lengths_and_work_systems_are_followed_as_on_the_machine) {
  const std::string table = write("tool.tbl", "T1 P1 Z30 D6\nT2 P2 Z12.5 D6\n");
  const std::string program =
      write("two.ngc",
            "G21 G90\nT1 M6 G43\nG0 X10 Y10 Z5\nG1 Z-2 F600\nX20\nG0 Z5\nT2 M6 G43\nG0 Z5\nG10 L2 P2 X30 Y0 Z0\nG55\n"
            "G0 X10 Y10\nG1 Z-2\nX20\nG0 Z5\nM2\n");
  const nlohmann::json json = json_of(program + " --tools " + table + " --stock X0:60,Y0:20,Z-10:0");
  EXPECT_TRUE(json["good"]) << json;
  EXPECT_NEAR(json["removed_mm3"], 2 * 2 * (10 * 6 + 3.14159265 * 9), 3);
  EXPECT_NEAR(json["largest_depth"]["mm"], 2, 1e-4);
}

TEST_F(Simulate, follows_the_path_that_a_machine_drives) {
  const std::string machine = std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml";
  const std::string corner =
      write("corner.ngc", "G21 G90 G64 P0.5\nG0 Z5\nG0 X10 Y10\nG1 Z-2 F600\nX50\nY40\nG0 Z5\nM2\n");
  const std::string block = " --stock X0:60,Y0:60,Z-10:0 --cell 0.1 --tool flat:2";
  const Outcome sharp = simulate(corner + block + " --stl " + path("sharp.stl"));
  const Outcome round = simulate(corner + block + " -m " + machine + " --stl " + path("round.stl"));
  EXPECT_EQ(sharp.code, 0) << sharp.err;
  EXPECT_EQ(round.code, 0) << round.err;
  EXPECT_NE(read(path("sharp.stl")), read(path("round.stl")));
}

TEST_F(Simulate, gives_the_same_bytes_for_any_number_of_threads) {
  const std::string pocket = std::string(PASSO_SOURCE_DIR) + "/examples/pocket.ngc --tool flat:6 --cell 0.2 --stl ";
  EXPECT_EQ(simulate(pocket + path("1.stl") + " --threads 1").code, 0);
  EXPECT_EQ(simulate(pocket + path("3.stl") + " --threads 3").code, 0);
  EXPECT_EQ(read(path("1.stl")), read(path("3.stl")));
}

// A pyramid: around a square of 10 mm on the left, of 16 mm on the right.
TEST_F(Simulate, a_hot_wire_leaves_what_lies_between_two_profiles) {
  const std::string program =
      write("w.ngc", "G21 G90\nG0 X-5 Y5 U-5 V2\nG1 X5 U2 F100\nX15 U18\nY15 V18\nX5 U2\nY5 V2\nX-5 U-5\nM2\n");
  const std::string wire = program + " --wire 1 --span 100 --stock X0:20,Y0:20,Z0:100 --cell 0.2 ";
  const Outcome done = simulate(wire + "--stl " + path("w.stl") + " --picture " + path("w.png"));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(done.out, HasSubstr("X Y at Z 0, U V at Z 100"));
  EXPECT_THAT(done.out, HasSubstr("(cut free)"));
  EXPECT_GT(std::filesystem::file_size(path("w.png")), 10'000U);
  EXPECT_GT(std::filesystem::file_size(path("w.stl")), 10'000U);
  const nlohmann::json json = json_of(wire + "--compare " + path("w.stl"));
  ASSERT_EQ(json["pieces"].size(), 2U);
  EXPECT_NEAR(json["pieces"][1]["mm3"], (81 + 9 * 15 + 225) * 100 / 3.0, 150);
  EXPECT_TRUE(json["pieces"][1]["cut_free"]);
  EXPECT_EQ(json["gouges"]["cells"], 0);

  EXPECT_THAT(simulate(program + " --wire 1").err, HasSubstr("needs --span"));
  EXPECT_THAT(simulate(wire + "--compare " + program).err, HasSubstr("[surface.unknown-kind]"));
  EXPECT_EQ(simulate(wire + "--tool flat:6").code, 2);
  EXPECT_EQ(simulate(program + " --wire x").code, 2);
  const std::string rapid = write("r.ngc", "G21 G90\nG0 X-5 Y5\nG1 X5 F100\nG0 Y15\nG1 X-5\nM2\n");
  const Outcome told = simulate(rapid + " --wire 1 --stock X0:20,Y0:20");
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.err, HasSubstr("r.ngc:4"));
  EXPECT_THAT(told.err, HasSubstr("[simulate.rapid]"));
}

}  // namespace
