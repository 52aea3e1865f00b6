#include "passo/kinematics/screw_map.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(ScrewMap, is_exact_at_the_given_places_and_in_proportion_between) {
  const ScrewMap map(0.5, {{.at = -100, .off = 0}, {.at = 0, .off = 0.012}, {.at = 100, .off = -0.004}});
  EXPECT_DOUBLE_EQ(map.nominal(-150, false), -150);
  EXPECT_DOUBLE_EQ(map.nominal(-100, false), -100);
  EXPECT_NEAR(map.nominal(0.012, false), 0, 1e-14);
  EXPECT_DOUBLE_EQ(map.nominal(99.996, false), 100);
  EXPECT_DOUBLE_EQ(map.nominal(200, false), 200.004);
  EXPECT_NEAR(map.nominal(-49.994, false), -50, 1e-12);
}

TEST(ScrewMap, gives_back_the_place_with_the_play_taken_up_either_way) {
  const ScrewMap map(0.15, {{.at = -10, .off = 0.05}, {.at = 10, .off = -0.05}, {.at = 12, .off = -0.04}});
  for (const bool down : {false, true}) {
    for (double place = -15; place < 15; place += 0.25)
      EXPECT_NEAR(map.place(map.nominal(place, down), down), place, 1e-12);
    EXPECT_NEAR(map.nominal(3, false) - map.nominal(3, true), 0.15, 1e-12);
  }
}

TEST(ScrewMap, without_errors_has_only_its_play) {
  const ScrewMap map(0.2);
  EXPECT_EQ(map.nominal(7, false), 7);
  EXPECT_DOUBLE_EQ(map.nominal(7, true), 6.8);
  EXPECT_EQ(map.place(7, false), 7);
}

}  // namespace
}  // namespace passo
