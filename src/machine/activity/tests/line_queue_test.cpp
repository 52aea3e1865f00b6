#include "passo/activity/line_queue.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

PathItem dwell(double seconds) {
  return Action{.kind = Action::Kind::dwell, .dwell = Seconds(seconds)};
}

LineQueue queue_of(std::size_t items, double seconds) {
  LineQueue queue{MotionLimits()};
  for (std::size_t i = 0; i < items; ++i) queue.push(dwell(seconds));
  return queue;
}

TEST(LineQueue, lasts_as_long_as_its_items) {
  LineQueue queue{MotionLimits()};
  for (const double seconds : {1.0, 2.0, 4.0}) queue.push(dwell(seconds));
  EXPECT_EQ(queue.time(), Seconds(7));
  EXPECT_EQ(std::get<Action>(queue.pull()).dwell, Seconds(1));
  EXPECT_EQ(queue.time(), Seconds(6));
  queue.cut_to(1);
  EXPECT_EQ(queue.time(), Seconds(2));
  queue.clear();
  EXPECT_EQ(queue.time(), Seconds(0));
  EXPECT_TRUE(queue.empty());
}

TEST(LineQueue, has_room_for_many_short_items_and_few_long_ones) {
  EXPECT_TRUE(queue_of(LineQueue::enough_items - 1, 1).has_room());
  EXPECT_FALSE(queue_of(LineQueue::enough_items, 1).has_room());
  EXPECT_TRUE(queue_of(LineQueue::enough_items, 0.001).has_room());
  EXPECT_FALSE(queue_of(LineQueue::most_items, 0.001).has_room());
}

TEST(LineQueue, begins_after_a_quiet_time_or_when_it_is_full) {
  LineQueue queue = queue_of(1, 1);
  queue.add_line(0, Seconds(5));
  EXPECT_FALSE(queue.is_to_begin(Seconds(5.02)));
  EXPECT_TRUE(queue.is_to_begin(Seconds(5.03)));
  LineQueue full = queue_of(LineQueue::enough_items, 1);
  full.add_line(0, Seconds(5));
  EXPECT_TRUE(full.is_to_begin(Seconds(5)));
  EXPECT_FALSE(queue_of(0, 1).is_to_begin(Seconds(100)));
}

TEST(LineQueue, lets_the_first_line_wait_no_longer_than_half_a_second) {
  LineQueue queue{MotionLimits()};
  for (int i = 0; i < 26; ++i) {
    const std::size_t before = queue.size();
    queue.push(dwell(0.001));
    queue.add_line(before, Seconds(0.02 * i));
    EXPECT_EQ(queue.is_to_begin(Seconds(0.02 * i)), 0.02 * i >= 0.5) << i;
  }
}

TEST(LineQueue, expects_more_while_lines_come) {
  LineQueue queue = queue_of(1, 1);
  queue.add_line(0, Seconds(5));
  EXPECT_TRUE(queue.expects_more(Seconds(5.02)));
  EXPECT_FALSE(queue.expects_more(Seconds(5.03)));
  LineQueue full = queue_of(LineQueue::enough_items, 0.001);
  full.add_line(0, Seconds(5));
  EXPECT_FALSE(full.expects_more(Seconds(5)));
}

}  // namespace
}  // namespace passo
