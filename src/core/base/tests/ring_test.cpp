#include "passo/base/ring.hpp"

namespace passo {
namespace {

TEST(Ring, gives_back_in_order_what_was_put_in_across_the_wrap) {
  Ring<int, 4> ring;
  int expected = 0;
  for (int i = 0; i < 100; ++i) {
    ring.push(i);
    if (i % 3 != 0 || ring.full()) {
      EXPECT_EQ(ring.front(), expected++);
      ring.pop();
    }
  }
  EXPECT_EQ(ring.size(), static_cast<size_t>(100 - expected));
}

TEST(Ring, knows_when_it_is_full_and_when_it_is_empty) {
  Ring<int, 2> ring;
  EXPECT_TRUE(ring.empty());
  ring.push(1);
  ring.push(2);
  EXPECT_TRUE(ring.full());
  ring.clear();
  EXPECT_TRUE(ring.empty());
}

}  // namespace
}  // namespace passo
