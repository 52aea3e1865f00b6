// passo home: homed as a user types it.
#include <cmath>

#include "kit/served_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using testing::HasSubstr;

class HomeCommand : public passo::test::ServedBoard {
 protected:
  // A machine of the Uno's whose switches are near; that of X as it is given.
  static constexpr const char* x_switch = "direction = 'low'\nswitch_at_mm = -5.2\n";
  std::string near_machine(const std::string& x = x_switch, const std::string& more = "") const {
    const std::string axis =
        "steps_per_mm = 640\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 800\ntravel_mm = [-5, 5]\n";
    const std::string speeds = "seek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 0.5\n";
    std::string text = "name = 'near'\n[board]\nclock_hz = 16e6\nmax_event_rate_hz = 90e3\n";
    const auto add = [&](const std::string& letter, const std::string& home) {
      text += "[axis." + letter + "]\n" + axis + "[axis." + letter + ".home]\n" + speeds + home;
    };
    add("X", x);
    add("Y", "direction = 'low'\nswitch_at_mm = -5.2\n");
    add("Z", "direction = 'high'\nswitch_at_mm = 5.1\n");
    return " -m " + write("near.toml", text + more);
  }
};

TEST_F(HomeCommand, finds_the_place_and_says_where_it_rests) {
  const Outcome outcome = passo("home" + near_machine());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Z: switch closed 5.100 from the start; stopped at 4.600\nX: "));
  EXPECT_THAT(outcome.out, HasSubstr(" s; stopped at Z4.600 X-4.700 Y-4.700 (machine)\n"));
  const Outcome json = passo("home --json" + near_machine());
  EXPECT_EQ(json.code, 0);
  const nlohmann::json all = nlohmann::json::parse(json.out, nullptr, false);
  EXPECT_EQ(all["homed"], true);
  EXPECT_NEAR(all["position_mm"]["X"], -4.7, 1.0 / 640);
  EXPECT_EQ(all["axes"][0]["axis"], "Z");
  EXPECT_NEAR(all["axes"][0]["way_mm"], 5.1, 1e-9);
}

