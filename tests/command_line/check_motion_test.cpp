// passo check --motion, as a user starts it.
#include "kit/command_line.hpp"
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

TEST_F(CheckMotion, help_has_an_example) {
  EXPECT_THAT(passo("check --help").out, testing::HasSubstr("passo check part.ngc -m router.toml --motion"));
}

}  // namespace
