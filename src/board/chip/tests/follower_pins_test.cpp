#include "passo/chip/follower_pins.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/pico_pins.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

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

// The names that are printed on the boards, of the pins that this needs.
std::string uno_name(Pin pin) {
  const std::string bit(1, static_cast<char>('0' + pin.bit));
  return pin.port == 'D' ? "D" + bit : pin.port == 'C' ? "A" + bit : "?";
}
std::string mega_name(Pin pin) {
  if (pin.port == 'F') return "A" + std::to_string(pin.bit);
  if (pin.port == 'L') return "D" + std::to_string(49 - pin.bit);
  return pin.port == 'B' && pin.bit == 5 ? "D11" : "?";
}
std::string pico_name(std::uint8_t gpio) {
  return "GP" + std::to_string(gpio);
}

// docs/follower.md wires boards with the firmware `motion` to the first board, which has a DB25 connector. Its data
// bits D0 to D7 are the pins 2 to 9.
TEST(FollowerPins, are_where_the_manual_connects_the_boards_that_drive_the_first_board) {
  std::ifstream in(PASSO_SOURCE_DIR "/docs/follower.md");
  const std::string manual{std::istreambuf_iterator<char>(in), {}};
  const auto expect_row = [&](const std::string& signal, int bit, const std::string& pic, const std::string& pico,
                              Pin uno, Pin mega) {
    const std::string row = "| " + signal + " | " + std::to_string(bit + 2) + ", D" + std::to_string(bit) + " | " +
                            pic + " | " + pico + " | " + uno_name(uno) + " | " + mega_name(mega) + " |\n";
    EXPECT_NE(manual.find(row), std::string::npos) << row;
  };
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "XYZ"[axis]);
    const PicoMotor& pico = pico_bare.motor[axis];
    const MotorPins& uno = uno_cnc_shield.motor[axis];
    const MotorPins& mega = mega_ramps.motor[axis];
    expect_row("clock " + letter, axis, "RA" + std::to_string(axis), pico_name(pico.step), uno.step, mega.step);
    expect_row("direction " + letter, axis + 3, "RA" + std::to_string(axis + 3), pico_name(pico.direction),
               uno.direction, mega.direction);
  }
  expect_row("relay's line", 6, "RE0", pico_name(pico_bare.flood), uno_cnc_shield.flood, mega_ramps.spindle_relay);
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
