#include "passo/interpolate/even_speed.hpp"

#include <cmath>
#include <random>

#include "kit/seed.hpp"
#include "walk.hpp"
#include <gtest/gtest.h>

#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/point_comparison_line.hpp"

namespace passo {
namespace {

using test::Place;
constexpr double fixed_one = 4294967296.0;

TEST(EvenSpeed, a_diagonal_pulse_lasts_root_two_times_a_plain_one) {
  // (10, 4): six plain pulses and four diagonal ones.
  const auto durations = PulseDurations<2>::by_roots(1'000'000, {0, 6, 4});
  const double plain = 1'000'000 / (6 + 4 * std::sqrt(2.0));
  EXPECT_NEAR(static_cast<double>(durations.of({1, 0})) / fixed_one, plain, 1e-6);
  EXPECT_NEAR(static_cast<double>(durations.of({3, 0})) / fixed_one, plain * std::sqrt(2.0), 1e-6);
  EXPECT_EQ(durations.of({0, 0}), 0U);
}

TEST(EvenSpeed, three_axes_at_once_last_root_three_times_as_long) {
  const auto durations = PulseDurations<3>::by_roots(60'000, {0, 1, 1, 1});
  const double ratio = static_cast<double>(durations.of({7, 0})) / static_cast<double>(durations.of({2, 0}));
  EXPECT_NEAR(ratio, std::sqrt(3.0), 1e-8);
}

class RandomDurations : public testing::Test {
 protected:
  std::mt19937_64 random_{test::seed()};
  int runs_ = test::runs(2'000);
};

// After each pulse the time is that at which the foot of the tool reaches its place on the ideal line.
template <class Make>
void expect_on_time(std::mt19937_64& random, Make make) {
  std::uniform_int_distribution<std::int32_t> length(-60, 60);
  const std::int32_t d[3] = {length(random), length(random), length(random)};
  const std::uint32_t ticks = 1 + static_cast<std::uint32_t>(random() >> 33);
  const double square =
      static_cast<double>(d[0]) * d[0] + static_cast<double>(d[1]) * d[1] + static_cast<double>(d[2]) * d[2];
  if (square == 0) return;
  auto durations = PulseDurations<3>::exact(ticks, d);
  std::uint64_t time = 0;
  test::walk<3>(make(d), {}, [&](Pulse pulse, const Place<3>& place, const auto&) {
    time += durations.next(pulse);
    double foot = 0;
    for (unsigned a = 0; a < 3; ++a) foot += static_cast<double>(place[a]) * d[a];
    ASSERT_NEAR(static_cast<double>(time), ticks * foot / square, 0.5001);
  });
  EXPECT_EQ(time, ticks);
}

TEST_F(RandomDurations, by_the_exact_rule_the_foot_of_the_tool_moves_at_constant_speed_with_any_method) {
  for (int run = 0; run < runs_ && !HasFailure(); ++run) {
    expect_on_time(random_, [](const auto& d) { return BresenhamLine<3>(d); });
    expect_on_time(random_, [](const auto& d) { return Dda<3>(d); });
  }
}

TEST_F(RandomDurations, by_either_rule_the_sum_is_the_time_of_the_move) {
  for (int run = 0; run < runs_; ++run) {
    std::uniform_int_distribution<std::uint32_t> count(0, 1000);
    const std::uint32_t pulses[4] = {count(random_), count(random_), count(random_), 1 + count(random_)};
    const std::uint32_t ticks = static_cast<std::uint32_t>(random_());
    auto durations = PulseDurations<3>::by_roots(ticks, pulses);
    std::uint64_t time = 0;
    const Pulse kinds[4] = {{0, 0}, {2, 0}, {5, 0}, {7, 0}};
    for (int n = 0; n < 4; ++n) {
      for (std::uint32_t i = 0; i < pulses[n]; ++i) time += durations.next(kinds[n]);
    }
    ASSERT_EQ(time, ticks);
  }
}

TEST(EvenSpeed, holds_for_the_longest_line) {
  constexpr std::int32_t largest = 2'147'483'647;
  const auto exact = PulseDurations<4>::exact(UINT32_MAX, {largest, largest, largest, largest});
  const double each = static_cast<double>(UINT32_MAX) / largest / 4;
  for (std::uint8_t a = 0; a < 4; ++a) {
    EXPECT_NEAR(static_cast<double>(exact.of({axis_bit(a), 0})), each * fixed_one, 0.5001);
  }
  const auto roots = PulseDurations<4>::by_roots(UINT32_MAX, {0, 0, 0, 0, largest});
  EXPECT_NEAR(static_cast<double>(roots.of({15, 0})), 4 * each * fixed_one, 0.5001);
}

}  // namespace
}  // namespace passo
