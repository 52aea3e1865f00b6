#include "../jog_keep_alive.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(JogKeepAlive, lasts_from_its_last_renewal) {
  JogKeepAlive lease;
  lease.begin(Seconds(0.5), Seconds(10));
  EXPECT_FALSE(lease.is_over_at(Seconds(10.5)));
  EXPECT_TRUE(lease.is_over_at(Seconds(10.6)));
  lease.renew(Seconds(10.4));
  EXPECT_FALSE(lease.is_over_at(Seconds(10.9)));
  EXPECT_TRUE(lease.is_over_at(Seconds(11)));
}

TEST(JogKeepAlive, never_ends_if_it_has_not_begun) {
  EXPECT_FALSE(JogKeepAlive().is_over_at(Seconds(1e9)));
}

}  // namespace
}  // namespace passo
