#include "passo/drive/spindle_run_up.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(SpindleRunUp, ends_when_a_turn_takes_as_long_as_ordered) {
  SpindleRunUp run_up;
  run_up.begin(600);  // 0.1 s a turn
  run_up.read({.time = Seconds(0.3), .turns = 1});
  EXPECT_FALSE(run_up.at_speed());
  run_up.read({.time = Seconds(0.5), .turns = 2});
  EXPECT_FALSE(run_up.at_speed());
  run_up.read({.time = Seconds(0.605), .turns = 3});
  EXPECT_TRUE(run_up.at_speed());
}

TEST(SpindleRunUp, ends_when_a_spindle_of_another_speed_has_become_steady) {
  SpindleRunUp run_up;
  run_up.begin(600);
  run_up.read({.time = Seconds(0.3), .turns = -1});
  run_up.read({.time = Seconds(0.5), .turns = -2});
  EXPECT_FALSE(run_up.at_speed());
  run_up.read({.time = Seconds(0.702), .turns = -3});
  EXPECT_TRUE(run_up.at_speed());
}

TEST(SpindleRunUp, looks_at_whole_turns_only) {
  SpindleRunUp run_up;
  run_up.begin(600);
  run_up.read({.time = Seconds(0.05), .turns = 0.5});
  run_up.read({.time = Seconds(0.099), .turns = 0.99});
  EXPECT_FALSE(run_up.at_speed());
  run_up.read({.time = Seconds(0.1), .turns = 1});
  EXPECT_TRUE(run_up.at_speed());
}

TEST(SpindleRunUp, keeps_its_answer_until_it_begins_anew) {
  SpindleRunUp run_up;
  run_up.begin(600);
  run_up.read({.time = Seconds(0.1), .turns = 1});
  run_up.read({.time = Seconds(1), .turns = 2});
  EXPECT_TRUE(run_up.at_speed());
  run_up.begin(600);
  EXPECT_FALSE(run_up.at_speed());
}

TEST(SpindleRunUp, ends_at_last_with_a_spindle_that_never_becomes_steady) {
  SpindleRunUp run_up;
  run_up.begin(600);
  double time = 0;
  int turns = 0;
  for (; turns < 2000 && !run_up.at_speed(); ++turns) {
    time += turns % 2 == 0 ? 0.3 : 0.5;
    run_up.read({.time = Seconds(time), .turns = turns + 1.0});
  }
  EXPECT_EQ(turns, 1000);
}

}  // namespace
}  // namespace passo
