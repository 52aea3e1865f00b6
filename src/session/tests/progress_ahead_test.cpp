// How much of a program is executed, where it is planned ahead, and planned anew after a hold.
#include "../progress_ahead.hpp"

namespace passo {
namespace {

TEST(ProgressAhead, follows_what_is_executed_not_what_is_planned) {
  ProgressAhead ahead;
  // With its ramps a motion takes longer than its nominal time.
  ahead.plan(Seconds(2), Seconds(10), Seconds(14), Seconds(10));
  ahead.plan(Seconds(1), Seconds(14), Seconds(15), Seconds(10));
  EXPECT_EQ(ahead.at(Seconds(10)), Seconds(0));
  EXPECT_EQ(ahead.at(Seconds(12)), Seconds(1));
  EXPECT_EQ(ahead.at(Seconds(14.5)), Seconds(2.5));
  EXPECT_EQ(ahead.at(Seconds(99)), Seconds(3));
}

TEST(ProgressAhead, counts_once_what_is_planned_anew) {
  ProgressAhead ahead;
  ahead.plan(Seconds(4), Seconds(0), Seconds(4), Seconds(0));
  ahead.plan(Seconds(4), Seconds(4), Seconds(8), Seconds(0));
  // A hold at 1 s: it brakes, rests, and goes on with the three quarters that are left.
  ahead.plan(Seconds(0.5), Seconds(1), Seconds(2), Seconds(0.5));
  EXPECT_EQ(ahead.at(Seconds(5)), Seconds(1.5));
  ahead.plan(Seconds(2.5), Seconds(6), Seconds(9), Seconds(5));
  ahead.plan(Seconds(4), Seconds(9), Seconds(13), Seconds(5));
  EXPECT_EQ(ahead.at(Seconds(7.5)), Seconds(2.75));
  EXPECT_EQ(ahead.at(Seconds(13)), Seconds(8));
}

}  // namespace
}  // namespace passo
