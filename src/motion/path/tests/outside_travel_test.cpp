#include "passo/path/outside_travel.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(OutsideTravel, reports_an_excursion_of_many_moves_once) {
  OutsideTravel outside;
  EXPECT_TRUE(outside.leaves(Axis::x, TravelEnd::high, true));
  EXPECT_FALSE(outside.leaves(Axis::x, TravelEnd::high, true));
  EXPECT_FALSE(outside.leaves(Axis::x, TravelEnd::high, false));  // the way back
  EXPECT_TRUE(outside.leaves(Axis::x, TravelEnd::high, true));
}

TEST(OutsideTravel, is_over_after_a_move_within_the_travel) {
  OutsideTravel outside;
  EXPECT_TRUE(outside.leaves(Axis::z, TravelEnd::low, true));
  outside.stays_within(Axis::z, TravelEnd::low);
  EXPECT_TRUE(outside.leaves(Axis::z, TravelEnd::low, true));
}

// An arc that bulges out of the travel and ends within it.
TEST(OutsideTravel, is_new_each_time_if_the_move_ends_within_the_travel) {
  OutsideTravel outside;
  EXPECT_TRUE(outside.leaves(Axis::y, TravelEnd::high, false));
  EXPECT_TRUE(outside.leaves(Axis::y, TravelEnd::high, false));
}

TEST(OutsideTravel, tells_axes_and_ends_apart) {
  OutsideTravel outside;
  EXPECT_TRUE(outside.leaves(Axis::x, TravelEnd::high, true));
  EXPECT_TRUE(outside.leaves(Axis::x, TravelEnd::low, true));
  EXPECT_TRUE(outside.leaves(Axis::y, TravelEnd::high, true));
  outside.stays_within(Axis::x, TravelEnd::low);
  EXPECT_FALSE(outside.leaves(Axis::x, TravelEnd::high, true));
}

}  // namespace
}  // namespace passo
