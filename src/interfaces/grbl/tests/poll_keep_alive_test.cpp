#include "passo/grbl/poll_keep_alive.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

void ask(PollKeepAlive& lease, double at) {
  lease.on_byte(Seconds(at));
  lease.on_question(Seconds(at));
}

TEST(PollKeepAlive, is_over_when_a_sender_that_asked_is_silent_for_its_pace_and_a_quarter_second) {
  PollKeepAlive lease;
  for (const double at : {10.0, 10.2, 10.4}) ask(lease, at);
  EXPECT_FALSE(lease.is_over(Seconds(10.8)));
  EXPECT_TRUE(lease.is_over(Seconds(10.9)));
  lease.on_byte(Seconds(10.8));
  EXPECT_FALSE(lease.is_over(Seconds(10.9))) << "any byte shows that the sender lives";
  lease.end();
  EXPECT_FALSE(lease.is_over(Seconds(100)));
}

TEST(PollKeepAlive, does_not_exist_for_a_sender_that_hardly_asks) {
  PollKeepAlive lease;
  EXPECT_FALSE(lease.is_over(Seconds(100)));
  ask(lease, 10);
  ask(lease, 12);
  EXPECT_FALSE(lease.is_over(Seconds(100)));
}

}  // namespace
}  // namespace passo
