#include "passo/motor/monotone_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "kit/seed.hpp"

namespace passo {
namespace {

MonotoneCurve through(std::vector<CurvePoint> points) {
  auto curve = MonotoneCurve::through(std::move(points));
  EXPECT_TRUE(curve) << curve.error().message;
  return *curve;
}

TEST(MonotoneCurve, meets_its_points_and_keeps_the_end_values_outside) {
  const MonotoneCurve curve = through({{1, 5}, {2, 4}, {4, 3.5}, {5, 0}});
  EXPECT_DOUBLE_EQ(curve.at(1), 5);
  EXPECT_DOUBLE_EQ(curve.at(2), 4);
  EXPECT_DOUBLE_EQ(curve.at(4), 3.5);
  EXPECT_DOUBLE_EQ(curve.at(5), 0);
  EXPECT_EQ(curve.at(-100), 5);
  EXPECT_EQ(curve.at(100), 0);
}

TEST(MonotoneCurve, two_points_are_a_line) {
  const MonotoneCurve curve = through({{0, 8}, {4, 0}});
  for (double x = 0; x <= 4; x += 0.125) EXPECT_NEAR(curve.at(x), 8 - 2 * x, 1e-14);
}

TEST(MonotoneCurve, points_on_a_line_give_the_line) {
  const MonotoneCurve curve = through({{0, 8}, {1, 6}, {3.5, 1}, {4, 0}});
  for (double x = 0; x <= 4; x += 0.125) EXPECT_NEAR(curve.at(x), 8 - 2 * x, 1e-13);
}

// Computed by hand. One piece has width 1 and falls by 1, the other has width 2 and falls by 2 a unit. The shorter
// piece has the weight 1 + 2·2 = 5 and the longer one 2·1 + 2 = 4, so the slope is (5 + 4)/(5/−1 + 4/−2).
TEST(MonotoneCurve, has_the_slope_of_the_weighted_harmonic_mean_at_an_inner_point) {
  const MonotoneCurve curve = through({{0, 5}, {1, 4}, {3, 0}});
  const double h = 1e-6;
  EXPECT_NEAR((curve.at(1 + h) - curve.at(1 - h)) / (2 * h), -9.0 / 7, 1e-5);
}

// At the left end, the parabola through three points has the slope ((2·1 + 2)·(−1) − 1·(−2))/(1 + 2), which needs no
// limit. At the right end it is ((2·2 + 1)·(−2) − 2·(−1))/(1 + 2).
TEST(MonotoneCurve, has_the_slope_of_a_parabola_at_its_ends) {
  const MonotoneCurve curve = through({{0, 5}, {1, 4}, {3, 0}});
  const double h = 1e-6;
  EXPECT_NEAR((curve.at(h) - curve.at(0)) / h, -2.0 / 3, 1e-5);
  EXPECT_NEAR((curve.at(3) - curve.at(3 - h)) / h, -8.0 / 3, 1e-5);
}

TEST(MonotoneCurve, a_cliff_is_not_overshot) {
  const MonotoneCurve curve = through({{0, 1}, {1, 1}, {1.01, 0}, {2, 0}});
  for (double x = 0; x <= 2; x += 1e-3) {
    EXPECT_LE(curve.at(x), 1);
    EXPECT_GE(curve.at(x), 0);
  }
  EXPECT_EQ(curve.at(0.5), 1);
  EXPECT_EQ(curve.at(1.5), 0);
}

TEST(MonotoneCurve, random_falling_points_make_a_falling_curve_without_corners) {
  std::mt19937_64 random(test::seed());
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 300; ++round) {
    std::vector<CurvePoint> points{{share(random), 100}};
    const auto count = 2 + static_cast<int>(random() % 10);
    while (static_cast<int>(points.size()) < count) {
      const double drop = random() % 4 == 0 ? 0 : std::pow(share(random), 4) * 30;
      points.push_back({points.back().x + 0.1 + 3 * share(random), points.back().y - drop});
    }
    const MonotoneCurve curve = through(points);
    double last = points.front().y;
    const double width = points.back().x - points.front().x;
    for (int i = 0; i <= 2000; ++i) {
      const double y = curve.at(points.front().x + width * i / 2000);
      ASSERT_LE(y, last + 1e-12);
      last = y;
    }
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {  // the slope is the same from both sides
      const double h = 1e-7;
      const double left = (curve.at(points[i].x) - curve.at(points[i].x - h)) / h;
      const double right = (curve.at(points[i].x + h) - curve.at(points[i].x)) / h;
      ASSERT_NEAR(left, right, 2e-2);
    }
  }
}

TEST(MonotoneCurve, data_that_turn_have_no_peak_beyond_their_points) {
  const MonotoneCurve curve = through({{0, 0}, {1, 3}, {2, 1}, {3, 2}});
  double highest = 0;
  for (double x = 0; x <= 3; x += 1e-3) highest = std::max(highest, curve.at(x));
  EXPECT_LE(highest, 3);
}

TEST(MonotoneCurve, refuses_what_is_no_curve_and_says_why) {
  const auto error = [](std::vector<CurvePoint> points) {
    const auto curve = MonotoneCurve::through(std::move(points));
    return curve ? std::string("accepted") : curve.error().message;
  };
  EXPECT_EQ(error({}), "a curve needs at least 2 points, not 0");
  EXPECT_EQ(error({{1, 1}}), "a curve needs at least 2 points, not 1");
  EXPECT_EQ(error({{1, 1}, {1, 0}}), "the points must be in ascending order, but 1 follows 1");
  EXPECT_EQ(error({{3, 1}, {2, 0}}), "the points must be in ascending order, but 2 follows 3");
  EXPECT_EQ(error({{0, 1}, {std::numeric_limits<double>::infinity(), 0}}), "inf:0 is not a valid point of a curve");
  EXPECT_EQ(error({{0, std::nan("")}, {1, 0}}), "0:nan is not a valid point of a curve");
}

}  // namespace
}  // namespace passo
