// passo jog: moved by hand, as a user types it.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::on_router;
using passo::test::Outcome;
using testing::HasSubstr;

class JogCommand : public passo::test::CommandLine {
 protected:
  nlohmann::json jog(const std::string& words) const {
    const Outcome outcome = passo("jog" + on_router + words + " --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
};

TEST_F(JogCommand, goes_by_a_distance_straight_and_says_where_it_rests) {
  const Outcome outcome = passo("jog" + on_router + "X+3 Y-4 -F 1200");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(" at X3.000 Y-4.000 Z0.000 (machine): distance completed\n"));
  const nlohmann::json json = jog("X2.5");
  EXPECT_EQ(json["position_mm"]["X"], 2.5);
  EXPECT_EQ(json["ended_by"], "distance");
  // At 10 mm/s, and 10/800 s more for speeding up and braking.
  EXPECT_NEAR(json["time_s"], 0.25 + 10.0 / 800, 1e-3);
}

TEST_F(JogCommand, never_leaves_the_travel) {
  const nlohmann::json endless = jog("Z+ -F 3000");
  EXPECT_EQ(endless["position_mm"]["Z"], 60);
  EXPECT_EQ(endless["ended_by"], "travel");
  const nlohmann::json too_far = jog("X-1000 -F 6000");
  EXPECT_EQ(too_far["position_mm"]["X"], -400);
  EXPECT_EQ(too_far["ended_by"], "travel");
}

TEST_F(JogCommand, brakes_when_the_lease_is_not_renewed) {
  const nlohmann::json json = jog("X- --held 1.5 --lease 0.3");
  EXPECT_EQ(json["ended_by"], "lease");
  const double braking = 10.0 / 800;
  EXPECT_LE(json["time_s"], 1.5 + 0.3 + braking + 1e-3);
  EXPECT_GE(json["time_s"], 1.5);
  EXPECT_GE(json["position_mm"]["X"], -10 * (1.8 + braking));
  EXPECT_LE(json["position_mm"]["X"], -10 * 1.4);
  EXPECT_EQ(jog("X1 --held 9")["ended_by"], "distance");
}

TEST_F(JogCommand, refuses_what_is_no_jog) {
  for (const char* wrong : {"", "X", "A+1", "X+1 X-1", "X+ Y3", "Xfast", "X0", "X1 -F 0", "X1 -F nan",
                            "X1 --lease 0.01", "X1 --lease 60", "X1 --held -1"}) {
    EXPECT_EQ(passo("jog" + on_router + wrong).code, 2) << wrong;
  }
  EXPECT_EQ(passo("jog X1 -m " + write("bad.toml", "")).code, 3);
}

TEST_F(JogCommand, help_shows_examples) {
  const Outcome outcome = passo("jog --help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("passo jog -m router.toml X+10 -F 600"));
}

}  // namespace
