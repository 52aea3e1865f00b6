// passo follower sim, as a user starts it.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class FollowerCommand : public passo::test::CommandLine {
 protected:
  Outcome sim(const std::string& arguments) const { return passo("follower sim " + arguments); }
};

// The first board in its day: a clock of 20 Hz, and the windings on LEDs.
TEST_F(FollowerCommand, shows_the_first_boards_windings_and_leds_at_twenty_pulses_a_second) {
  const Outcome board = sim("first_board --clock 20 --time 0.4");
  if (lacks_an_emulator(board)) GTEST_SKIP() << board.err;
  ASSERT_EQ(board.code, 0) << board.err;
  EXPECT_THAT(board.out, HasSubstr("time, s  X F1-F4  Y F1-F4  Z F1-F4  relay  tool LED  RB0  RD1  RD2  RD3  keys"));
  // It waits, lit; then `*` counts; then four pulses.
  EXPECT_THAT(board.out, HasSubstr("0.050000  0000     0000     0000     -      -         -    on   on   on   *\n"));
  EXPECT_THAT(board.out, HasSubstr("0110     0000     0000     -      -         on   on   on   on\n"));
  EXPECT_THAT(board.out, testing::EndsWith("1100     0000     0000     -      -         on   on   on   on\n"));
  const Outcome emergency = sim("first_board --clock 20 --time 0.6 --line reset@0.33");
  EXPECT_THAT(emergency.out, HasSubstr("reset\n"));
  EXPECT_THAT(emergency.out, testing::EndsWith("0000     0000     0000     -      -         -    on   on   on\n"));
}

TEST_F(FollowerCommand, runs_an_uno_and_a_mega_and_writes_traces_and_pictures) {
  const Outcome uno = sim("uno_half_step --clock 100 --axes XY --down Y --time 0.22");
  if (lacks_an_emulator(uno)) GTEST_SKIP() << uno.err;
  ASSERT_EQ(uno.code, 0) << uno.err;
  EXPECT_THAT(uno.out, HasSubstr("0100     1000     0000     -\n"));
  const std::string trace = path("mega.csv");
  const std::string waves = path("mega.vcd");
  const std::string picture = path("mega.svg");
  const Outcome mega = sim("mega_two_on --key '#@0.05' --key 6@0.2:0.3 --line reset@0.35 --time 0.4 -t " + trace +
                           " -t " + waves + " -p " + picture);
  ASSERT_EQ(mega.code, 0) << mega.err;
  EXPECT_THAT(read(trace), testing::StartsWith("t,key_hash,key_6,reset,x_F1,x_F2,x_F3,x_F4,y_F1"));
  EXPECT_THAT(read(waves), HasSubstr("$scope module follower $end"));
  EXPECT_THAT(read(picture), HasSubstr("</svg>"));
}

// What is flashed does the same as the file with the program's names.
TEST_F(FollowerCommand, runs_the_file_that_is_flashed) {
  const std::string images = (std::filesystem::path(PASSO_PROGRAM).parent_path() / "src" / "board" / "chip").string();
  for (const std::string follower : {"first_board", "uno_two_on"}) {
    const std::string run = follower + " --clock 50 --axes XZ --time 0.3";
    const Outcome usual = sim(run);
    if (lacks_an_emulator(usual)) GTEST_SKIP() << usual.err;
    const std::string name = follower == "first_board" ? follower : "follower_" + follower;
    const Outcome flashed = sim(run + " --image " + images + "/" + name + ".hex");
    EXPECT_EQ(flashed.code, 0) << flashed.err;
    EXPECT_EQ(flashed.out, usual.out);
    EXPECT_THAT(flashed.out, HasSubstr("0110     0000     0110"));
    const std::string other = write("other.hex", "this is no program\n");
    const Outcome refused = sim(run + " --image " + other);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, testing::AnyOf(HasSubstr(other + " is not an Intel HEX file: line 1"),
                                            HasSubstr("check that " + other + " is follower firmware")));
  }
}

TEST_F(FollowerCommand, holds_a_key_until_its_last_hold_is_over) {
  const Outcome once = sim("first_board --key '#@0.1' --key 6@0.3:0.5 --time 0.6");
  if (lacks_an_emulator(once)) GTEST_SKIP() << once.err;
  const Outcome twice = sim("first_board --key '#@0.1' --key 6@0.3:0.4 --key 6@0.35:0.5 --time 0.6");
  EXPECT_EQ(once.out, twice.out);
}

// A run's trace changes a direction together with the first step that way; it counts for this step.
constexpr const char* recorded =
    "$version Passo $end\n$timescale 1 us $end\n$var wire 1 ! X_step $end\n"
    "$var wire 1 & X_dir $end\n$var wire 1 # spindle $end\n$enddefinitions $end\n"
    "#0\n$dumpvars 0! 0& 0# $end\n#1000 1! 1#\n#1050 0!\n#2000 1!\n#2050 0!\n"
    "#3000 1! 1&\n#3050 0!\n#4000\n";

