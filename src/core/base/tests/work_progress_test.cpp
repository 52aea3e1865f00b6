// Progress: what a computation reports about its stages, and what another process hears of it.
#include "passo/base/work_progress.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "passo/base/percent_line.hpp"

namespace passo {
namespace {

TEST(WorkProgress, without_a_listener_does_nothing) {
  const WorkProgress nobody;
  nobody.update(0.5);
  nobody.part(0.2, 0.4).stage(1, 2).update(1);
}

TEST(WorkProgress, maps_the_shares_of_nested_parts_to_the_whole) {
  std::vector<double> heard;
  const WorkProgress whole([&](double share) { heard.push_back(share); });
  whole.part(0, 0.5).update(0.5);
  whole.part(0.5, 1).part(0, 0.5).update(0.5);
  whole.stage(3, 4).update(0);
  whole.update(1);
  ASSERT_EQ(heard.size(), 4U);
  EXPECT_DOUBLE_EQ(heard[0], 0.25);
  EXPECT_DOUBLE_EQ(heard[1], 0.625);
  EXPECT_DOUBLE_EQ(heard[2], 0.75);
  EXPECT_DOUBLE_EQ(heard[3], 1);
}

TEST(WorkProgress, only_grows_and_stays_within_its_part) {
  std::vector<double> heard;
  const WorkProgress whole([&](double share) { heard.push_back(share); });
  whole.update(0.5);
  whole.update(0.5);
  whole.update(0.3);
  whole.part(0, 0.4).update(1);
  whole.part(0.6, 0.7).update(-5);
  whole.part(0.6, 0.7).update(7);
  whole.update(std::numeric_limits<double>::quiet_NaN());
  ASSERT_EQ(heard.size(), 3U);
  whole.stage(0, 0).update(2);
  ASSERT_EQ(heard.size(), 4U);
  EXPECT_DOUBLE_EQ(heard[0], 0.5);
  EXPECT_DOUBLE_EQ(heard[1], 0.6);
  EXPECT_DOUBLE_EQ(heard[2], 0.7);
  EXPECT_DOUBLE_EQ(heard[3], 1);
}

TEST(PercentLine, sends_each_whole_per_cent_once) {
  PercentSender sender;
  std::vector<std::uint8_t> sent;
  constexpr int updates = 100'000;
  for (int i = 0; i <= updates; ++i) {
    if (const auto message = sender.next(static_cast<double>(i) / updates)) sent.push_back(*message);
  }
  ASSERT_EQ(sent.size(), 101U);
  EXPECT_EQ(sent.front(), 0);
  EXPECT_EQ(sent.back(), 100);
  EXPECT_FALSE(sender.next(0.4)) << "never back";
  EXPECT_FALSE(sender.next(5)) << "100 was sent";
}

TEST(PercentLine, rounds_down_and_survives_what_is_no_number) {
  PercentSender sender;
  EXPECT_EQ(sender.next(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_FALSE(sender.next(-1));
  EXPECT_EQ(sender.next(0.999), 99);
  EXPECT_EQ(sender.next(std::numeric_limits<double>::infinity()), 100);
}

TEST(PercentLine, ignores_what_is_no_message_and_never_goes_back) {
  PercentReceiver receiver;
  EXPECT_EQ(receiver.percent(), 0);
  const std::vector<std::uint8_t> messages = {3, 12, 255, 101, 7};
  receiver.take(messages);
  EXPECT_EQ(receiver.percent(), 12);
  receiver.take({});
  receiver.take(std::vector<std::uint8_t>{100});
  EXPECT_EQ(receiver.percent(), 100);
}

}  // namespace
}  // namespace passo
