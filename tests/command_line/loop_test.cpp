// `passo loop`: a motor with an encoder and PID.
#include <algorithm>
#include <cmath>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;

class Loop : public passo::test::CommandLine {
 protected:
  nlohmann::json study(const std::string& options) const {
    const Outcome outcome = passo("loop --json " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(Loop, by_the_rule_has_the_gains_of_the_ultimate_cycle) {
  const auto json = study("--compare");
  const double gain = json["ultimate"]["gain"];
  const double period = json["ultimate"]["period_s"];
  ASSERT_EQ(json["controllers"].size(), 3U);
  EXPECT_NEAR(json["controllers"][0]["gains"]["kp"].get<double>(), 0.5 * gain, 1e-12);
  EXPECT_NEAR(json["controllers"][1]["gains"]["ki"].get<double>(), 0.45 * gain * 1.2 / period, 1e-9);
  EXPECT_NEAR(json["controllers"][2]["gains"]["kd"].get<double>(), 0.6 * gain * period / 8, 1e-12);
}

TEST_F(Loop, with_p_alone_leaves_an_error_and_with_an_integral_none) {
  const double with_p = study("--gains 0.02,0,0")["controllers"][0]["error"];
  const double with_pi = study("--gains 0.02,2,0")["controllers"][0]["error"];
  EXPECT_GT(with_p, 0.5);
  EXPECT_LT(std::abs(with_pi), 0.1);
}

TEST_F(Loop, that_is_slower_swings_at_a_lower_gain) {
  const double fast = study("--of position --rule p --period 100")["ultimate"]["gain"];
  const double slow = study("--of position --rule p --period 1000")["ultimate"]["gain"];
  EXPECT_GT(fast, 2 * slow);
}

TEST_F(Loop, takes_the_motor_of_a_machine) {
  const std::string strong = std::string(PASSO_SOURCE_DIR) + "/examples/machines/strong-router.toml";
  EXPECT_GT(study("-m " + strong + " --axis X --rule p")["ultimate"]["gain"].get<double>(),
            study("--rule p")["ultimate"]["gain"].get<double>());
  EXPECT_EQ(passo("loop -m " + strong + " --axis Q").code, 2);
}

TEST_F(Loop, prints_a_table_and_draws) {
  const Outcome outcome = passo("loop --gains 0.02,2,0 --time 0.01");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("time_s,wanted,counted,is,speed_rad_s,asked_nm,torque_nm\n0,30,0,"));
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 102);
  EXPECT_EQ(passo("loop --gains 0.02,2,0 --picture " + path("l.svg")).code, 0);
  EXPECT_THAT(passo::test::read(path("l.svg")), HasSubstr("</svg>"));
}

TEST_F(Loop, refuses_what_it_does_not_know) {
  EXPECT_EQ(passo("loop --load 0.1").code, 2);
  EXPECT_THAT(passo("loop --load x@1").err, HasSubstr("expected NM@S"));
  EXPECT_EQ(passo("loop --gains 1,2").code, 2);
  EXPECT_EQ(passo("loop --to 0").code, 2);
  EXPECT_THAT(passo("loop --to nan").err, HasSubstr("expected a number from -100000 to 100000, found 'nan'"));
  EXPECT_EQ(passo("loop --gains 1,nan,0").code, 2);
  const std::string uno = std::string(PASSO_SOURCE_DIR) + "/examples/machines/uno.toml";
  EXPECT_THAT(passo("loop --machine " + uno).err, HasSubstr("--axis is missing: expected one of "));
  EXPECT_EQ(passo("loop --axis X").code, 2);
}

}  // namespace