TEST_F(HomeCommand, homes_an_emulated_board) {
  const Outcome outcome = passo("home --board sim:uno --json" + near_machine());
  if (lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json all = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(all["homed"], true);
  EXPECT_NEAR(all["position_mm"]["Z"], 4.6, 1.0 / 640);
}

TEST_F(HomeCommand, repeats_itself_and_tells_how_well_the_places_agree) {
  const Outcome words = passo("home --repeat 3" + near_machine());
  EXPECT_EQ(words.code, 0) << words.err;
  EXPECT_THAT(words.out, HasSubstr("homed 3 times:\n"
                                   "X: the mean position is 0.0 um from the first, the spread 0.0 um (0 steps)\n"));
  const Outcome json = passo("home --repeat 3 --json" + near_machine());
  const nlohmann::json all = nlohmann::json::parse(json.out, nullptr, false);
  EXPECT_EQ(all["repeats"][2]["axis"], "Z");
  EXPECT_EQ(all["repeats"][2]["spread_steps"], 0);
  EXPECT_EQ(passo("home --repeat 0" + near_machine()).code, 2);
}

// Normally closed switches, an emergency stop that opens, drivers and steps that are on at the other level.
TEST_F(HomeCommand, homes_with_inverted_pins) {
  const std::string pins =
      "[inputs]\nlimits = ['high', 'low', 'high']\nemergency_stop = 'high'\nfeed_hold = 'high'\n"
      "[outputs]\ndriver_enable = 'high'\nstep = 'low'\nflood = 'low'\n";
  for (const char* board : {"virtual", "sim:uno", "sim:pico"}) {
    const Outcome outcome = passo("home --json --board " + std::string(board) + near_machine(x_switch, pins));
    if (lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json all = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_EQ(all["homed"], true) << board;
    EXPECT_NEAR(all["axes"][1]["way_mm"], -5.2, 1e-9);
  }
}

// The Pico has three pins for limit switches: X and Z share one.
TEST_F(HomeCommand, squares_a_gantry) {
  const std::string gantry = "[axis.Y.second_motor]\ninverted = true\nskew_mm = 0.4\nmost_skew_mm = 1\ninput = ";
  for (const std::string board : {"virtual", "sim:mega", "sim:pico"}) {
    const std::string x = board == "sim:pico" ? std::string(x_switch) + "input = 2\n" : x_switch;
    const std::string rest = board == "sim:pico" ? "0\n[inputs]\nlimits = ['high']\n" : "4\n";
    const Outcome outcome = passo("home --json --board " + board + near_machine(x, gantry + rest));
    if (lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json all = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_NEAR(all["axes"][2]["squared_mm"], -0.4, 1.01 / 640) << board;
  }
}

// The switches of the Uno are on one port, those of the Mega are not. A Pico watches any.
TEST_F(HomeCommand, homes_two_axes_at_once_where_the_board_can_watch_both_switches) {
  const std::string at_once = "[homing]\norder = 'Z (XY)'\n";
  const Outcome uno = passo("home --json --board sim:uno" + near_machine(x_switch, at_once));
  if (lacks_an_emulator(uno)) GTEST_SKIP() << uno.err;
  EXPECT_EQ(uno.code, 0) << uno.err;
  EXPECT_NEAR(nlohmann::json::parse(uno.out, nullptr, false)["position_mm"]["Y"], -4.7, 1.0 / 640);
  const Outcome mega = passo("home --json --board sim:mega" + near_machine(x_switch, at_once));
  EXPECT_EQ(mega.code, 1);
  EXPECT_THAT(mega.err, HasSubstr("cannot watch these limit switches at the same time"));
  const Outcome pico = passo("home --json --board sim:pico" + near_machine(x_switch, at_once));
  if (lacks_an_emulator(pico)) GTEST_SKIP() << pico.err;
  EXPECT_EQ(pico.code, 0) << pico.err;
  EXPECT_NEAR(nlohmann::json::parse(pico.out, nullptr, false)["position_mm"]["Y"], -4.7, 1.0 / 640);
}

TEST_F(HomeCommand, refuses_a_board_without_a_pin_that_is_inverted) {
  const Outcome outcome = passo("home --board sim:uno" + near_machine(x_switch, "[inputs]\ndoor = 'high'\n"));
  if (lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[inputs] and [outputs] of the machine file require: it has no door"));
}

TEST_F(HomeCommand, tells_what_is_wrong_by_a_stable_code) {
  // X stands far behind the place where its switch closes.
  const Outcome closed = passo("home --json" + near_machine("direction = 'low'\nswitch_at_mm = 3\n"));
  EXPECT_EQ(closed.code, 1);
  EXPECT_THAT(closed.err, HasSubstr("homing X: its switch is still triggered after the pull-off [home.still-closed]"));
  const nlohmann::json all = nlohmann::json::parse(closed.out, nullptr, false);
  EXPECT_EQ(all["homed"], false);
  EXPECT_EQ(all["error"]["code"], "home.still-closed");
  EXPECT_EQ(all["error"]["axis"], "X");
  EXPECT_EQ(all["axes"].size(), 1) << "Z is homed";
  const Outcome none = passo("home -m " + std::string(PASSO_SOURCE_DIR) + "/examples/machines/pantograph.toml");
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("[home.no-switch]"));
  EXPECT_EQ(passo("home").code, 2);
}

// The program begins where the machine rests when it has been homed.
TEST_F(HomeCommand, goes_before_a_run) {
  const std::string machine = near_machine();
  const std::string command = "run " + write("p.ngc", "G21 G90 G1 F600 X2\nM2\n") + " --home --json" + machine;
  const nlohmann::json all = nlohmann::json::parse(passo(command).out, nullptr, false);
  EXPECT_EQ(all["steps"]["X"]["total"], 6.7 * 640);
  EXPECT_EQ(all["steps"]["X"]["net"], 2 * 640);
  EXPECT_EQ(all["position_mm"]["X"], 2);
  EXPECT_NEAR(all["position_mm"]["Z"], 4.6, 1.0 / 640);
  const Outcome emulated = passo(command + " --board sim:uno");
  if (!lacks_an_emulator(emulated)) {
    EXPECT_EQ(emulated.code, 0) << emulated.err;
    EXPECT_EQ(nlohmann::json::parse(emulated.out, nullptr, false)["steps"], all["steps"]);
  }
  const Outcome closed =
      passo("run " + path("p.ngc") + " --home" + near_machine("direction = 'low'\nswitch_at_mm = 3\n"));
  EXPECT_EQ(closed.code, 1);
  EXPECT_THAT(closed.err, HasSubstr("[home.still-closed]"));
  const std::string bare = std::string(PASSO_SOURCE_DIR) + "/examples/machines/pantograph.toml";
  EXPECT_EQ(passo("run " + path("p.ngc") + " --home -m " + bare).code, 3);
}

// Over a line, and broken off: the job goes on from where it began, which was found by homing.
TEST_F(HomeCommand, goes_before_a_run_that_is_resumed) {
  const std::string machine = near_machine();
  const std::string board = serve("16000000", path("near.toml"));
  const std::string command = "run " + write("p.ngc", "G21 G90 G1 F600 X2\nX-2\nX1\nM2\n") + " --home --json" +
                              machine + " --board " + board + " --journal " + path("j");
  const Outcome held = passo(command + " --hold-at 0.5");
  EXPECT_EQ(held.code, 0) << held.err;
  EXPECT_THAT(held.err, HasSubstr("--resume continues"));
  const Outcome resumed = passo(command + " --resume");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const nlohmann::json all = nlohmann::json::parse(resumed.out, nullptr, false);
  EXPECT_EQ(all["position_mm"]["X"], 1);
  // The board has counted from machine zero, where it stood.
  const auto info = nlohmann::json::parse(passo("board info --json " + board).out, nullptr, false);
  EXPECT_EQ(info["status"]["positions"][0], 640);
  EXPECT_EQ(info["status"]["positions"][2], std::lround(4.6 * 640));
}

// A switch that stands inside the travel is a limit for the program, whatever homed by it before.
TEST_F(HomeCommand, leaves_a_switch_inside_the_travel_a_limit) {
  const std::string inward = write("low.ngc", "G21 G90 G1 F600 X-4.9\nX0\nM2\n");
  const std::string outward = write("high.ngc", "G21 G90 G1 F600 X4.9\nX0\nM2\n");
  const std::string emulated = " --board sim:uno";
  const bool has_emulator = passo("board info sim:uno").code == 0;
  for (const std::string board : {"", " --cut-cable-at 9999:1", emulated.c_str()}) {
    if (board == emulated && !has_emulator) continue;
    for (const auto& [program, home] : {std::pair{inward, "direction = 'low'\nswitch_at_mm = -3\n"},
                                        std::pair{outward, "direction = 'high'\nswitch_at_mm = 3\n"}}) {
      for (const char* const homes : {" --home", ""}) {
        const Outcome outcome = passo("run " + program + homes + near_machine(home) + board);
        EXPECT_EQ(outcome.code, 1) << program << homes << board;
        EXPECT_THAT(outcome.err, HasSubstr("the limit switch of X closed in line 1 of")) << program << homes << board;
      }
    }
  }
}

TEST_F(HomeCommand, help_shows_examples) {
  const Outcome outcome = passo("home --help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("passo home -m uno.toml --board serial:/dev/ttyACM0"));
}

}  // namespace
