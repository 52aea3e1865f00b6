#include "passo/lab/board_play.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using ::testing::HasSubstr;

constexpr std::uint16_t key(char name) {
  return static_cast<std::uint16_t>(1U << key_named(name));
}

class BoardPlayed : public testing::Test {
 protected:
  void press(char name, int milliseconds = 60) {
    board.set_keys(key(name));
    board.run(milliseconds * 1000);
    board.set_keys(0);
    board.run(60'000);
  }

  BoardPlay board;
};

TEST_F(BoardPlayed, waits_for_a_mode_key) {
  board.set_clock(1, 25'000, -1);
  board.run(500'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[0,0,0],"rotors":[0,0,0])"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("mode":"waiting","leds":[0,1,1,1])"));
  press('*');
  EXPECT_THAT(board.answer(), HasSubstr(R"("mode":"automatic","leds":[1,1,1,1])"));
}

// 20 Hz, as in its day: ten pulses in half a second. Two windings on, in the order F1 F2, F2 F3, F3 F4, F4 F1.
TEST_F(BoardPlayed, follows_a_clock_of_twenty_hertz_for_as_many_pulses_as_asked) {
  press('*');
  board.set_clock(0b011, 25'000, 10);
  board.run(26'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[6,6,0],"rotors":[1,1,0])"));
  board.run(474'000);
  board.run(500'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[10,10,0])"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("clock_runs":false,"pulses":10)"));
  board.set_lines(0b001'000);  // X down
  board.run(1000);
  board.set_clock(0b001, 2'000, 3);
  board.run(50'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[7,10,0])"));
}

// A line that is inverted in the computer is high between pulses, and steps at the end of each pulse.
TEST_F(BoardPlayed, follows_an_inverted_clock) {
  board.set_lines(0b010);
  press('*');
  board.set_clock(0b010, 2'000, 4, 0b010);
  board.run(100'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":2,"clock_runs":false,"pulses":4)"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[0,4,0])"));
  board.set_clock(0b010, 50'000, -1, 0b010);
  board.run(60'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":0,"clock_runs":true,"pulses":5)"));
  board.set_clock(0, 50'000, -1, 0);
  board.run(1'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":2,"clock_runs":false,"pulses":5)"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[0,5,0])"));
}

// X has no pin: the computer counts its pulses, and only Y turns.
TEST_F(BoardPlayed, moves_no_motor_whose_clock_has_no_wire) {
  press('*');
  board.set_clock(0b011, 2'000, 5, 0, 0b110);
  board.run(100'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":0,"clock_runs":false,"pulses":5)"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[0,5,0])"));
  board.set_clock(0b001, 2'000, 3, 0, 0b110);
  board.run(3'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":0,"clock_runs":true,"pulses":6)"));
  board.run(100'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"({"lines":0,"clock_runs":false,"pulses":8)"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("rotors":[0,5,0])"));
}

TEST_F(BoardPlayed, raises_z_backwards_with_key_5_every_20_ms) {
  press('#');
  EXPECT_THAT(board.answer(), HasSubstr(R"("mode":"manual","leds":[0,0,0,0])"));
  board.set_keys(key('5'));
  board.run(30'000);
  // F1 to F4 of Z: 1001, which is a step back.
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[0,0,9],"rotors":[0,0,-1])"));
  board.run(20'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[0,0,12],"rotors":[0,0,-2])"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("leds":[0,1,0,0])"));
  board.run(20'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[0,0,6],"rotors":[0,0,-3])"));
}

TEST_F(BoardPlayed, lights_the_relay_s_led_as_manual_mode_begins) {
  press('#');
  EXPECT_THAT(board.answer(), HasSubstr(R"("relay":false,"relay_led":true)"));
  board.set_button(true);
  board.run(40'000);
  board.set_button(false);
  board.run(40'000);
  board.set_button(true);
  board.run(40'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("relay":false,"relay_led":false)"));
}

TEST_F(BoardPlayed, has_a_relay_that_the_line_and_the_button_close) {
  press('*');
  board.set_lines(BoardPins::tool_line);
  board.run(10'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("relay":true)"));
  press('#');
  board.set_button(true);
  board.run(40'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("relay":false)"));
}

// The rotors stay where they are; the counters do not, so the next step may be one of two.
TEST_F(BoardPlayed, loses_its_place_by_the_emergency_button) {
  press('*');
  board.set_clock(0b001, 2'000, 3);
  board.run(50'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[9,0,0],"rotors":[3,0,0])"));
  board.reset(true);
  board.run(50'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[0,0,0],"rotors":[3,0,0])"));
  EXPECT_THAT(board.answer(), HasSubstr(R"("mode":"reset","leds":[0,0,0,0])"));
  board.reset(false);
  press('*');
  board.set_clock(0b001, 2'000, 1);
  board.run(50'000);
  EXPECT_THAT(board.answer(), HasSubstr(R"("patterns":[6,0,0],"rotors":[5,0,0])"));
}

}  // namespace
}  // namespace passo
