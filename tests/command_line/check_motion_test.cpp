// passo check --motion, as a user starts it.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "kit/command_line.hpp"
#include "kit/in_full.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;

const std::string bench = std::string(PASSO_SOURCE_DIR) + "/examples/machines/bench.toml";

class CheckMotion : public passo::test::CommandLine {
 protected:
  Outcome check(const std::string& text, const std::string& more = "") const {
    return passo("check " + write("p.ngc", text) + " -m " + bench + " --motion " + more);
  }
};

TEST_F(CheckMotion, a_straight_way_is_good_and_as_fast_as_can_be) {
  const Outcome outcome = check("G21 G0 X60\nM2\n");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("time         0.800000 s, bound 0.800000 s, time / bound 1.0000"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("good: within every limit"));
}

TEST_F(CheckMotion, stops_where_the_program_wants_them_are_in_the_bound_too) {
  const Outcome outcome = check("G21 G61.1 G0 X60\nG0 Y60\nG4 P1\nG1 X0 F600\nM2\n", "--json");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["good"], true);
  EXPECT_NEAR(json["time_s"], 0.8 + 0.8 + 1 + 6.02, 1e-9);
  EXPECT_NEAR(json["time_over_bound"], 1, 1e-9);
  EXPECT_NEAR(json["axes"]["X"]["acceleration"]["multiple"], 1, 1e-9);
  EXPECT_EQ(json["axes"]["X"]["step_acceleration"]["within_rounding"], true);
  EXPECT_NEAR(json["axes"]["Z"]["velocity"]["value"], 0, 1e-12);
  EXPECT_NEAR(json["feed"]["multiple"], 1, 1e-9);
  EXPECT_EQ(json["faults"].size(), 0U);
}

TEST_F(CheckMotion, a_wrong_program_shows_its_findings_and_is_not_planned) {
  const Outcome outcome = check("G21 G1 X5\nM2\n");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, testing::HasSubstr("gcode.missing-feed"));
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(passo("check p.ngc -m nowhere.toml --motion").code, 3);
}

TEST_F(CheckMotion, knows_a_time_that_no_path_in_the_tolerance_can_beat) {
  const auto json = nlohmann::json::parse(check("G21 G64 P0.01 G0 X5\nY5\nX10\nM2\n", "--json").out);
  EXPECT_LT(json["tube_bound_s"], json["time_bound_s"]);
  EXPECT_GT(json["time_over_tube_bound"], 1);
  EXPECT_LT(json["time_over_tube_bound"], 1.015);
}

// A gap, an infinite deviation and exit code 1 were reported.
TEST_F(CheckMotion, knows_backlash) {
  const std::string machine = write("worn.toml", passo::test::read(bench) + "\n[axis.X.screw]\nbacklash_mm = 0.2\n");
  const std::string program = write("p.ngc", "G21 G90 G64\nG1 X-10 F600\nX5 Y5\nX0\nM2\n");
  const Outcome outcome = passo("check " + program + " -m " + machine + " --motion");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("backlash not taken up"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("good: within every limit"));
  const auto json = nlohmann::json::parse(passo("check " + program + " -m " + machine + " --motion --json").out);
  EXPECT_LT(json["axes"]["X"]["lost_motion"]["value"], 1e-4);  // mm; the limit is a step
  EXPECT_FALSE(json["axes"]["Y"].contains("lost_motion"));
  EXPECT_GE(json["time_over_bound"], 1 - 1e-6);
}

TEST_F(CheckMotion, says_what_limits_the_speed) {
  const Outcome outcome = check("G21 G1 X60 F600\nM2\n");
  EXPECT_THAT(outcome.out, testing::HasSubstr("the programmed feed; first in line 1"));
  const auto json = nlohmann::json::parse(check("G21 G0 X60\nM2\n", "--json").out);
  EXPECT_EQ(json["speed"]["bounds"][0]["axis"], "X");
}

// The turning of a cubic whose slope is nearly 0 had no end.
TEST_F(CheckMotion, ends_where_a_rotary_axis_does_nearly_all_of_the_motion) {
  const std::string cases = PASSO_SOURCE_DIR "/../shared/cases/motion/check_hang";
  if (!std::filesystem::exists(cases + ".ngc")) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  const Outcome outcome = passo("check " + cases + ".ngc -m " + cases + ".toml --motion");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

TEST_F(CheckMotion, draws_the_motion) {
  const std::string picture = path("motion.svg");
  const Outcome outcome = check("G21 G0 X5\nY5\nM2\n", "--picture " + picture);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(passo::test::read(picture), testing::HasSubstr("<svg"));
  const Outcome wrong = check("G21 G0 X5\nM2\n", "--picture motion.jpeg");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, testing::HasSubstr("the name of a picture must end with .svg or .png"));
}

TEST_F(CheckMotion, help_has_an_example) {
  EXPECT_THAT(passo("check --help").out, testing::HasSubstr("passo check part.ngc -m router.toml --motion"));
}

// A row of the table in motion-mm/README.md: the time of a schedule that keeps every limit within the tolerance.
struct Peer {
  std::string file;
  double reference = 0;
};

std::vector<Peer> peers() {
  const std::filesystem::path folder = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/peers/motion-mm";
  std::ifstream readme(folder / "README.md");
  std::vector<Peer> all;
  for (std::string row; std::getline(readme, row);) {
    std::smatch found;
    if (!std::regex_match(row, found, std::regex(R"(\| (p\d\d) [^|]*\| ([0-9.]+) \|.*)"))) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename().string().starts_with(found[1].str() + "_")) {
        all.push_back({.file = entry.path().string(), .reference = std::stod(found[2])});
      }
    }
  }
  return all;
}

TEST_F(CheckMotion, keeps_the_limits_on_programs_of_other_projects_and_is_about_as_fast_as_any_way_that_does) {
  if (passo::test::in_full() == 0) GTEST_SKIP() << "takes half a minute: PASSO_IN_FULL=1";
  const std::vector<Peer> all = peers();
  if (all.empty()) GTEST_SKIP() << "no ../shared/peers/motion-mm beside this checkout";
  for (std::size_t i = 0; i < all.size(); i += passo::test::in_full()) {
    const Peer& peer = all[i];
    const Outcome outcome = passo("check " + peer.file + " -m " + bench + " --motion --json");
    EXPECT_EQ(outcome.code, 0) << peer.file << outcome.out << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["good"], true) << peer.file;
    const double times = json["time_s"].get<double>() / peer.reference;
    EXPECT_LT(times, 1.01) << peer.file;
    std::printf("%.4f of the reference: %s\n", times, std::filesystem::path(peer.file).filename().c_str());
  }
}

}  // namespace
