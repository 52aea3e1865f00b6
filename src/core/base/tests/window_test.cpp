#include "passo/base/window.hpp"

namespace passo {
namespace {

TEST(Window, keeps_its_numbers_while_it_grows_and_moves_on) {
  Window<std::uint64_t> window;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    window.append() = number * number;
    if (number % 3 == 0) window.drop_front();  // two of three are kept, so the window grows several times
    ASSERT_EQ(window.end(), number + 1);
    ASSERT_EQ(window.first(), number / 3 + 1);
    for (std::uint64_t kept = window.first(); kept < window.end(); ++kept) ASSERT_EQ(window[kept], kept * kept);
    if (window.empty()) continue;
    ASSERT_EQ(window.front(), window.first() * window.first());
    ASSERT_EQ(window.back(), number * number);
  }
}

TEST(Window, drops_no_more_than_it_has) {
  Window<int> window;
  window.append() = 1;
  window.append() = 2;
  window.drop_before(1);
  EXPECT_EQ(window.front(), 2);
  window.drop_before(0);
  EXPECT_EQ(window.first(), 1U);
  window.drop_before(7);
  EXPECT_TRUE(window.empty());
  EXPECT_EQ(window.end(), 2U);
  window.append() = 3;
  EXPECT_EQ(window.front(), 3);
  window.clear();
  EXPECT_TRUE(window.empty());
}

}  // namespace
}  // namespace passo
