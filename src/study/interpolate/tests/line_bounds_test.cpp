// Lines at the ends of their range, 2³¹−1 steps. Whole moves would take minutes, so only their start and end are
// compared with the definition. The slow test plays them in full.
#include <cmath>
#include <random>

#include "kit/seed.hpp"
#include "walk.hpp"
#include <gtest/gtest.h>

#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"

namespace passo {
namespace {

using test::Place;
constexpr std::int32_t largest = 2'147'483'647;

// The distance of the shorter axis from the line, at the place of the longer one.
long double axis_error(const Place<2>& place, const std::int32_t (&end)[2]) {
  const bool x_longer = std::abs(static_cast<std::int64_t>(end[0])) >= std::abs(static_cast<std::int64_t>(end[1]));
  const auto longer = static_cast<long double>(x_longer ? end[0] : end[1]);
  const auto shorter = static_cast<long double>(x_longer ? end[1] : end[0]);
  const auto along = static_cast<long double>(place[x_longer ? 0 : 1]);
  const auto across = static_cast<long double>(place[x_longer ? 1 : 0]);
  return std::abs(across - shorter * (along / longer));
}
long double distance(const Place<2>& place, const std::int32_t (&end)[2]) {
  const auto ex = static_cast<long double>(end[0]);
  const auto ey = static_cast<long double>(end[1]);
  const auto cross = ex * static_cast<long double>(place[1]) - ey * static_cast<long double>(place[0]);
  return std::abs(cross) / std::hypot(ex, ey);
}

class RandomLineErrors : public testing::Test {
 protected:
  // The largest error that `measure` finds after any pulse of the method, on many random lines. Checks that all end
  // exactly.
  template <class Make, class Measure>
  long double worst(Make make, Measure measure) {
    long double most = 0;
    for (int run = 0; run < runs_ && !HasFailure(); ++run) {
      const std::int32_t size = 1 << (run % 8);
      std::uniform_int_distribution<std::int32_t> length(-size, size);
      const std::int32_t d[2] = {length(random_), length(random_)};
      if (d[0] == 0 && d[1] == 0) continue;
      const Place<2> end = test::walk<2>(
          make(d), {}, [&](Pulse, const Place<2>& place, const auto&) { most = std::max(most, measure(place, d)); });
      EXPECT_EQ(end, (Place<2>{d[0], d[1]}));
    }
    return most;
  }
  std::mt19937_64 random_{test::seed()};
  int runs_ = test::runs(20'000);
};

TEST_F(RandomLineErrors, master_and_slaves_keep_within_half_a_step) {
  EXPECT_LE(worst([](auto& d) { return BresenhamLine<2>(d); }, axis_error), 0.5L + 1e-12L);
}
TEST_F(RandomLineErrors, dda_keeps_within_one_step_and_half_loaded_within_three_quarters) {
  EXPECT_LE(worst([](auto& d) { return Dda<2>(d); }, distance), 1.0L);
  EXPECT_LE(worst([](auto& d) { return Dda<2>(d, DdaLoad::half); }, distance), 0.75L);
}
TEST_F(RandomLineErrors, slope_recalculated_keeps_below_one_step) {
  EXPECT_LT(worst([](auto& d) { return SlopeRecalculated<>(d); }, axis_error), 1.0L);
}
TEST_F(RandomLineErrors, point_comparison_keeps_within_one_step) {
  EXPECT_LE(worst([](auto& d) { return PointComparisonLine<>(d); }, distance), 1.0L);
}
TEST_F(RandomLineErrors, slope_in_blocks_falls_behind_by_its_remainder_and_half_a_step) {
  const auto excess = [](const Place<2>& place, const std::int32_t(&d)[2]) {
    const std::int64_t length = std::max(std::abs(d[0]), std::abs(d[1]));
    const std::int64_t height = std::min(std::abs(d[0]), std::abs(d[1]));
    const std::int64_t rest = height == 0 ? 0 : length % height;
    return axis_error(place, d) - static_cast<long double>(rest * (height - rest)) / static_cast<long double>(length);
  };
  EXPECT_LE(worst([](auto& d) { return SlopeBlocks<>(d); }, excess), 0.5L + 1e-12L);
}

TEST(LineBounds, the_first_million_pulses_of_the_longest_lines_are_those_of_the_reference_form) {
  const std::int32_t cases[][3] = {{largest, largest, -largest},
                                   {largest, largest - 1, 1},
                                   {-largest, largest / 2, largest / 2 + 1},
                                   {2, -largest, 0}};
  for (const auto& d : cases) {
    MasterSlave<3> reference(d);
    BresenhamLine<3> lean(d);
    Place<3> place{};
    for (std::int64_t k = 1; k <= 1'000'000; ++k) {
      const Pulse pulse = lean.next();
      ASSERT_EQ(pulse.steps, reference.next().steps);
      test::apply(pulse, place);
      for (unsigned a = 0; a < 3; ++a) {
        const auto ideal = static_cast<long double>(d[a]) * static_cast<long double>(k) / largest;
        ASSERT_LE(std::abs(static_cast<long double>(place[a]) - ideal), 0.5L + 1e-9L) << a << " at " << k;
      }
    }
  }
}

TEST(LineBounds, dda_of_the_longest_line_takes_all_31_bits) {
  Dda<2> dda({largest, -largest});
  Place<2> place{};
  for (std::int64_t k = 1; k <= 1'000'000; ++k) {
    test::apply(dda.next(), place);
    ASSERT_EQ(place[0], (k * largest) >> 31);
    ASSERT_EQ(place[1], -place[0]);
  }
}

TEST(LineBounds, two_axis_methods_start_right_on_the_longest_lines) {
  const std::int32_t cases[][2] = {
      {largest, largest}, {largest, largest - 1}, {largest, 1}, {-1, largest}, {largest / 2, -largest}};
  for (const auto& d : cases) {
    SlopeRecalculated<> recalculated(d);
    PointComparisonLine<> compared(d);
    Place<2> first{};
    Place<2> second{};
    for (int k = 0; k < 1'000'000; ++k) {
      test::apply(recalculated.next(), first);
      test::apply(compared.next(), second);
      ASSERT_LT(axis_error(first, d), 1.0L) << d[0] << "," << d[1] << " at " << k;
      ASSERT_LE(distance(second, d), 1.0L) << d[0] << "," << d[1] << " at " << k;
    }
  }
}

// 2³¹−1 pulses each take seconds, so this is among the slow tests.
template <class Interpolator>
void expect_end(Interpolator interpolator, Place<2> end) {
  if (test::runs(0) == 0) GTEST_SKIP() << "takes up to a minute: PASSO_RUNS=1";
  Place<2> place{};
  while (!interpolator.done()) test::apply(interpolator.next(), place);
  EXPECT_EQ(place, end);
}

TEST(LineBoundsInFull, the_longest_line_ends_exactly) {
  expect_end(BresenhamLine<2>({-largest, largest - 1}), {-largest, largest - 1});
}
TEST(LineBoundsInFull, the_longest_lines_end_exactly_by_every_method) {
  expect_end(BresenhamLine<2>({largest, 1}), {largest, 1});
  expect_end(MasterSlave<2>({1'000'000'007, -largest}), {1'000'000'007, -largest});
  expect_end(Dda<2>({largest, -2}, DdaLoad::half), {largest, -2});
  expect_end(SlopeRecalculated<>({largest, 1'000'000'007}), {largest, 1'000'000'007});
  expect_end(SlopeBlocks<>({-1'000'000'007, largest}), {-1'000'000'007, largest});
  expect_end(PointComparisonLine<>({largest, -largest}), {largest, -largest});
  expect_end(PointComparisonLine<std::uint32_t, EndByProjection>({largest - 1, largest}), {largest - 1, largest});
}

}  // namespace
}  // namespace passo
