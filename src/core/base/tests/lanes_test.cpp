#include "passo/base/lanes.hpp"

#include <array>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr std::array<double, 4> a = {1.5, -2, 3, 0.25};
constexpr std::array<double, 4> b = {0.1, 7, -5, 3};

TEST(FourLanes, give_what_single_doubles_give) {
  const auto left = FourLanes::load(a.data());
  const auto right = FourLanes::load(b.data());
  const auto expect = [](FourLanes lanes, auto single) {
    std::array<double, 4> result{};
    lanes.store(result.data());
    for (std::size_t i = 0; i < result.size(); ++i) EXPECT_EQ(result[i], single(a[i], b[i]));
  };
  expect(left + right, [](double x, double y) { return x + y; });
  expect(left - right, [](double x, double y) { return x - y; });
  expect(left * right, [](double x, double y) { return x * y; });
  expect(left * 3.3, [](double x, double) { return x * 3.3; });
  EXPECT_EQ(left.sum(), (a[0] + a[2]) + (a[1] + a[3]));
}

TEST(FourLanes, tell_whether_any_lane_is_above_both) {
  const auto left = FourLanes::load(a.data());
  const std::array<double, 4> lower = {1.5, -3, 3, 1};
  EXPECT_TRUE(any_above(left, FourLanes::load(lower.data()), FourLanes::load(lower.data())));
  EXPECT_FALSE(any_above(left, FourLanes::load(lower.data()), left));
}

TEST(TwoLanes, divide_and_compare) {
  const auto left = TwoLanes::load(a.data());
  const TwoLanes right(0.1, 7);
  EXPECT_EQ((left / right).first(), 1.5 / 0.1);
  EXPECT_EQ((left / right).second(), -2.0 / 7);
  EXPECT_EQ(larger(left, right).first(), 1.5);
  EXPECT_EQ(larger(left, right).second(), 7);
  EXPECT_EQ(larger(left, right).largest(), 7);
}

}  // namespace
}  // namespace passo
