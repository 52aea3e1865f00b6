// What a line costs, as `passo check` tells it before the run.
#include <string>
#include <utility>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using testing::HasSubstr;
using testing::Not;

class CheckLine : public passo::test::CommandLine {
 protected:
  const std::string examples_ = PASSO_SOURCE_DIR "/examples/";
  const std::string uno_ = examples_ + "machines/uno.toml";
  const std::string bends_ =
      "G21 G90 G17 G64 P.02 F3000 S1000 M3\nG0 X30 Y0\nG3 X30 Y0 I-30 J0\nG1 X20 Y5 Z-3\nX25 Y9 Z-1\nX0 Y0 Z0\nM2\n";

  nlohmann::json json_of(const std::string& command) const {
    const passo::test::Outcome outcome = passo(command + " --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
  std::string with_jerk() const {
    std::string text = passo::test::read(uno_);
    const std::string last = "[axis.Z]\n";
    return write("jerk.toml", text.insert(text.find(last) + last.size(), "max_jerk_mm_s3 = 10000\n"));
  }
};

// Backlash that is taken up takes time on any board: it is no cost of the line.
TEST_F(CheckLine, does_not_cost_the_time_that_backlash_takes) {
  const std::string slack = write("slack.toml", passo::test::read(uno_) + "\n[axis.X.screw]\nbacklash_mm = 2\n");
  const std::string program = write("p.ngc", bends_);
  const auto check = json_of("check " + program + " -m " + slack)["line"];
  const auto run = json_of("run " + program + " -m " + slack + " --cut-cable-at 9999:1")["board"];
  EXPECT_NEAR(check["cost_s"], run["cost_of_line_s"], 1e-9);
}

// The check plays just what the run plays, so they agree to the last digit.
TEST_F(CheckLine, tells_what_a_run_over_the_line_takes) {
  const std::string bends = write("p.ngc", bends_);
  const std::pair<std::string, std::string> cases[] = {
      {bends, uno_}, {bends, with_jerk()}, {examples_ + "engrave.ngc", uno_}};
  for (const auto& [program, machine] : cases) {
    SCOPED_TRACE(program + " on " + machine);
    const auto check = json_of("check " + program + " -m " + machine)["line"];
    const auto run = json_of("run " + program + " -m " + machine + " --cut-cable-at 9999:1")["board"];
    EXPECT_EQ(check["held_items"], 42);
    EXPECT_GT(check["cost_s"], 0.0);
    EXPECT_NEAR(check["time_s"], run["end_s"], 1e-9);
    EXPECT_NEAR(check["cost_s"], run["cost_of_line_s"], 1e-9);
    EXPECT_NEAR(check["cost_share"], run["cost_of_line_share"], 1e-9);
    EXPECT_EQ(check["rests"], run["rests"]);
  }
}

// The firmware's own answers take other times than the virtual board's.
TEST_F(CheckLine, is_within_two_hundredths_of_what_the_firmware_takes) {
  const std::string program = write("p.ngc", bends_);
  const auto check = json_of("check " + program + " -m " + uno_)["line"];
  const auto run = json_of("run --yes " + program + " -m " + uno_ + " --board sim:uno")["board"];
  EXPECT_NEAR(check["time_s"].get<double>() / run["end_s"].get<double>(), 1, 0.02);
}

TEST_F(CheckLine, is_told_in_words_by_check_and_run) {
  const std::string program = write("p.ngc", bends_);
  EXPECT_THAT(passo("check " + program + " -m " + uno_).out,
              HasSubstr("\nserial link     to a board with a queue of 42 items: "));
  EXPECT_THAT(passo("run " + program + " -m " + uno_ + " --cut-cable-at 9999:1").out,
              HasSubstr("longer than without it: "));
}

TEST_F(CheckLine, is_not_told_of_a_machine_without_places_nor_where_a_probe_decides) {
  const std::string router = examples_ + "machines/router.toml";
  EXPECT_THAT(passo("check " + examples_ + "engrave.ngc -m " + router).out, Not(HasSubstr("\nline ")));
  EXPECT_TRUE(json_of("check " + examples_ + "engrave.ngc -m " + router)["line"].is_null());
  EXPECT_TRUE(json_of("check " + examples_ + "probe-corner.ngc -m " + uno_)["line"].is_null());
}

// A hold is no cost of the line.
TEST_F(CheckLine, is_not_told_of_a_run_that_was_changed_on_the_way) {
  const std::string run = "run " + write("p.ngc", bends_) + " -m " + uno_ + " --cut-cable-at 9999:1 --hold-at 1:1";
  EXPECT_FALSE(json_of(run)["board"].contains("cost_of_line_s"));
}

}  // namespace
