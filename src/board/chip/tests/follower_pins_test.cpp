#include "passo/chip/follower_pins.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(FollowerPins, refuse_two_jobs_for_a_pin) {
  FollowerPins pins = mega_follower;
  EXPECT_TRUE(pins.without_conflict());
  pins.tool_button = pins.rows[2];
  EXPECT_FALSE(pins.without_conflict());
  pins = mega_follower;
  pins.windings[1][3] = pins.relay;
  EXPECT_FALSE(pins.without_conflict());
  pins = mega_follower;
  pins.relay_line = {pins.lines, 5};
  EXPECT_FALSE(pins.without_conflict()) << "direction of Z";
  pins.relay_line = {pins.lines, 6};
  EXPECT_TRUE(pins.without_conflict()) << "the lines are six";
  pins.relay_indicator = {};
  pins.manual_indicator = {};
  EXPECT_TRUE(pins.without_conflict()) << "what is not there is nowhere";
}

TEST(FollowerPins, refuse_a_keypad_on_two_ports) {
  FollowerPins pins = mega_follower;
  EXPECT_TRUE(pins.keypad_on_one_port());
  pins.columns[1] = {'K', 0};
  EXPECT_FALSE(pins.keypad_on_one_port());
}

// Addresses from the register summaries of the data sheets.
TEST(Pin, knows_where_the_registers_of_its_port_are) {
  EXPECT_EQ(port_registers('B'), 0x23);
  EXPECT_EQ(port_registers('C'), 0x26);
  EXPECT_EQ(port_registers('D'), 0x29);
  EXPECT_EQ(port_registers('A'), 0x20);
  EXPECT_EQ(port_registers('G'), 0x32);
  EXPECT_EQ(port_registers('H'), 0x100);
  EXPECT_EQ(port_registers('J'), 0x103);
  EXPECT_EQ(port_registers('K'), 0x106);
  EXPECT_EQ(port_registers('L'), 0x109);
}

}  // namespace
}  // namespace passo
