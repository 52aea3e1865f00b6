// passo home: homed as a user types it.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;

const std::string machines = std::string(PASSO_SOURCE_DIR) + "/examples/machines/";

class HomeCommand : public passo::test::CommandLine {
 protected:
  // The Uno's machine, whose switches are near.
  std::string near_machine(const std::string& more = "") {
    const std::string axis =
        "steps_per_mm = 640\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 800\ntravel_mm = [-5, 5]\n";
    const std::string speeds = "seek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 0.5\n";
    std::string text = "name = 'near'\n[board]\nclock_hz = 16e6\nmax_event_rate_hz = 100e3\n";
    for (const char* letter : {"X", "Y", "Z"}) {
      const bool high = *letter == 'Z';
      text += std::string("[axis.") + letter + "]\n" + axis + "[axis." + letter + ".home]\n" + speeds +
              (high ? "direction = 'high'\nswitch_at_mm = 5.1\n" : "direction = 'low'\nswitch_at_mm = -5.2\n");
    }
    return write("near.toml", text + more);
  }
};

TEST_F(HomeCommand, finds_the_place_and_says_where_it_rests) {
  const std::string machine = near_machine();
  const Outcome outcome = passo("home -m " + machine);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Z: its switch closed 5.100 from where it stood; rests at 4.600\nX: "));
  EXPECT_THAT(outcome.out, HasSubstr(" s: at rest in Z4.600 X-4.700 Y-4.700 (machine)\n"));
  const Outcome json = passo("home --json -m " + machine);
  EXPECT_EQ(json.code, 0);
  const nlohmann::json all = nlohmann::json::parse(json.out, nullptr, false);
  EXPECT_EQ(all["homed"], true);
  EXPECT_NEAR(all["position_mm"]["X"], -4.7, 1.0 / 640);
  EXPECT_EQ(all["axes"][0]["axis"], "Z");
  EXPECT_NEAR(all["axes"][0]["way_mm"], 5.1, 1e-9);
}

TEST_F(HomeCommand, homes_an_emulated_board) {
  if (!built("motion_uno")) GTEST_SKIP() << "no compiler for the chip";
  const Outcome outcome = passo("home --board sim:uno --json -m " + near_machine());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json all = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_NEAR(all["position_mm"]["Z"], 4.6, 1.0 / 640);
}

TEST_F(HomeCommand, tells_what_is_wrong_by_a_stable_code) {
  // Further than 1.1 of the travel.
  std::string text = near_machine("[homing]\norder = 'XYZ'\n");
  const std::string far = near_machine("[homing]\norder = 'XYZ'\n");
  static_cast<void>(far);
  const Outcome none = passo("home -m " + machines + "pantograph.toml");
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("[home.no-switch]"));
}

}  // namespace
