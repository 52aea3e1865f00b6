// The troubles of docs/manual/troubles.md: physics loses steps, `passo check` knows before, and the cure helps. The
// cause that the check names is the cause: without it no steps are lost, and without another likely cause they are
// still lost.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;

const std::filesystem::path folder = std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "troubles";

struct Edit {
  std::string from;
  std::string to;
};

struct Trouble {
  std::string name;
  std::string line;         // of the program, where steps are lost
  std::vector<Edit> cures;  // of the machine file or the program
  std::string cause;        // as `check --json` names it
  std::vector<Edit> without_cause;
  std::vector<Edit> without_another;  // that is not the cause
};

std::ostream& operator<<(std::ostream& out, const Trouble& trouble) {
  return out << trouble.name;
}

const std::vector<Edit> ramp{{"start_stop_velocity_mm_s = 40", "start_stop_velocity_mm_s = 2"},
                             {"_s2 = 100000", "_s2 = 1200"}};
// A table of rates that goes on where the trouble's own table ends.
const std::vector<Edit> ramp_down{
    {"G1 X40 ",
     "G1 X40\nG1 F1800 X40.5\nG1 F1680 X41\nG1 F1560 X41.5\nG1 F1440 X42\nG1 F1320 X42.5\nG1 F1200 X43\n"
     "G1 F1080 X43.5\nG1 F960 X44\nG1 F840 X44.5\nG1 F720 X45\nG1 F600 X45.5\nG1 F480 X46\nG1 F360 X46.5\n"
     "G1 F240 X47\nG1 F120 X47.5 "}};
const std::vector<Edit> longer_table{
    {"G1 F2340 X60 ",
     "G1 F1200 X5\nG1 F1320 X5.5\nG1 F1440 X6\nG1 F1560 X6.5\nG1 F1680 X7\nG1 F1800 X7.5\nG1 F1920 X8\n"
     "G1 F2040 X8.5\nG1 F2160 X9\nG1 F2280 X9.5\nG1 F2340 X60 "}};

std::vector<Edit> no_friction(const std::string& newtons) {
  return {{"friction_n = " + newtons, "friction_n = 0"}};
}

class Troubles : public passo::test::CommandLine, public testing::WithParamInterface<Trouble> {
 protected:
  // The trouble's program and machine file, edited. Each edit changes one of them.
  std::string files(const std::vector<Edit>& edits = {}) const {
    std::string program = passo::test::read(folder / (GetParam().name + ".ngc"));
    std::string machine = passo::test::read(folder / (GetParam().name + ".toml"));
    for (const Edit& edit : edits) {
      std::string& text = program.find(edit.from) != std::string::npos ? program : machine;
      const std::size_t place = text.find(edit.from);
      EXPECT_NE(place, std::string::npos) << edit.from;
      if (place != std::string::npos) text.replace(place, edit.from.size(), edit.to);
    }
    return write("trouble.ngc", program) + " -m " + write("trouble.toml", machine);
  }
};

TEST_P(Troubles, lose_steps) {
  const Outcome outcome = passo("run " + files() + " --physics");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[run.steps-lost]"));
  EXPECT_THAT(outcome.out, HasSubstr("line " + GetParam().line + ": X lost"));
}

TEST_P(Troubles, are_found_before) {
  const Outcome outcome = passo("check " + files());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("motors          lost"));
  EXPECT_THAT(outcome.out, HasSubstr("at most in line " + GetParam().line + ":"));
}

TEST_P(Troubles, are_explained_by_their_cause) {
  const Outcome words = passo("check " + files());
  const auto json = nlohmann::json::parse(passo("check " + files() + " --json").out);
  const auto& worst = json["margin"]["worst_lines"][0];
  EXPECT_EQ(json["margin"]["verdict"], "lost");
  EXPECT_EQ(worst["verdict"], "lost");
  EXPECT_EQ(worst["want"], GetParam().cause);
  const bool is_torque = GetParam().cause == "torque";
  EXPECT_EQ(words.out.find("the torque alone would be enough") == std::string::npos, is_torque) << words.out;
  EXPECT_EQ(worst["needed_nm"] > worst["low_nm"], GetParam().cause != "calm") << worst;
}

TEST_P(Troubles, lose_no_steps_without_the_cause_and_lose_them_without_another) {
  const Outcome without_cause = passo("run " + files(GetParam().without_cause) + " --physics");
  EXPECT_EQ(without_cause.code, 0) << without_cause.err;
  const Outcome without_another = passo("run " + files(GetParam().without_another) + " --physics");
  EXPECT_EQ(without_another.code, 1);
  EXPECT_THAT(without_another.err, HasSubstr("[run.steps-lost]"));
}

TEST_P(Troubles, have_a_cure) {
  const Outcome verdict = passo("check " + files(GetParam().cures));
  EXPECT_EQ(verdict.code, 0) << verdict.err;
  EXPECT_THAT(verdict.out, HasSubstr("motors          safe"));
  const Outcome outcome = passo("run " + files(GetParam().cures) + " --physics");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Of, Troubles,
    testing::Values(
        Trouble{"no-ramp", "3", ramp, "jump", ramp, no_friction("100")},
        Trouble{"hard-stop", "17", ramp, "jump", ramp_down, no_friction("20")},
        Trouble{"short-table", "11", ramp, "jump", longer_table, no_friction("40")},
        Trouble{"mid-band", "3", {{"F2880", "F1800"}}, "calm", {{"F2880", "F1800"}}, {{"_s2 = 300", "_s2 = 100"}}},
        // Half the speed, with the same jumps of the acceleration. No jumps, at the same speed.
        Trouble{"too-fast",
                "3",
                {{"_s2 = 6000", "_s2 = 2500"}},
                "torque",
                {{"velocity_mm_s = 90", "velocity_mm_s = 45"}},
                {{"_s2 = 6000", "_s2 = 6000\nmax_jerk_mm_s3 = 2000000"}}},
        Trouble{"binding",
                "2",
                {{"friction_n = 500", "friction_n = 20"}},
                "torque",
                {{"friction_n = 500", "friction_n = 20"}},
                {{"_s2 = 500", "_s2 = 20\nmax_jerk_mm_s3 = 100"}}}),
    [](const auto& one) {
      std::string name = one.param.name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

}  // namespace