TEST_F(FollowerCommand, plays_recorded_signals_and_compares_pulses_and_steps) {
  const std::string waves = write("run.vcd", recorded);
  const Outcome board = sim("first_board --input " + waves);
  if (lacks_an_emulator(board)) GTEST_SKIP() << board.err;
  ASSERT_EQ(board.code, 0) << board.err;
  EXPECT_THAT(board.out, HasSubstr("0011     0000     0000     on     on"));
  EXPECT_THAT(board.out, testing::EndsWith("motor  pulses up       down   steps up       down\n"
                                           "    X          2          1          2          1\n"));
  // The same as steps, from another board's trace.
  const std::string steps = write("run.csv", "t,x,y,z\n0.001,1,0,0\n0.002,1,0,0\n0.003,-1,0,-1\n");
  const Outcome table = sim("pic_half_step --input " + steps + " --time 0.3 --trace " + path("again.csv"));
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("    X          2          1          2          1\n"
                                   "    Z          0          1          0          1\n"));
  // What a follower's trace shows can be played again.
  const Outcome again = sim("first_board --from 0 --input " + path("again.csv"));
  EXPECT_THAT(again.out, HasSubstr("    X          2          1          2          1\n")) << again.err;
}

TEST_F(FollowerCommand, says_which_pulses_are_too_short_and_lengthens_them) {
  const std::string waves = write("fast.vcd",
                                  "$timescale 1 us $end $var wire 1 ! D0 $end $enddefinitions $end\n"
                                  "#0 0! #500 1! #503 0! #611 1! #614 0! #725 1! #728 0! #900 1! #903 0!\n");
  const std::string run = "first_board --signal clock.x=D0 --input " + waves;
  const Outcome lost = sim(run + " -t " + path("lost.csv"));
  if (lacks_an_emulator(lost)) GTEST_SKIP() << lost.err;
  EXPECT_THAT(lost.out, HasSubstr("differ\nThe shortest level of a clock line lasts 3 us."));
  const Outcome seen = sim(run + " --pulse 50 -t " + path("seen.csv"));
  EXPECT_THAT(seen.out, testing::EndsWith("    X          4          0          4          0\n")) << seen.err;
}

TEST_F(FollowerCommand, closes_the_relay_in_the_sense_that_the_image_has) {
  if (const Outcome any = sim("first_board --time 0.01"); lacks_an_emulator(any)) GTEST_SKIP() << any.err;
  const auto relays = [&](const std::string& follower) {
    const std::string trace = path("relay.csv");
    EXPECT_EQ(sim(follower + " --line relay@0.3:0.35 --time 0.4 -t " + trace).code, 0);
    std::string text;
    std::istringstream rows(read(trace));
    std::string row;
    std::getline(rows, row);
    const auto column = std::count(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(row.find("relay_out")), ',');
    while (std::getline(rows, row)) {
      std::istringstream fields(row);
      std::string field;
      for (int i = 0; i <= column; ++i) std::getline(fields, field, ',');
      if (!text.ends_with(field)) text += field;
    }
    return text;
  };
  EXPECT_EQ(relays("first_board"), "010");
  EXPECT_EQ(relays("first_board_copied"), "010");
  EXPECT_EQ(relays("first_board_as_listed"), "0101");
}

TEST_F(FollowerCommand, says_what_it_expected_of_a_recording) {
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = sim("uno_wave " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  const std::string waves = write("run.vcd", recorded);
  refused("--input " + path("nowhere.vcd"), "cannot read " + path("nowhere.vcd"));
  refused("--input " + write("bad.vcd", "$timescale 1 us $end\n$enddefinitions $end\n#1\n?\n"),
          "bad.vcd:4: expected #TIME");
  refused("--input " + write("bad.csv", "t,x\n0.1,7\n"), "bad.csv:2: expected a step, -1, 0 or 1, got '7'");
  refused("--input " + write("other.csv", "t,foo,bar\n0.1,0,1\n"), "expected signals such as X_step and X_dir");
  refused("--input " + write("two.csv", "t,step_x,clock_x\n0.1,0,1\n"), "step_x and clock_x are both the line clock.x");
  refused("--input " + waves + " --signal clock.x=D7", "no such signal; it has X_step, X_dir, spindle");
  refused("--input " + waves + " --signal clock.q=X_step", "expected LINE=NAME");
  refused("--input " + waves + " --from 1 --time 0.5", "the recording would begin at 1 s");
  refused("--input " + waves + " --clock 5", "excludes");
}

TEST_F(FollowerCommand, says_what_it_expected) {
  EXPECT_THAT(sim("uno_wave --key 6@0.1").err, HasSubstr("an Uno has no pins for a keypad"));
  EXPECT_THAT(sim("uno_wave --line button@0.1").err, HasSubstr("an Uno has no pins for a keypad"));
  EXPECT_THAT(sim("first_board --clock 20 --from 5 --time 1").err, HasSubstr("the first pulse would come at 5 s"));
  EXPECT_THAT(sim("first_board --image nowhere.hex").err, HasSubstr("nowhere.hex: there is no such file"));
  EXPECT_EQ(sim("third_board").code, 2);
  EXPECT_THAT(sim("first_board --key 6").err, HasSubstr("expected KEY@FROM"));
  EXPECT_THAT(sim("first_board --line clock.w@1").err, HasSubstr("expected LINE@FROM"));
  EXPECT_THAT(sim("first_board --clock 10 --axes Q").err, HasSubstr("letters of XYZ"));
  EXPECT_THAT(sim("uno_wave --clock 1e6 --time 100").err, HasSubstr("more than 2000000 edges"));
  EXPECT_THAT(sim("uno_wave --trace x.txt").err, HasSubstr("must end with .vcd or .csv"));
}

}  // namespace
