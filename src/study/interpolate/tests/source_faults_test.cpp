// Faults of listings that circulate, and biases of methods, as docs/interpolation tells them. Each listing is run here.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "walk.hpp"
#include <gtest/gtest.h>

#include "passo/interpolate/arcs.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"

namespace passo {
namespace {

// round((s/max)*i) in doubles.
TEST(SourceFaults, a_listing_in_doubles_misses_ties) {
  std::set<std::pair<int, int>> wrong_lines;
  for (int m = 1; m <= 100; ++m) {
    for (int s = 0; s <= m; ++s) {
      for (int i = 1; i <= m; ++i) {
        const double quotient = static_cast<double>(s) / m;
        const auto listed = static_cast<int>(std::round(quotient * i));
        const int right = (2 * i * s + m) / (2 * m);
        if (listed == right) continue;
        EXPECT_EQ(2 * i * s % (2 * m), m) << "only a tie is missed";
        EXPECT_EQ(listed, right - 1);
        EXPECT_LT(i, m) << "the end is right";
        wrong_lines.insert({m, s});
        if (m == 22 && s == 15) {
          EXPECT_EQ(i, 11);
          EXPECT_EQ(listed, 7);
        }
      }
    }
  }
  EXPECT_EQ(wrong_lines.size(), 54U);
  EXPECT_TRUE(wrong_lines.contains({22, 15}));
}

// Above slope 1 the listing divides dy by dx, but takes the remainder of dx by dy, and makes the extra step along X.
TEST(SourceFaults, a_listing_that_swaps_axes_ends_elsewhere) {
  const int dx = 3;
  const int dy = 29;
  int x = 0;
  int y = 0;
  const int q = dy / dx;
  for (int block = 0; block < dx; ++block) {
    y += q;
    ++x;
    if (block < dx % dy) ++x;
  }
  EXPECT_EQ(std::pair(x, y), std::pair(6, 27));
  EXPECT_EQ(test::places<2>(SlopeBlocks<>({dx, dy})).back(), (test::Place<2>{dx, dy}));
}

// Point comparison whose end is judged by one counter alone. Returns where it ends.
test::Place<2> by_projection(std::int64_t xe, std::int64_t ye, unsigned counted) {
  test::Place<2> place{};
  for (std::int64_t deviation = 0; place[counted] != (counted == 0 ? xe : ye);) {
    if (deviation >= 0) {
      ++place[0];
      deviation -= ye;
    } else {
      ++place[1];
      deviation += xe;
    }
  }
  return place;
}

TEST(SourceFaults, pure_projection_fails_only_at_45_degrees) {
  EXPECT_EQ(by_projection(4, 4, 0), (test::Place<2>{4, 3}));
  for (std::int64_t xe = 1; xe <= 60; ++xe) {
    for (std::int64_t ye = 1; ye <= 60; ++ye) {
      const test::Place<2> end{xe, ye};
      if (xe > ye) {
        EXPECT_EQ(by_projection(xe, ye, 0), end);
      } else {
        EXPECT_EQ(by_projection(xe, ye, 1), end);
      }
      if (xe == ye) {
        EXPECT_EQ(by_projection(xe, ye, 0), (test::Place<2>{xe, ye - 1}));
      }
    }
  }
}

TEST(SourceFaults, slope_recalculated_is_biased_by_half_less_its_slope) {
  for (std::int32_t length = 2; length <= 120; ++length) {
    for (std::int32_t height = 1; height < length; ++height) {
      const double slope = static_cast<double>(height) / length;
      double ahead = 0;
      double behind = 0;
      double sum = 0;
      for (const test::Place<2>& place : test::places<2>(SlopeRecalculated<>({length, height}))) {
        const double off = static_cast<double>(place[1]) - slope * static_cast<double>(place[0]);
        ahead = std::max(ahead, off);
        behind = std::max(behind, -off);
        sum += off;
      }
      ASSERT_LE(ahead, 1 - slope + 1e-9);
      ASSERT_LE(behind, slope + 1e-9);
      ASSERT_NEAR(sum / length, 0.5 - slope, 0.2501);
      if (length == 27 && height == 3) {
        EXPECT_NEAR(ahead, 0.889, 0.001);
        EXPECT_NEAR(behind, 0.111, 0.001);
        EXPECT_NEAR(sum / length, 0.407, 0.001);
      }
    }
  }
}

double largest_error(std::int32_t radius, DdaLoad load) {
  double largest = 0;
  const ArcPoints circle{.start = {radius, 0}, .end = {radius, 0}, .clockwise = false};
  for (const test::Place<2>& place : test::places<2>(DdaArc<>(circle, load), {radius, 0})) {
    const double off = std::hypot(static_cast<double>(place[0]), static_cast<double>(place[1])) - radius;
    largest = std::max(largest, std::abs(off));
  }
  return largest;
}

TEST(SourceFaults, half_load_helps_integrators_on_arcs_too) {
  EXPECT_NEAR(largest_error(20, DdaLoad::zero), 1.260, 0.001);
  EXPECT_NEAR(largest_error(20, DdaLoad::half), 0.881, 0.001);
  for (const std::int32_t radius : {5, 10, 50, 100, 200, 500, 1000, 5000}) {
    EXPECT_LT(largest_error(radius, DdaLoad::half), largest_error(radius, DdaLoad::zero)) << radius;
  }
}

}  // namespace
}  // namespace passo
