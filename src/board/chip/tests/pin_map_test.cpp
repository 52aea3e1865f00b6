#include "passo/chip/pin_map.hpp"

#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/chip/uno_windings.hpp"

namespace passo {
namespace {

TEST(PinMap, finds_a_pin_with_two_jobs) {
  PinMap<3> map = uno_cnc_shield;
  EXPECT_TRUE(map.without_conflict());
  map.probe = map.motor[1].step;
  EXPECT_FALSE(map.without_conflict());
  map = uno_cnc_shield;
  map.flood = map.motor[0].enable;
  EXPECT_FALSE(map.without_conflict()) << "enable pins are shared among motors only";
}

TEST(PinMap, finds_what_the_interrupt_cannot_do) {
  PinMap<3> map = uno_cnc_shield;
  EXPECT_TRUE(map.fits_the_interrupt());
  map.motor[2].direction = {'B', 5};
  EXPECT_FALSE(map.fits_the_interrupt()) << "a direction on a port that it does not write";
  map = uno_cnc_shield;
  map.flag_special = 4;
  EXPECT_FALSE(map.fits_the_interrupt()) << "a flag on a step pin";
  map.flag_special = map.flag_stop;
  EXPECT_FALSE(map.fits_the_interrupt()) << "two flags in one bit";
}

TEST(PinMap, finds_windings_that_are_not_all_there_or_have_another_job) {
  PinMap<3> map = uno_windings;
  EXPECT_TRUE(map.drives_windings());
  EXPECT_TRUE(map.without_conflict());
  EXPECT_TRUE(map.fits_the_interrupt());
  map.motor[2].windings[3] = map.motor[0].windings[1];
  EXPECT_FALSE(map.without_conflict()) << "a winding twice";
  map = uno_windings;
  map.probe = map.motor[1].windings[0];
  EXPECT_FALSE(map.without_conflict()) << "a winding and an input";
  map = uno_windings;
  map.motor[1].windings[2] = {};
  EXPECT_FALSE(map.fits_the_interrupt()) << "three windings";
  map = uno_windings;
  map.motor[1].windings[2] = {'C', 4};
  EXPECT_FALSE(map.fits_the_interrupt()) << "a port that it does not write";
  map = uno_windings;
  map.motor[0].step = {'C', 4};
  EXPECT_FALSE(map.fits_the_interrupt()) << "windings and step pins";
  map = uno_windings;
  map.step_ports[2] = 'C';
  EXPECT_FALSE(map.fits_the_interrupt()) << "an output on a port of windings";
}

TEST(PinMap, finds_a_keypad_that_is_not_whole_or_shares_a_pin) {
  PinMap<6> map = mega_ramps;
  EXPECT_TRUE(map.has_whole_keypad(16'000'000));
  map.keypad.columns[1] = map.motor[4].direction;
  EXPECT_FALSE(map.without_conflict());
  map = mega_ramps;
  map.keypad.tool_button = {};
  EXPECT_FALSE(map.has_whole_keypad(16'000'000)) << "no button";
  map = mega_ramps;
  map.keypad.speeds.start_stop = 100;
  EXPECT_FALSE(map.has_whole_keypad(16'000'000)) << "its intervals are longer than a segment has";
  EXPECT_EQ(mega_ramps.inputs_on('L'), 1 << 0 | 1 << 2 | 1 << 4 | 1 << 6) << "the encoder's two, and two rows";
  EXPECT_EQ(mega_ramps.outputs_on('G'), 1 << 1) << "columns float";
}

TEST(PinMap, has_the_bits_of_a_pattern_of_windings) {
  const MotorPins& z = uno_windings.motor[2];  // D2, D3, D12, D13
  EXPECT_EQ(z.winding_bits('D', 0b0110), 1 << 3);
  EXPECT_EQ(z.winding_bits('B', 0b0110), 1 << 4);
  EXPECT_EQ(uno_windings.windings_on('D'), 0xfc);
  EXPECT_EQ(mega_windings.windings_on('K'), 0x0f);
  const PinMap<3> mixed = driven(uno_windings, {DriveMode::wave, DriveMode::two_on, DriveMode::half_step});
  EXPECT_EQ(mixed.motor[2].drive, DriveMode::half_step);
  EXPECT_TRUE(mixed.without_conflict());
}

TEST(PinMap, has_the_pins_of_each_set_of_motors) {
  constexpr MotorPinSets<3> sets = motor_pin_sets(uno_cnc_shield, 'D');
  EXPECT_EQ(sets.steps[0], 0);
  EXPECT_EQ(sets.steps[5], 1 << 2 | 1 << 4);
  EXPECT_EQ(sets.directions[6], 1 << 6 | 1 << 7);
}

TEST(PinMap, sorts_the_pins_of_scattered_motors_by_their_ports) {
  constexpr auto sets = motor_pins_by_port<4>(mega_ramps);
  EXPECT_EQ(mega_ramps.ports(), 4);
  EXPECT_EQ(sets.on[0].steps[0b111111], 1 << 0 | 1 << 6) << "X and Y on port F";
  EXPECT_EQ(sets.on[1].steps[0b000100], 1 << 3) << "Z on port L";
  EXPECT_EQ(sets.on[1].directions[0b100000], 1 << 5) << "the sixth, there too";
  EXPECT_EQ(sets.on[2].directions[0b001000], 1 << 6) << "E0 on port A";
  EXPECT_EQ(sets.on[3].steps[0b010000], 1 << 1) << "E1 on port C";
  EXPECT_EQ(mega_ramps.stops_on('E'), 1 << 4 | 1 << 5);
  EXPECT_EQ(mega_ramps.outputs_on('K'), 1 << 0);
}

}  // namespace
}  // namespace passo
