#include "passo/chip/pin_map.hpp"

#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

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
