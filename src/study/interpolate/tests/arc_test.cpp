// Arcs: what each method promises, tested on random arcs and at the limits of their range.
#include <cmath>
#include <random>

#include "kit/seed.hpp"
#include "walk.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/interpolate/arcs.hpp"

namespace passo {
namespace {

using test::Place;
using test::places;

long double radius(const Place<2>& place) {
  return std::hypot(static_cast<long double>(place[0]), static_cast<long double>(place[1]));
}
Place<2> start_of(const ArcPoints& arc) {
  return {arc.start[0], arc.start[1]};
}
Place<2> end_of(const ArcPoints& arc) {
  return {arc.end[0], arc.end[1]};
}

// The angle from the start in the sense of travel: 0 … 2π.
long double angle(const Place<2>& place, const ArcPoints& arc) {
  const long double from = std::atan2(static_cast<long double>(arc.start[1]), static_cast<long double>(arc.start[0]));
  const long double to = std::atan2(static_cast<long double>(place[1]), static_cast<long double>(place[0]));
  const long double turn = 2 * std::acos(-1.0L);
  const long double sweep = std::fmod((arc.clockwise ? from - to : to - from) + 2 * turn, turn);
  return sweep;
}

class RandomArcs : public testing::Test {
 protected:
  // An arc that starts anywhere and ends on the same circle, rounded to steps. One in eight is a full circle.
  ArcPoints arc() {
    for (;;) {
      const double size = std::exp(std::uniform_real_distribution(0.0, 4.0)(random_));
      const double from = std::uniform_real_distribution(0.0, 6.2831853)(random_);
      const double to = std::uniform_real_distribution(0.0, 6.2831853)(random_);
      ArcPoints made;
      made.start[0] = static_cast<std::int32_t>(std::lround(size * std::cos(from)));
      made.start[1] = static_cast<std::int32_t>(std::lround(size * std::sin(from)));
      made.clockwise = (random_() & 1) != 0;
      const double r = std::hypot(made.start[0], made.start[1]);
      if (r == 0) continue;
      made.end[0] = static_cast<std::int32_t>(std::lround(r * std::cos(to)));
      made.end[1] = static_cast<std::int32_t>(std::lround(r * std::sin(to)));
      if (random_() % 8 == 0) std::copy(made.start, made.start + 2, made.end);
      return made;
    }
  }

  // The largest distance from the circle, less the distance of the rounded end itself. Checks that the arc ends exactly
  // and never turns back.
  template <class Make>
  long double worst(Make make, bool diagonals) {
    long double most = 0;
    for (int run = 0; run < runs_ && !HasFailure(); ++run) {
      const ArcPoints given = arc();
      const long double r = radius(start_of(given));
      const long double end_error = std::abs(radius(end_of(given)) - r);
      long double before = 0;
      const auto interpolator = make(given);
      const Place<2> end =
          test::walk<2>(interpolator, start_of(given), [&](Pulse pulse, const Place<2>& place, const auto& now) {
            most = std::max(most, std::abs(radius(place) - r) - end_error);
            EXPECT_EQ(now.deviation(), place[0] * place[0] + place[1] * place[1] -
                                           start_of(given)[0] * start_of(given)[0] -
                                           start_of(given)[1] * start_of(given)[1]);
            EXPECT_TRUE(diagonals || pulse.steps == 1 || pulse.steps == 2);
            if (place == Place<2>{}) return;  // a circle of radius 1 may go through the centre
            const long double travelled = angle(place, given);
            EXPECT_TRUE(now.done() || travelled < 1e-9L || travelled >= before - 1e-9L)
                << travelled << " after " << before;
            before = travelled;
          });
      EXPECT_EQ(end, end_of(given)) << given.start[0] << "," << given.start[1] << " to " << given.end[0] << ","
                                    << given.end[1] << (given.clockwise ? " clockwise" : "");
    }
    return most;
  }

