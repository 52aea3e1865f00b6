// passo board settings, passo machine --from grbl:…, and programs with more axes, on boards with each firmware.
#include <string>

#include "kit/board_on_port.hpp"
#include "kit/command_line.hpp"
#include "kit/firmware_fakes.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::json;
using passo::test::FirmwareFake;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Board = passo::test::BoardOnPort<FirmwareFake>;

namespace test = passo::test;

class BoardSettings : public passo::test::CommandLine {
 protected:
  passo::test::Outcome settings(const Board& board, const std::string& options) const {
    EXPECT_TRUE(board.listens());
    return passo("board settings " + board.address() + " " + options);
  }
};

TEST_F(BoardSettings, are_shown_written_saved_compared_and_restored) {
  const Board board{FirmwareFake(test::grbl_mega_5x("XYZA"))};
  const std::string file = path("kept.txt");
  auto outcome = settings(board, "--save " + file);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(test::read(file), HasSubstr("[AXS:4:XYZA]\n$0=10\n"));

  outcome = settings(board, "");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("$113        500.000  deg/min    Maximum rate of A\n"));
  outcome = settings(board, "110 23");
  EXPECT_THAT(outcome.out, HasSubstr("Highest speed, also of rapids"));
  EXPECT_THAT(outcome.out, HasSubstr("8: A"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("$111")));

  outcome = settings(board, "--set 110=600 --set 120=0 --set '$111=700' --json");
  EXPECT_EQ(outcome.code, 1);
  const json all = json::parse(outcome.out);
  EXPECT_EQ(all["firmware"], "grbl-Mega-5X");
  ASSERT_EQ(all["changes"].size(), 3U);
  EXPECT_EQ(all["changes"][0]["value"], "600.000");
  EXPECT_EQ(all["changes"][1]["written"], false);
  EXPECT_EQ(all["changes"][1]["value"], "10.000");
  EXPECT_EQ(all["changes"][2]["written"], true);

  outcome = settings(board, "--compare " + file);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out,
            "$110: 500.000 in the file, 600.000 on the board\n$111: 500.000 in the file, 700.000 on the board\n");
  outcome = settings(board, "--restore " + file);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "$110: 600.000 -> 500.000\n$111: 700.000 -> 500.000\n");
  outcome = settings(board, "--compare " + file);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "no setting differs\n");
}

// The list of processes shows the words of a command to everybody on the computer.
TEST_F(BoardSettings, are_written_from_standard_input_so_that_no_password_is_in_the_command) {
  const Board board{FirmwareFake(test::grbl_mega_5x("XYZA"))};
  auto outcome = passo("board settings " + board.address() + " --set 112=800 --set - --json",
                       R"(printf '110=600\n\n$111=700\r\n' |)");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json changes = json::parse(outcome.out)["changes"];
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[1]["name"], "$110");
  EXPECT_EQ(changes[1]["value"], "600.000");
  EXPECT_EQ(changes[2]["value"], "700.000");
  outcome = passo("board settings " + board.address() + " --set -", "echo hello |");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("hello: expected NAME=VALUE"));
}

TEST_F(BoardSettings, bad_calls_say_what_is_expected) {
  auto outcome = passo("board settings tcp:127.0.0.1:1");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("[board.not-grbl]"));
  outcome = passo("board settings grbl:/dev/null --set 110");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--set 110: expected NAME=VALUE"));
  const std::string bad = write("bad.txt", "$0=10\nhello\n");
  outcome = passo("board settings grbl:/dev/null --restore " + bad);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("bad.txt: line 2: expected a setting such as $110=500 [settings.bad-file]"));
  const Board board{FirmwareFake(test::grbl_mega())};
  outcome = settings(board, "999");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the board has no setting $999"));
}

TEST_F(BoardSettings, become_a_machine_file) {
  const Board grbl{FirmwareFake(test::grbl_mega_5x("XYZA"))};
  auto outcome = passo("machine --from " + grbl.address() + " -o " + path("mine.toml"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(test::read(path("mine.toml")), HasSubstr("[axis.A]"));
  EXPECT_EQ(passo("machine " + path("mine.toml")).code, 0);

  // FluidNC has its configuration in YAML.
  test::FirmwareTraits traits = test::fluidnc();
  traits.about.emplace_back("[MSG:WARN: Low memory: 12000]");
  const Board fluid{FirmwareFake(traits)};
  outcome = passo("machine --from " + fluid.address());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("[axis.X]"));
  EXPECT_THAT(outcome.err, HasSubstr("axes/x/steps_per_mm"));
  EXPECT_THAT(outcome.err, HasSubstr("the board says: WARN: Low memory: 12000"));

  EXPECT_EQ(passo("machine --from grbl:tcp:127.0.0.1:1").code, 1);
}

TEST_F(BoardSettings, a_wire_cut_runs_on_a_board_with_its_four_axes) {
  const std::string foam = PASSO_SOURCE_DIR "/examples/machines/foam.toml";
  auto outcome = passo("cam wire " PASSO_SOURCE_DIR
                       "/examples/foam/naca2412.dat --axes XYUV --chord 20,15 --span 300 --width 200 -o " +
                       path("wing.ngc"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Board board{FirmwareFake(test::grbl_mega_5x("XYUV"))};
  outcome = passo("check " + path("wing.ngc") + " -m " + foam + " --board " + board.address());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("grbl-Mega-5X 1.2i.20260521, 35 blocks"));
  const Board three{FirmwareFake(test::grbl_mega())};
  outcome = passo("run " + path("wing.ngc") + " -m " + foam + " --board " + three.address());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("it has no axis U"));
}

TEST_F(BoardSettings, a_program_with_a_rotary_axis_ends_where_it_says) {
  const std::string machine = write("a.toml", test::read(PASSO_SOURCE_DIR "/examples/machines/router.toml") +
                                                  "\n[axis.A]\nsteps_per_deg = 10\ntravel_deg = [-3600, 3600]\n"
                                                  "max_velocity_deg_s = 100\nmax_acceleration_deg_s2 = 1000\n");
  const std::string program = write("p.ngc", "G21 G90\nG1 X1 A9 F6000\nG0 A0\nM2\n");
  for (const auto& traits : {test::grblhal("XYZA"), test::fluidnc(4)}) {
    const Board board{FirmwareFake(traits)};
    const auto outcome = passo("run " + program + " -m " + machine + " --json --board " + board.address());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["position_mm"], (json{{"X", 1.0}, {"Y", 0.0}, {"Z", 0.0}, {"A", 0.0}}));
  }
}

TEST_F(BoardSettings, an_unknown_firmware_is_noted) {
  test::FirmwareTraits traits = test::grbl_mega();
  traits.about.emplace_back("[FIRMWARE:MyFork]");
  const Board board{FirmwareFake(traits)};
  const auto outcome = settings(board, "110");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("does not know the firmware MyFork 1.1h.20190825, and treats it as Grbl 1.1"));
}

}  // namespace
