#include "passo/drive/holds.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(HoldReasons, each_is_added_and_removed_by_itself) {
  for (int i = 0; i < hold_reason_count; ++i) {
    const auto reason = static_cast<HoldReason>(i);
    HoldReasons all;
    for (int k = 0; k < hold_reason_count; ++k) all.add(static_cast<HoldReason>(k));
    all.remove(reason);
    for (int k = 0; k < hold_reason_count; ++k) EXPECT_EQ(all.has(static_cast<HoldReason>(k)), k != i);
    HoldReasons one;
    one.set(reason, true);
    EXPECT_EQ(one, HoldReasons{reason});
    one.set(reason, false);
    EXPECT_FALSE(one.any());
  }
}

TEST(HoldReasons, a_reason_that_is_there_twice_is_there_once) {
  HoldReasons holds{HoldReason::door, HoldReason::door};
  holds.remove(HoldReason::door);
  EXPECT_FALSE(holds.any());
}

TEST(HoldReasons, tell_whether_they_have_any_of_others) {
  const HoldReasons holds{HoldReason::door, HoldReason::zero_feed};
  EXPECT_TRUE(holds.any_of(heeded_holds));
  EXPECT_TRUE(holds.any_of(lasting_holds));
  EXPECT_FALSE(holds.any_of(sure_holds));
  EXPECT_FALSE(HoldReasons().any_of(holds));
}

// With a reason that the planner brakes for, or that lasts, the machine rests; no reason is without effect.
TEST(HoldReasons, every_reason_brakes_lasts_or_is_of_the_board) {
  for (int i = 0; i < hold_reason_count; ++i) {
    const HoldReasons one{static_cast<HoldReason>(i)};
    const bool of_the_board = one.has(HoldReason::line_lost);
    EXPECT_NE(of_the_board, one.any_of(heeded_holds) || one.any_of(sure_holds) || one.any_of(lasting_holds)) << i;
  }
}

}  // namespace
}  // namespace passo
