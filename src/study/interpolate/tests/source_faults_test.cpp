// Faults of listings that circulate, and biases of methods, as docs/interpolation tells them. Each listing is run here.
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

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

// The lean listing with its variable for all axes or one for each, started at `start`. Returns the places.
std::vector<std::vector<int>> lean_listing(const std::vector<int>& lengths, int start, bool is_shared) {
  const int m = *std::ranges::max_element(lengths);
  std::vector<int> decisions(lengths.size(), start);
  std::vector<int> place(lengths.size(), 0);
  std::vector<std::vector<int>> places;
  for (int k = 0; k < m; ++k) {
    for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
      int& d = decisions[is_shared ? 0 : axis];
      d += 2 * lengths[axis];
      if (d < 0) continue;
      ++place[axis];
      d -= 2 * m;
    }
    places.push_back(place);
  }
  return places;
}

// The start alone is a fault, and the shared variable alone is one from three axes on.
TEST(SourceFaults, the_lean_listing_has_two_faults) {
  using Places = std::vector<int>;
  EXPECT_EQ(lean_listing({10, 4, 7}, 10, false).back(), (Places{10, 5, 8}));
  EXPECT_EQ(lean_listing({10, 4, 7}, 10, true).back(), (Places{10, 5, 7}));
  EXPECT_EQ(lean_listing({10, 4}, -10, true), lean_listing({10, 4}, -10, false));
  const auto right = lean_listing({10, 4, 7}, -10, false);
  const auto shared = lean_listing({10, 4, 7}, -10, true);
  EXPECT_EQ(right.back(), shared.back());
  const auto first = std::ranges::mismatch(right, shared);
  EXPECT_EQ(first.in1 - right.begin() + 1, 3);
  EXPECT_EQ(*first.in1, (Places{3, 1, 2}));
  EXPECT_EQ(*first.in2, (Places{3, 2, 1}));
}

// Figure 7b follows from 7a by d -> (d + m)/2: the start 0 becomes -m, and the listing has +m.
TEST(SourceFaults, the_substitution_of_the_flowcharts_starts_at_minus_m) {
  for (int m = 1; m <= 40; ++m) {
    for (int s = 0; s <= m; ++s) {
      int a = 0;   // 7a: gains s, steps at m/2, loses m; doubled here, so that it stays a whole number
      int b = -m;  // 7b
      for (int k = 0; k < m; ++k) {
        a += 2 * s;
        b += 2 * s;
        ASSERT_EQ(a, b + m);
        ASSERT_EQ(a >= m, b >= 0);
        if (b < 0) continue;
        a -= 2 * m;
        b -= 2 * m;
      }
      ASSERT_EQ(a, 0);
    }
  }
}

// The rounding listing prints doubles, as C++ prints them: with six digits.
TEST(SourceFaults, the_rounding_listing_prints_a_million_as_an_exponent) {
  std::ostringstream out;
  out << std::round(1.0 * 999'999) << " " << std::round(1.0 * 1'000'000) << " " << std::round(1.0 * 1'234'567);
  EXPECT_EQ(out.str(), "999999 1e+06 1.23457e+06");
}

// "m >= ref_slope: both axes" would begin every line with a diagonal; the source's example begins with a plain step.
TEST(SourceFaults, the_first_pulse_of_slope_recalculated_is_an_exception_to_its_rule) {
  const auto places = test::places<2>(SlopeRecalculated<>({27, 3}));
  EXPECT_EQ(places[0], (test::Place<2>{1, 0}));
  EXPECT_EQ(places[1], (test::Place<2>{2, 1}));
  EXPECT_EQ(places[2], (test::Place<2>{3, 1}));
}

// 1.414 is short of the root of two by 0.015 %: the move takes longer than its time by this share of its diagonals.
TEST(SourceFaults, even_speed_with_three_decimals_takes_too_long) {
  const double by_three_decimals = 1 / (6 + 4 * 1.414);
  EXPECT_NEAR(by_three_decimals, 0.0857927, 5e-8);
  EXPECT_NEAR(1 / (6 + 4 * std::sqrt(2)), 0.0857864, 5e-8);
  EXPECT_NEAR(by_three_decimals * (6 + 4 * std::sqrt(2)), 1.000073, 5e-7);
}

// F = 0 feeds X, even if X has no steps: with a counter for each axis the line never ends, with their sum it ends
// beside.
TEST(SourceFaults, a_line_along_y_begins_with_a_step_of_x) {
  EXPECT_EQ(by_projection(0, 5, 1), (test::Place<2>{1, 5}));
  test::Place<2> place{};
  for (std::int64_t total = 5, deviation = 0; total != 0; --total) {
    const bool is_x = deviation >= 0;
    ++place[is_x ? 0 : 1];
    deviation += is_x ? -5 : 0;
  }
  EXPECT_EQ(place, (test::Place<2>{1, 4}));
}

// Numbers that the sources print about their machines.
TEST(SourceNumbers, of_a_step) {
  EXPECT_DOUBLE_EQ(4.0 / 400, 0.01);       // mm: a screw of 4 mm, 400 steps a turn
  EXPECT_NEAR(1.0 / 48, 0.0208, 0.00005);  // mm: a screw of 1 mm (M6), 48 steps a turn
  EXPECT_EQ(27 % 3, 0);                    // slope in blocks of (27, 3): nothing remains
  EXPECT_EQ(27 / 3 / 2, 4);                // 9 / 2 = 4.5: 4 X, then a diagonal, then
  EXPECT_EQ(27 / 3 - 1 - 4, 4);            // 9 - 1 - 4 X
}

}  // namespace
}  // namespace passo
