#include "passo/drive/queue_update_pacing.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(QueueUpdatePacing, without_haste_is_as_the_options_say) {
  const StopRampOptions options;
  const QueueUpdatePacing pace(options);
  EXPECT_FALSE(pace.in_haste());
  EXPECT_EQ(pace.horizon(), options.horizon);
  EXPECT_EQ(pace.refill_at(), options.refill_at);
  EXPECT_EQ(pace.longest_move(), options.longest_move);
}

TEST(QueueUpdatePacing, of_a_probe_move_is_two_answers_ahead) {
  QueueUpdatePacing pace({});
  pace.attend(Attention::probes, Seconds(0.004));
  EXPECT_TRUE(pace.in_haste());
  // Behind a refill an answer takes three times as long.
  EXPECT_NEAR(pace.longest_move().value(), 0.004, 1e-12);
  EXPECT_NEAR(pace.horizon().value(), 2 * 0.012 + 0.004 + made_ahead.value(), 1e-12);
  EXPECT_NEAR((pace.horizon() - pace.refill_at()).value(), 0.004, 1e-12);
}

TEST(QueueUpdatePacing, expects_slower_answers_after_a_late_one_and_forgets_them_slowly) {
  QueueUpdatePacing pace({});
  pace.attend(Attention::probes, Seconds(0.004));
  const Seconds before = pace.horizon();
  EXPECT_FALSE(pace.take_question());
  pace.on_question();
  EXPECT_TRUE(pace.take_question());
  EXPECT_FALSE(pace.judge(Seconds(0.03))) << "more than twice the time expected";
  EXPECT_GT(pace.horizon(), before);
  EXPECT_TRUE(pace.judge(Seconds(0.003)));
  EXPECT_GT(pace.horizon(), before);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(pace.judge(Seconds(0.003)));
  EXPECT_LT(pace.horizon(), before);
}

TEST(QueueUpdatePacing, after_a_thread_grows_refill_by_refill) {
  const StopRampOptions options;
  QueueUpdatePacing pace(options);
  pace.attend(Attention::follows, Seconds(0.004));
  const Seconds following = pace.horizon();
  EXPECT_LT(following, options.horizon);
  pace.attend(Attention::none, Seconds(0.004));
  EXPECT_EQ(pace.horizon(), following);
  for (int i = 0; i < 10; ++i) pace.record_refill();
  EXPECT_EQ(pace.horizon(), options.horizon);
}

}  // namespace
}  // namespace passo