  std::mt19937_64 random_{test::seed()};
  int runs_ = test::runs(20'000);
};

TEST_F(RandomArcs, point_comparison_keeps_within_one_step_and_feeds_one_axis) {
  EXPECT_LE(worst([](const ArcPoints& arc) { return PointComparisonArc<>(arc); }, false), 1.0L);
}
TEST_F(RandomArcs, midpoint_keeps_within_half_a_step) {
  EXPECT_LE(worst([](const ArcPoints& arc) { return MidpointArc<>(arc); }, true), 0.5L);
}
TEST_F(RandomArcs, dda_keeps_within_two_and_a_half_steps_with_either_load) {
  EXPECT_LE(worst([](const ArcPoints& arc) { return DdaArc<>(arc); }, true), 2.5L);
  EXPECT_LE(worst([](const ArcPoints& arc) { return DdaArc<>(arc, DdaLoad::half); }, true), 2.5L);
}

// The number of pulses tells which quadrants an arc passes: a full circle has 8 R pulses of one axis each.
TEST(Arcs, a_full_circle_from_any_point_steps_all_the_way_round) {
  for (const bool clockwise : {false, true}) {
    for (std::int32_t x = -13; x <= 13; ++x) {
      for (std::int32_t y = -13; y <= 13; ++y) {
        if (x == 0 && y == 0) continue;
        const ArcPoints arc{.start = {x, y}, .end = {x, y}, .clockwise = clockwise};
        const auto walked = places<2>(PointComparisonArc<>(arc), start_of(arc));
        const auto crossing = static_cast<std::size_t>(std::lround(std::hypot(x, y)));
        ASSERT_EQ(walked.size(), 8 * crossing) << x << "," << y;
        ASSERT_EQ(walked.back(), start_of(arc));
        const auto diagonal = places<2>(MidpointArc<>(arc), start_of(arc));
        ASSERT_EQ(diagonal.back(), start_of(arc));
        ASSERT_GE(diagonal.size(), 4 * crossing);
      }
    }
  }
}

TEST(Arcs, every_pair_of_lattice_points_of_a_circle_is_met_in_both_senses) {
  // 65² = 4225 is a sum of two squares in many ways: 16² + 63², 25² + 60², 33² + 56², 39² + 52², 0² + 65².
  std::vector<std::array<std::int32_t, 2>> points;
  for (std::int32_t x = -65; x <= 65; ++x) {
    for (std::int32_t y = -65; y <= 65; ++y) {
      if (x * x + y * y == 4225) points.push_back({x, y});
    }
  }
  ASSERT_EQ(points.size(), 36U);
  for (const auto& from : points) {
    for (const auto& to : points) {
      for (const bool clockwise : {false, true}) {
        const ArcPoints arc{.start = {from[0], from[1]}, .end = {to[0], to[1]}, .clockwise = clockwise};
        long double sweep = angle(end_of(arc), arc);
        if (from == to) sweep = 2 * std::acos(-1.0L);
        const auto walked = places<2>(MidpointArc<>(arc), start_of(arc));
        ASSERT_EQ(walked.back(), end_of(arc));
        // The longer axis steps in each pulse, so there are between sweep·R/√2 and sweep·R pulses.
        ASSERT_GE(static_cast<long double>(walked.size()), sweep * 65 / std::sqrt(2.0L) - 2);
        ASSERT_LE(static_cast<long double>(walked.size()), sweep * 65 + 2);
        ASSERT_EQ(places<2>(PointComparisonArc<>(arc), start_of(arc)).back(), end_of(arc));
        ASSERT_EQ(places<2>(DdaArc<>(arc), start_of(arc)).back(), end_of(arc));
      }
    }
  }
}

TEST(Arcs, clockwise_is_counterclockwise_in_a_mirror) {
  const ArcPoints arc{.start = {7, 24}, .end = {-15, -20}, .clockwise = false};
  const ArcPoints mirror{.start = {7, -24}, .end = {-15, 20}, .clockwise = true};
  auto walked = places<2>(PointComparisonArc<>(arc), start_of(arc));
  for (Place<2>& place : walked) place[1] = -place[1];
  EXPECT_EQ(walked, places<2>(PointComparisonArc<>(mirror), start_of(mirror)));
}

TEST(Arcs, sixteen_bits_are_enough_for_their_radii) {
  for (const std::int32_t r : {1, 100, 32'766}) {
    const ArcPoints arc{.start = {r, 0}, .end = {0, -r}, .clockwise = false};
    EXPECT_EQ(places<2>(PointComparisonArc<std::uint16_t>(arc), start_of(arc)),
              places<2>(PointComparisonArc<>(arc), start_of(arc)));
    EXPECT_EQ(places<2>(MidpointArc<std::uint16_t>(arc), start_of(arc)), places<2>(MidpointArc<>(arc), start_of(arc)));
    EXPECT_EQ(places<2>(DdaArc<std::uint16_t>(arc), start_of(arc)), places<2>(DdaArc<>(arc), start_of(arc)));
  }
}

TEST(Arcs, about_the_centre_itself_there_is_nothing_to_do) {
  const ArcPoints none{};
  EXPECT_TRUE(PointComparisonArc<>(none).done());
  EXPECT_TRUE(MidpointArc<>(none).done());
  EXPECT_TRUE(DdaArc<>(none).done());
}

// The largest radius: at the start and on both sides of an axis crossing.
TEST(ArcBounds, the_largest_radius_does_not_overflow) {
  constexpr std::int32_t r = 2'147'483'647;
  const ArcPoints cases[] = {{.start = {r, 0}, .end = {0, r}, .clockwise = false},
                             {.start = {1000, r}, .end = {-1000, r}, .clockwise = false},
                             {.start = {-1000, -r}, .end = {1000, -r}, .clockwise = false},
                             {.start = {r, 1000}, .end = {r, -1000}, .clockwise = true},
                             {.start = {1'518'500'249, 1'518'500'249}, .end = {0, -r}, .clockwise = true}};
  for (const ArcPoints& arc : cases) {
    const auto check = [&](auto interpolator, long double bound) {
      Place<2> place = start_of(arc);
      for (int k = 0; k < 1'000'000 && !interpolator.done(); ++k) {
        test::apply(interpolator.next(), place);
        ASSERT_LE(std::abs(radius(place) - radius(start_of(arc))), bound) << k;
      }
      if (std::abs(arc.start[0] - arc.end[0]) <= 2000 && std::abs(arc.start[1] - arc.end[1]) <= 2000) {
        EXPECT_EQ(place, end_of(arc));
      }
    };
    check(PointComparisonArc<>(arc), 1.0L);
    check(MidpointArc<>(arc), 0.5L);
    check(DdaArc<>(arc), 2.5L);
  }
}

TEST(Roots, are_rounded_to_nearest) {
  for (std::uint64_t n = 0; n < 100'000; ++n) {
    const std::uint64_t root = rounded_root(n);
    // (root − ½)² ≤ n ≤ (root + ½)², times four.
    ASSERT_GE(4 * n + (root == 0 ? 1 : 0), (2 * root - (root == 0 ? 0 : 1)) * (2 * root - (root == 0 ? 0 : 1)));
    ASSERT_LE(4 * n, (2 * root + 1) * (2 * root + 1));
  }
  EXPECT_EQ(rounded_root(UINT64_C(4611686014132420609)), 2'147'483'647U);
  EXPECT_EQ(rounded_root(UINT64_C(9223372036854775808)), 3'037'000'500U);
}

}  // namespace
}  // namespace passo
