// Lines compared pulse by pulse with their definitions, which are written out again with wide numbers and quotients.
#include <random>

#include "kit/seed.hpp"
#include "walk.hpp"
#include <gmock/gmock.h>
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
using test::places;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
__extension__ typedef __int128 Wide;  // NOLINT: products of three lengths

// Lengths of very different sizes, with all signs, and now and then zero.
class RandomLines : public testing::Test {
 protected:
  std::int32_t length() {
    const int bits = std::uniform_int_distribution(0, 6)(random_);
    const auto size = std::uniform_int_distribution<std::int32_t>(0, (1 << bits) - 1)(random_);
    return (random_() & 1) != 0 ? -size : size;
  }
  std::mt19937_64 random_{test::seed()};
  int runs_ = test::runs(20'000);
};

// round(k·s/m), halves away from zero.
std::int64_t rounded(std::int64_t k, std::int64_t s, std::int64_t m) {
  const std::int64_t magnitude = (2 * k * std::abs(s) + m) / (2 * m);
  return s < 0 ? -magnitude : magnitude;
}

TEST_F(RandomLines, master_and_slaves_stand_at_the_rounded_place) {
  for (int run = 0; run < runs_; ++run) {
    const std::int32_t d[3] = {length(), length(), length()};
    const std::int64_t m = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    std::int64_t k = 0;
    BresenhamLine<3> lean(d);
    BresenhamLine<3, std::uint16_t> narrow(d);
    const auto end =
        test::walk<3>(MasterSlave<3>(d), {}, [&](Pulse pulse, const Place<3>& place, const auto& reference) {
          ++k;
          for (unsigned a = 0; a < 3; ++a) ASSERT_EQ(place[a], rounded(k, d[a], m));
          const Pulse same = lean.next();
          const Pulse also = narrow.next();
          ASSERT_EQ(same.steps, pulse.steps) << d[0] << "," << d[1] << "," << d[2] << " pulse " << k;
          ASSERT_EQ(also.steps, pulse.steps);
          ASSERT_EQ(same.directions, pulse.directions);
          for (std::uint8_t a = 0; a < 3; ++a) ASSERT_EQ(lean.decision(a), reference.reached(a) - reference.middle(a));
        });
    ASSERT_EQ(k, m);
    ASSERT_EQ(end, (Place<3>{d[0], d[1], d[2]}));
    ASSERT_TRUE(lean.done() && narrow.done());
  }
}

TEST_F(RandomLines, dda_steps_at_each_overflow) {
  for (int run = 0; run < runs_; ++run) {
    const std::int32_t d[3] = {length(), length(), length()};
    const std::int64_t longest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    const bool half = (random_() & 1) != 0;
    std::uint8_t bits = 0;
    while ((std::int64_t{1} << bits) <= longest) ++bits;
    bits = static_cast<std::uint8_t>(bits + random_() % 3);
    const std::int64_t full = std::int64_t{1} << bits;
    std::int64_t k = 0;
    const Dda<3> dda(d, half ? DdaLoad::half : DdaLoad::zero, bits);
    const auto end = test::walk<3>(dda, {}, [&](Pulse, const Place<3>& place, const Dda<3>& now) {
      ++k;
      for (std::uint8_t a = 0; a < 3; ++a) {
        const std::int64_t sum = k * std::abs(d[a]) + (half ? full / 2 : 0);
        ASSERT_EQ(std::abs(place[a]), sum / full);
        ASSERT_EQ(now.accumulator(a), sum % full);
      }
    });
    ASSERT_EQ(k, longest == 0 ? 0 : full);
    ASSERT_EQ(end, (Place<3>{d[0], d[1], d[2]}));
  }
}

// The definition by quotients, in the first octant, along the longer axis.
std::vector<Place<2>> slopes(std::int64_t dx, std::int64_t dy) {
  std::vector<Place<2>> found;
  std::int64_t x = 0;
  std::int64_t y = 0;
  while (x < dx) {
    const bool first = x == 0 && dx != dy;
    const bool steep = dy > 0 && static_cast<Wide>(dy - y) * dx >= static_cast<Wide>(dy) * (dx - x);
    if (steep && !first) ++y;
    found.push_back({++x, y});
  }
  return found;
}

std::vector<Place<2>> blocks(std::int64_t dx, std::int64_t dy) {
  std::vector<bool> diagonals;
  for (std::int64_t block = 0; block < dy; ++block) {
    const std::int64_t q = dx / dy;
    diagonals.insert(diagonals.end(), static_cast<std::size_t>(q / 2), false);
    diagonals.push_back(true);
    diagonals.insert(diagonals.end(), static_cast<std::size_t>(q - 1 - q / 2), false);
    if (block < dx % dy) diagonals.push_back(false);
  }
  if (dy == 0) diagonals.assign(static_cast<std::size_t>(dx), false);
  std::vector<Place<2>> found;
  std::int64_t y = 0;
  for (const bool diagonal : diagonals) {
    if (diagonal) ++y;
    found.push_back({static_cast<std::int64_t>(found.size()) + 1, y});
  }
  return found;
}

// Mirrors places into the octant of d.
std::vector<Place<2>> mirrored(std::vector<Place<2>> first_octant, const std::int32_t (&d)[2]) {
  for (Place<2>& place : first_octant) {
    if (std::abs(d[1]) > std::abs(d[0])) std::swap(place[0], place[1]);
    if (d[0] < 0) place[0] = -place[0];
    if (d[1] < 0) place[1] = -place[1];
  }
  return first_octant;
}

TEST_F(RandomLines, both_slope_methods_follow_their_definition_in_all_octants) {
  for (int run = 0; run < runs_; ++run) {
    const std::int32_t d[2] = {length(), length()};
    const std::int64_t dx = std::max(std::abs(d[0]), std::abs(d[1]));
    const std::int64_t dy = std::min(std::abs(d[0]), std::abs(d[1]));
    ASSERT_EQ(places<2>(SlopeRecalculated<>(d)), mirrored(slopes(dx, dy), d)) << d[0] << "," << d[1];
    ASSERT_EQ(places<2>(SlopeBlocks<>(d)), mirrored(blocks(dx, dy), d)) << d[0] << "," << d[1];
    ASSERT_EQ(places<2>(SlopeRecalculated<std::uint16_t>(d)), places<2>(SlopeRecalculated<>(d)));
    ASSERT_EQ(places<2>(SlopeBlocks<std::uint16_t>(d)), places<2>(SlopeBlocks<>(d)));
  }
}

// The definition, with the deviation computed anew from the place.
std::vector<Place<2>> compared(const std::int32_t (&d)[2]) {
  const std::int64_t xe = std::abs(d[0]);
  const std::int64_t ye = std::abs(d[1]);
  std::vector<Place<2>> found;
  Place<2> place{};
  while (place != Place<2>{xe, ye}) {
    const bool x_wanted = xe * place[1] - ye * place[0] >= 0;
    const bool x = x_wanted ? place[0] != xe : place[1] == ye;
    ++place[x ? 0 : 1];
    found.push_back({d[0] < 0 ? -place[0] : place[0], d[1] < 0 ? -place[1] : place[1]});
  }
  return found;
}

TEST_F(RandomLines, point_comparison_feeds_one_axis_a_pulse_however_the_end_is_judged) {
  for (int run = 0; run < runs_; ++run) {
    const std::int32_t d[2] = {length(), length()};
    const auto expected = compared(d);
    ASSERT_EQ(places<2>(PointComparisonLine<std::uint32_t, EndByCoordinates>(d)), expected) << d[0] << "," << d[1];
    ASSERT_EQ(places<2>(PointComparisonLine<std::uint32_t, EndByProjection>(d)), expected) << d[0] << "," << d[1];
    ASSERT_EQ(places<2>(PointComparisonLine<std::uint32_t, EndByTotal>(d)), expected) << d[0] << "," << d[1];
    ASSERT_EQ(places<2>(PointComparisonLine<std::uint16_t, EndByProjection>(d)), expected);
  }
}

TEST(Lines, a_slave_stands_where_the_reference_says) {
  std::vector<std::int64_t> slave;
  for (const Place<2>& place : places<2>(BresenhamLine<2>({10, 4}))) slave.push_back(place[1]);
  EXPECT_THAT(slave, ElementsAre(0, 1, 1, 2, 2, 2, 3, 3, 4, 4));
}

// docs/interpolation/master-slave.md shows it: one variable for all axes, started at +m.
TEST(Lines, a_listing_that_circulates_ends_a_step_too_far) {
  int decision = 10;
  std::vector<std::int64_t> slave;
  std::int64_t stands = 0;
  for (int k = 1; k <= 10; ++k) {
    decision += 2 * 4;
    if (decision >= 0) {
      ++stands;
      decision -= 2 * 10;
    }
    slave.push_back(stands);
  }
  EXPECT_THAT(slave, ElementsAre(1, 2, 2, 3, 3, 3, 4, 4, 5, 5));
  EXPECT_EQ(places<2>(BresenhamLine<2>({10, 4})).back(), (Place<2>{10, 4}));
}

TEST(Lines, no_length_is_no_pulse) {
  EXPECT_THAT(places<2>(MasterSlave<2>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(BresenhamLine<2>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(Dda<2>({0, 0}, DdaLoad::half)), IsEmpty());
  EXPECT_THAT(places<2>(Dda<2>({0, 0}, DdaLoad::zero, 31)), IsEmpty());
  EXPECT_THAT(places<2>(SlopeRecalculated<>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(SlopeBlocks<>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(PointComparisonLine<std::uint32_t, EndByCoordinates>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(PointComparisonLine<std::uint32_t, EndByProjection>({0, 0})), IsEmpty());
  EXPECT_THAT(places<2>(PointComparisonLine<std::uint32_t, EndByTotal>({0, 0})), IsEmpty());
}

TEST(Lines, one_axis_alone_steps_straight) {
  const std::vector<Place<2>> down = {{0, -1}, {0, -2}, {0, -3}};
  EXPECT_EQ(places<2>(MasterSlave<2>({0, -3})), down);
  EXPECT_EQ(places<2>(BresenhamLine<2>({0, -3})), down);
  EXPECT_EQ(places<2>(SlopeRecalculated<>({0, -3})), down);
  EXPECT_EQ(places<2>(SlopeBlocks<>({0, -3})), down);
  EXPECT_EQ(places<2>(PointComparisonLine<>({0, -3})), down);
  EXPECT_EQ(places<2>(Dda<2>({0, -3})).back(), down.back());
}

TEST(Lines, eight_axes_are_the_most) {
  const std::int32_t d[8] = {1, -2, 3, -4, 5, -6, 7, -8};
  EXPECT_EQ(places<8>(BresenhamLine<8>(d)).back(), (Place<8>{1, -2, 3, -4, 5, -6, 7, -8}));
  EXPECT_EQ(places<8>(BresenhamLine<8>(d)), places<8>(MasterSlave<8>(d)));
}

TEST(Lines, are_worked_out_at_compile_time_as_well) {
  constexpr int steps = [] {
    BresenhamLine<2> line({10, 4});
    int count = 0;
    while (!line.done()) count += (line.next().steps >> 1) & 1;
    return count;
  }();
  static_assert(steps == 4);
}

}  // namespace
}  // namespace passo
