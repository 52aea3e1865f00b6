#include "passo/study/measure.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace passo {
namespace {

StepMove line(Place to) {
  return {.from = Place(to.size(), 0), .to = to, .arc = {}};
}
Measures measured(MethodName name, const StepMove& move) {
  return *measure({.name = name}, move);
}

TEST(Measure, a_line_of_ten_and_four) {
  const Measures lean = measured(MethodName::lean, line({10, 4}));
  EXPECT_EQ(lean.pulses, 10);
  EXPECT_EQ(lean.together, 4);
  EXPECT_EQ(lean.idle, 0);
  // The slave is off by at most 0.4 of a step (2 for 1.6, 0 for 0.4); across the line this is less.
  EXPECT_NEAR(lean.largest_deviation, 0.4 * 10 / std::hypot(10, 4), 1e-12);
  // By beats: six plain pulses and four diagonal ones, each of the same time.
  EXPECT_NEAR(lean.evenness[0].ratio, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(lean.evenness[1].ratio, 1, 1e-12);
  EXPECT_NEAR(lean.evenness[2].lag, 0, 1e-12);
  // Exact: a plain pulse advances 10/116 of the way, a diagonal one 14/116.
  EXPECT_NEAR(lean.evenness[2].ratio, 1.4 / std::sqrt(2.0) > 1 ? 1.4 / std::sqrt(2.0) : std::sqrt(2.0) / 1.4, 1e-12);
}

TEST(Measure, idle_pulses_are_counted_and_not_measured) {
  const Measures dda = measured(MethodName::dda, line({10, 4}));
  EXPECT_EQ(dda.pulses, 16);
  EXPECT_EQ(dda.pulses - dda.idle, 10 + 4 - dda.together);
  EXPECT_LE(dda.largest_deviation, 1);
}

TEST(Measure, one_axis_alone_is_perfect) {
  for (const Method& method : methods_for(line({0, -7}))) {
    if (method.name == MethodName::dda) continue;
    const Measures found = *measure(method, line({0, -7}));
    EXPECT_EQ(found.pulses, 7) << title(method);
    EXPECT_EQ(found.largest_deviation, 0) << title(method);
    for (const Evenness& evenness : found.evenness) {
      EXPECT_NEAR(evenness.lag, 0, 1e-12) << title(method);
      EXPECT_NEAR(evenness.ratio, 1, 1e-12) << title(method);
    }
  }
}

TEST(Measure, a_full_circle_is_followed_all_the_way_round) {
  const StepMove circle{.from = {10, 0}, .to = {10, 0}, .arc = StepMove::Arc{.centre = {0, 0}, .clockwise = true}};
  const Measures midpoint = measured(MethodName::midpoint, circle);
  EXPECT_LE(midpoint.largest_deviation, 0.5);
  EXPECT_LT(midpoint.evenness[2].lag, 1e-9);
  EXPECT_LT(midpoint.evenness[0].lag, 3);
  EXPECT_EQ(measured(MethodName::point_comparison, circle).pulses, 80);
}

TEST(Measure, no_length_is_no_figure) {
  const Measures found = measured(MethodName::lean, line({0, 0}));
  EXPECT_EQ(found.pulses, 0);
  EXPECT_EQ(found.mean_deviation, 0);
  EXPECT_EQ(found.evenness[0].ratio, 1);
}

}  // namespace
}  // namespace passo
