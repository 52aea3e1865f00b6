// The troubles of docs/manual/troubles.md: physics loses steps, `passo check` knows before, and the cure helps.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

using passo::test::Outcome;
using testing::AnyOf;
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
};

std::ostream& operator<<(std::ostream& out, const Trouble& trouble) {
  return out << trouble.name;
}

const std::vector<Edit> ramp{{"start_stop_velocity_mm_s = 40", "start_stop_velocity_mm_s = 2"},
                             {"_s2 = 100000", "_s2 = 1200"}};

class Troubles : public passo::test::CommandLine, public testing::WithParamInterface<Trouble> {
 protected:
  // The trouble's file, with its cures if they are wanted.
  std::string file(const std::string& ending, bool cured) const {
    const std::string name = GetParam().name + ending;
    std::string text = passo::test::read(folder / name);
    for (const Edit& edit : GetParam().cures) {
      const std::size_t place = text.find(edit.from);
      if (cured && place != std::string::npos) text.replace(place, edit.from.size(), edit.to);
    }
    return write((cured ? "cured-" : "") + name, text);
  }
  std::string files(bool cured = false) const { return file(".ngc", cured) + " -m " + file(".toml", cured); }
};

TEST_P(Troubles, lose_steps) {
  const Outcome outcome = passo("run " + files() + " --physics");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[run.steps-lost]"));
  EXPECT_THAT(outcome.out, HasSubstr("line " + GetParam().line + ": X lost"));
}

TEST_P(Troubles, are_found_before) {
  const Outcome outcome = passo("check " + files());
  EXPECT_THAT(outcome.out, AnyOf(HasSubstr("motors          lost"), HasSubstr("motors          doubtful")));
  EXPECT_THAT(outcome.out, HasSubstr("at most in line " + GetParam().line + ":"));
}

TEST_P(Troubles, have_a_cure) {
  const Outcome verdict = passo("check " + files(true));
  EXPECT_EQ(verdict.code, 0) << verdict.err;
  EXPECT_THAT(verdict.out, HasSubstr("motors          safe"));
  const Outcome outcome = passo("run " + files(true) + " --physics");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Of, Troubles,
                         testing::Values(Trouble{"no-ramp", "3", ramp}, Trouble{"hard-stop", "17", ramp},
                                         Trouble{"short-table", "11", ramp},
                                         Trouble{"mid-band", "3", {{"F2880", "F1800"}}},
                                         Trouble{"too-fast", "3", {{"_s2 = 6000", "_s2 = 2500"}}},
                                         Trouble{"binding", "2", {{"friction_n = 500", "friction_n = 20"}}}),
                         [](const auto& one) {
                           std::string name = one.param.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
