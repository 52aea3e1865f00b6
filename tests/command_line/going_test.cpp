// passo frame, passo go, and what the end of a program does, as a user sees them.
#include <cmath>
#include <string>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class Going : public passo::test::CommandLine {
 protected:
  // The router with a park position.
  std::string parking_router(const std::string& more = "") const {
    return write("router.toml",
                 read(checkout + "/examples/machines/router.toml") + "\n[park]\nplace_mm = [-390, 290]\n" + more);
  }
};

constexpr const char* job =
    "G21 G90\nM3 S9000\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F600\nG1 X40\nG1 Y30\nG1 X10 Y10\nG0 Z5\nM2\n";

TEST_F(Going, frames_a_job_and_runs_the_frame_without_a_warning) {
  const std::string program = write("part.ngc", job);
  const std::string offsets = write("work.var", "5221\t20\n5222\t0\n5223\t-30\n");
  const Outcome made = passo("frame " + program + on_router + "-v " + offsets + " --height 2 -o " + path("frame.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const Outcome ran = passo("run " + path("frame.ngc") + on_router + " --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const Outcome on_grbl = passo("check " + path("frame.ngc") + on_router + "--board grbl");
  EXPECT_EQ(on_grbl.code, 0) << on_grbl.err;
  EXPECT_EQ(on_grbl.err, "");
  const auto place = nlohmann::json::parse(ran.out)["position_mm"];
  EXPECT_NEAR(place["X"].get<double>(), 30, 0.01) << place;
  EXPECT_NEAR(place["Z"].get<double>(), -25, 0.01) << place;
}

TEST_F(Going, refuses_a_frame_with_the_reason) {
  const std::string program = write("part.ngc", job);
  const Outcome unset = passo("frame " + program + on_router);
  EXPECT_EQ(unset.code, 2);
  EXPECT_THAT(unset.err, HasSubstr("[framing.no-zero]"));
  EXPECT_EQ(passo("frame " + program + on_router + "--machine-zero").code, 0);
  const Outcome low = passo("frame " + program + on_router + "--machine-zero --height -200");
  EXPECT_EQ(low.code, 2);
  EXPECT_THAT(low.err, HasSubstr("Z would go to -200.000 in machine coordinates, outside its travel of -120 to 60"));
  EXPECT_EQ(passo("frame " + write("wrong.ngc", "G21 G90\nG1 X1\nM2\n") + on_router).code, 2) << "no feed rate";
}

TEST_F(Going, parks_the_tool_z_first) {
  const std::string machine = parking_router();
  const Outcome made = passo("go park -m " + machine + " -o " + path("park.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome canon = passo("canon " + path("park.ngc"));
  ASSERT_EQ(canon.code, 0) << canon.err;
  const std::size_t up = canon.out.find("STRAIGHT_TRAVERSE(0.0000, 0.0000, 59.0000");
  const std::size_t away = canon.out.find("STRAIGHT_TRAVERSE(-390.0000, 290.0000, 59.0000");
  EXPECT_LT(up, away) << canon.out;
  EXPECT_NE(away, std::string::npos) << canon.out;
  const Outcome none = passo("go park" + on_router);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("[goto.no-park]"));
}

TEST_F(Going, goes_to_homes_and_the_work_zero_of_a_parameter_file) {
  const std::string offsets = write("work.var", "5161\t1\n5162\t-2\n5163\t0.5\n5221\t3\n5222\t4\n5223\t0\n");
  const Outcome mm = passo("go g28" + on_router + "-v " + offsets);
  EXPECT_THAT(mm.out, HasSubstr("G53 G0 X1.0000 Y-2.0000\nG53 G0 Z0.5000\n"));
  const Outcome zero = passo("go zero" + on_router + "-v " + offsets);
  EXPECT_THAT(zero.out, HasSubstr("G53 G0 Z59.0000\nG53 G0 X3.0000 Y4.0000\n%\n"));
}

TEST_F(Going, makes_a_program_of_a_macro) {
  const std::string macro = write("face.ngc",
                                  "; title = \"Face\"\n; [value.width]\n; least = 1\n; most = 400\n; default = 100\n"
                                  "G21 G91 G0 X#<width>\n");
  const Outcome made = passo("macro " + macro + " width=120 -o " + path("out.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome ran = passo("run " + path("out.ngc") + on_router + " --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  EXPECT_NEAR(nlohmann::json::parse(ran.out)["position_mm"]["X"].get<double>(), 120, 0.01);
  EXPECT_THAT(passo("macro " + macro).out, HasSubstr("#<width> = 100.000000\n"));
  for (const char* wrong : {"width=401", "width=", "width=1x", "depth=1", "=1"}) {
    EXPECT_EQ(passo("macro " + macro + " " + wrong).code, 2) << wrong;
  }
  EXPECT_EQ(passo("macro " + write("plain.ngc", "G0 X1\nM2\n")).code, 2);
}

TEST_F(Going, leaves_the_tool_parked_at_the_end_if_the_machine_file_says_so) {
  const auto place = [&](const std::string& more, const std::string& text) {
    const Outcome ran = passo("run " + write("end.ngc", text) + " -m " + parking_router(more) + " --json");
    EXPECT_EQ(ran.code, 0) << ran.err;
    std::string words;
    const auto summary = nlohmann::json::parse(ran.out);
    for (const auto& axis : summary["position_mm"]) {
      words += std::to_string(std::lround(axis.get<double>())) + " ";
    }
    return words;
  };
  EXPECT_EQ(place("", job), "10 10 5 ");
  EXPECT_EQ(place("at_end = \"rise\"\n", job), "10 10 59 ");
  EXPECT_EQ(place("at_end = \"park\"\n", job), "-390 290 59 ");
  EXPECT_EQ(place("at_end = \"park\"\n", "%\nG21 G90\nG0 X3\n%\n"), "3 0 0 ");
}

}  // namespace
