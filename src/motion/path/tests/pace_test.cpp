#include "../pace.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(PaceTest, an_even_pace_is_s_to_the_bit) {
  const Pace pace = Pace::between(1, 1, 0.1);
  EXPECT_TRUE(pace.is_even());
  EXPECT_EQ(pace.width, 0.1);
  EXPECT_EQ(pace.distance(0.07), 0.07);
  EXPECT_EQ(pace.reaches(0.07), 0.07);
}

TEST(PaceTest, goes_from_rate_to_rate_over_the_distance) {
  for (const auto& [first, last] : {std::pair{0.3, 1.0}, std::pair{1.0, 0.3}, std::pair{0.5, 0.5}}) {
    const Pace pace = Pace::between(first, last, 0.2);
    EXPECT_NEAR(pace.rate_at(pace.width), last, 1e-15);
    EXPECT_NEAR(pace.distance(pace.width), 0.2, 1e-15);
    for (const double u : {0.1, 0.5, 0.9})
      EXPECT_NEAR(pace.reaches(pace.distance(u * pace.width)), u * pace.width, 1e-15);
  }
}

// A circle of radius 2, by differences.
TEST(PaceTest, bounds_the_derivatives_of_an_arc_passed_with_it) {
  const Pace pace = Pace::between(0.4, 0.9, 0.5);
  const auto place = [&](double u) {
    const double angle = pace.distance(u) / 2;
    return std::pair{2 * std::cos(angle), 2 * std::sin(angle)};
  };
  constexpr double h = 0.01;
  double bend = 0;
  double curl = 0;
  for (double u = 2 * h; u < pace.width - 2 * h; u += h) {
    const auto [x0, y0] = place(u - 2 * h);
    const auto [x1, y1] = place(u - h);
    const auto [x2, y2] = place(u);
    const auto [x3, y3] = place(u + h);
    const auto [x4, y4] = place(u + 2 * h);
    bend = std::max(bend, std::hypot(x1 - 2 * x2 + x3, y1 - 2 * y2 + y3) / (h * h));
    curl = std::max(
        curl, std::hypot(x0 - 4 * x1 + 6 * x2 - 4 * x3 + x4, y0 - 4 * y1 + 6 * y2 - 4 * y3 + y4) / (h * h * h * h));
  }
  EXPECT_LE(bend, pace.bend_of(0.5));
  EXPECT_GE(bend, 0.5 * pace.bend_of(0.5));
  EXPECT_LE(curl, pace.curl_of(0.5));
  EXPECT_GE(curl, 0.3 * pace.curl_of(0.5));
}

}  // namespace
}  // namespace passo
