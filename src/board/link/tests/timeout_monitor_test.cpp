#include "passo/link/timeout_monitor.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr LinkTimeouts lossy{.answer_within = Seconds(0.1), .patience = Seconds(5)};

TEST(TimeoutMonitor, asks_again_after_a_silence_and_gives_up_after_a_long_one) {
  TimeoutMonitor watch(lossy, Seconds(10));
  watch.begin(Seconds(10));
  EXPECT_FALSE(watch.is_to_ask_again(Seconds(10.05), false, false));
  EXPECT_NEAR(watch.until_question(Seconds(10.04)).value(), 0.06, 1e-12);
  EXPECT_TRUE(watch.is_to_ask_again(Seconds(10.1), false, false));
  EXPECT_FALSE(watch.is_to_ask_again(Seconds(10.1), true, false));
  watch.on_asked_again(Seconds(10.1));
  EXPECT_FALSE(watch.is_to_ask_again(Seconds(10.15), false, false));
  EXPECT_EQ(watch.verdict(Seconds(14.9), false), std::nullopt);
  EXPECT_EQ(watch.verdict(Seconds(15.1), false), LinkError::no_answer);
}

TEST(TimeoutMonitor, gives_up_a_peer_that_talks_and_does_nothing) {
  TimeoutMonitor watch(lossy, Seconds(0));
  for (double time = 1; time <= 10; time += 1) {
    watch.on_byte(Seconds(time));
    watch.on_frame(Seconds(time));
    EXPECT_EQ(watch.verdict(Seconds(time), false), std::nullopt) << time;
  }
  EXPECT_EQ(watch.verdict(Seconds(10.5), false), LinkError::no_progress);
  watch.on_progress(Seconds(10));
  EXPECT_EQ(watch.verdict(Seconds(10.5), false), std::nullopt);
}

TEST(TimeoutMonitor, on_a_line_that_loses_nothing_an_endless_wait_in_vain_is_an_error) {
  TimeoutMonitor watch({}, Seconds(0));
  EXPECT_FALSE(watch.may_lose());
  EXPECT_EQ(watch.verdict(Seconds(1e9), false), std::nullopt);
  EXPECT_EQ(watch.verdict(Seconds(1), true), LinkError::no_answer);
  EXPECT_FALSE(watch.is_overdue(Seconds(0), Seconds(1e9)));
}

}  // namespace
}  // namespace passo
