// passo explain and --dialect, as a user starts them.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

using Explain = passo::test::CommandLine;

constexpr const char* program =
    "G10 L2 P1 X25\nG1 X10 F600\no1 repeat [3]\nG91 G1 X1\no1 endrepeat\nG1 H2\nM2\nG0 X1\n";

TEST_F(Explain, says_what_a_line_does_where_it_is_and_under_which_modes) {
  const std::string file = write("p.ngc", program);
  const Outcome line = passo("explain " + file + ":2");
  EXPECT_EQ(line.code, 0) << line.err;
  EXPECT_THAT(line.out, HasSubstr(file + ":2: G1 X10 F600\n"));
  EXPECT_THAT(line.out, HasSubstr("  X10   to X 10 mm (work), 35 mm (machine)\n"));
  EXPECT_THAT(line.out, HasSubstr("    STRAIGHT_FEED(10.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"));
  EXPECT_THAT(line.out, HasSubstr("work     X -25 mm, Y 0 mm, Z 0 mm  ->  X 10 mm, Y 0 mm, Z 0 mm\n"));
  EXPECT_THAT(line.out, HasSubstr("    motion              G1    feed move  (set here)\n"));
  EXPECT_THAT(line.out, HasSubstr("    units               G21   millimetres\n"));
  EXPECT_THAT(line.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(passo("explain " + file + ":4").out, HasSubstr("executed 3 times; this is the first\n"));
  EXPECT_THAT(passo("explain " + file + ":8").out, HasSubstr("never executed\n"));
}

TEST_F(Explain, the_machine_file_says_what_the_feed_counts_on_a_cylinder) {
  constexpr const char* machine = R"(name = "Cylinder"
path_tolerance_deg = 0.1
[board]
clock_hz = 16_000_000
max_event_rate_hz = 200_000
[axis.X]
steps_per_mm = 100
travel_mm = [-50, 50]
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
[axis.A]
steps_per_deg = 100
travel_deg = [-360, 360]
max_velocity_deg_s = 180
max_acceleration_deg_s2 = 3000
)";
  const std::string file = write("a.ngc", "G64 G93 F2 G1 A0\nG94 F600 G1 A90\nX10 Z20 A180\nG93 F2 G1 A90\nM2\n");
  EXPECT_THAT(passo("explain " + file + ":2").out, HasSubstr("feed     90.000 degrees, 9.000 s at"));
  const std::string fixed = " -m " + write("r.toml", std::string(machine) + "radius_mm = 20\n");
  // A quarter of a turn at a radius of 20 mm is 31.416 mm.
  const Outcome turn = passo("explain " + file + ":2" + fixed);
  EXPECT_THAT(turn.out, HasSubstr("feed     31.416 mm on the surface at a radius of 20 mm (A), 3.142 s at"));
  EXPECT_THAT(turn.out, HasSubstr("blended path, A B C within 0.1 degrees"));
  EXPECT_THAT(passo("explain " + file + ":4" + fixed).out, HasSubstr("radius of 20 mm (A), 30.000 s at"));
  // With X and Z: the root of 10² + 20² + 15.708² at the mean radius of 10 mm.
  const std::string by_tool = " -m " + write("t.toml", std::string(machine) + "radius_mm = \"tool\"\n");
  EXPECT_THAT(passo("explain " + file + ":3" + by_tool).out,
              HasSubstr("feed     27.327 mm on the surface at a radius of 10 mm (A), 2.733 s at"));
  const nlohmann::json json = nlohmann::json::parse(passo("explain " + file + ":2 --json" + fixed).out);
  EXPECT_EQ(json["lines"][0]["moves"]["feed_unit"], "mm");
  EXPECT_EQ(json["lines"][0]["moves"]["surface_radius_mm"]["A"], 20);
  EXPECT_EQ(passo("explain " + file + ":2 -m " + write("bad.toml", "name = 1\n")).code, 3);
}

TEST_F(Explain, a_wrong_line_is_shown_with_its_diagnostic) {
  const Outcome line = passo("explain " + write("p.ngc", program) + ":6");
  EXPECT_EQ(line.code, 2);
  EXPECT_THAT(line.out, HasSubstr(":6:4: error: no code of this block uses the word H [gcode.unused-word]"));
  EXPECT_EQ(passo("explain " + path("p.ngc") + ":2").code, 0);
}

TEST_F(Explain, json_says_the_same) {
  const Outcome lines = passo("explain " + write("p.ngc", program) + ":2-4 --json");
  EXPECT_EQ(lines.code, 0) << lines.err;
  const auto json = nlohmann::json::parse(lines.out);
  ASSERT_EQ(json["lines"].size(), 3U);
  EXPECT_EQ(json["whole_run"], true);
  EXPECT_EQ(json["lines"][0]["after"]["machine"]["X"], 35);
  EXPECT_EQ(json["lines"][2]["executions"], 3);
  EXPECT_EQ(json["lines"][2]["words"][0]["meaning"], "incremental distances");
}

TEST_F(Explain, a_file_alone_is_all_of_its_lines) {
  const Outcome all = passo("explain " + write("p.ngc", "G0 X1\nM2\n"));
  EXPECT_EQ(all.code, 0);
  EXPECT_THAT(all.out, HasSubstr(":1: G0 X1"));
  EXPECT_THAT(all.out, HasSubstr(":2: M2"));
}

TEST_F(Explain, a_bad_place_says_what_was_expected) {
  const std::string file = write("p.ngc", program);
  for (const char* place : {":0", ":x", ":3-2", ":-1", ":1-", ":99999999999", ":"}) {
    const Outcome outcome = passo("explain " + file + place);
    EXPECT_EQ(outcome.code, 2) << place;
    EXPECT_THAT(outcome.err, HasSubstr("expected FILE, FILE:LINE or FILE:FROM-TO")) << place;
  }
  const Outcome behind = passo("explain " + file + ":9");
  EXPECT_EQ(behind.code, 2);
  EXPECT_THAT(behind.err, HasSubstr("has 8 lines: expected a line from 1 to 8"));
  EXPECT_EQ(passo("explain " + path("none.ngc") + ":1").code, 2);
}

TEST_F(Explain, the_dialect_of_grbl_refuses_with_its_numbers) {
  const std::string file = write("p.ngc", "G0 X1\nM6 T1\nM2\n");
  EXPECT_EQ(passo("canon " + file).code, 0);
  const Outcome grbl = passo("canon --dialect grbl " + file);
  EXPECT_EQ(grbl.code, 2);
  EXPECT_THAT(grbl.err, HasSubstr("= rule: grbl error:20, unsupported or invalid command\n"));
  EXPECT_THAT(passo("explain --dialect grbl " + file + ":2").out, HasSubstr("grbl error:20"));

  const Outcome unknown = passo("canon --dialect fanuc " + file);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("expected linuxcnc, grbl or grblhal"));
  const Outcome deleting = passo("canon --dialect grbl --block-delete " + file);
  EXPECT_EQ(deleting.code, 2);
  EXPECT_THAT(deleting.err, HasSubstr("--block-delete does not work with --dialect grbl"));
}

}  // namespace
