#include "passo/grbl/pending_response.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(PendingResponse, waits_for_one_thing) {
  PendingResponse due;
  EXPECT_FALSE(due.is_due());
  due.wait_for_probe();
  EXPECT_TRUE(due.waits_for_probe());
  due.wait_for_homing(7);
  EXPECT_FALSE(due.waits_for_probe());
  EXPECT_TRUE(due.waits_for_homing());
  EXPECT_TRUE(due.is_due());
  EXPECT_TRUE(due.call_off());
  EXPECT_FALSE(due.is_due());
  EXPECT_FALSE(due.call_off());
}

TEST(PendingResponse, is_due_until_its_own_homing_has_ended) {
  PendingResponse due;
  EXPECT_FALSE(due.take_homing(7));
  due.wait_for_homing(7);
  EXPECT_FALSE(due.take_homing(6));
  EXPECT_TRUE(due.waits_for_homing());
  EXPECT_TRUE(due.take_homing(7));
  EXPECT_FALSE(due.is_due());
}

TEST(PendingResponse, goes_on_at_rest_with_what_comes_next_which_may_wait_again) {
  PendingResponse due;
  EXPECT_FALSE(due.take_rest());
  due.wait_for_rest([&due] { due.wait_for_homing(3); });
  EXPECT_TRUE(due.is_due());
  const auto next = due.take_rest();
  EXPECT_FALSE(due.is_due());
  next();
  EXPECT_TRUE(due.take_homing(3));
  due.wait_for_probe();
  EXPECT_FALSE(due.take_rest());
  EXPECT_TRUE(due.waits_for_probe());
}

}  // namespace
}  // namespace passo
