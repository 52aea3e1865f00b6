#include "passo/drive/pulled_items.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

const LinkItem segment = BoardSegment{.events = 1, .interval = 1U << 16};

TEST(PulledItems, end_only_where_a_tail_was_found) {
  PulledItems items;
  EXPECT_TRUE(items.may_end());
  items.add(segment, Seconds(0.001), {});
  EXPECT_FALSE(items.may_end());
  items.last().tail.emplace();
  EXPECT_TRUE(items.may_end());
}

TEST(PulledItems, are_far_from_the_last_tail_by_time_or_by_number) {
  PulledItems items;
  items.add(segment, Seconds(0.0001), {});
  items.add(segment, Seconds(0.0001), {});
  EXPECT_FALSE(items.is_far_from_last_tail());
  items.add(segment, Seconds(0.0001), {});
  EXPECT_TRUE(items.is_far_from_last_tail());
  items.last().tail.emplace();
  EXPECT_FALSE(items.is_far_from_last_tail());
  items.add(segment, Seconds(0.003), {});
  EXPECT_TRUE(items.is_far_from_last_tail());
}

TEST(PulledItems, lose_the_first_ones_when_they_are_sent) {
  PulledItems items;
  items.add(segment, Seconds(1), {.on_path = 5, .of_axis = 1});
  items.add(segment, Seconds(2), {.on_path = 3, .of_axis = 2});
  EXPECT_EQ(items.highest_speed().on_path, 5);
  EXPECT_EQ(items.highest_speed().of_axis, 2);
  items.drop_first(1);
  EXPECT_EQ(items.size(), 1U);
  EXPECT_EQ(items.time(), Seconds(2));
  EXPECT_EQ(items.highest_speed().on_path, 3);
}

TEST(PulledItems, know_how_the_path_goes_on) {
  PulledItems items;
  EXPECT_TRUE(items.goes_on());
  items.record_hold();
  EXPECT_FALSE(items.goes_on());
  EXPECT_TRUE(items.take_hold());
  EXPECT_FALSE(items.take_hold());
  items.record_action({.kind = Action::Kind::await_line});
  EXPECT_FALSE(items.goes_on());
  EXPECT_EQ(items.take_action().kind, Action::Kind::await_line);
  items.record_end();
  EXPECT_TRUE(items.ends());
  items.clear();
  EXPECT_TRUE(items.goes_on());
}

}  // namespace
}  // namespace passo
