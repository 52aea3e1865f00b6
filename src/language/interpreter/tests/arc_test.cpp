#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "../arc_center.hpp"
#include "interpreted.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Arc, with_a_radius_has_its_ends_on_the_circle_and_is_the_short_or_the_long_way_as_r_says) {
  std::mt19937_64 random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  std::uniform_real_distribution<double> coordinate(-50, 50);
  std::uniform_real_distribution<double> excess(1.0, 20.0);
  for (int i = 0; i < 2000; ++i) {
    const PlanePoint start{coordinate(random), coordinate(random)};
    const PlanePoint end{coordinate(random), coordinate(random)};
    const double radius = std::hypot(start.first - end.first, start.second - end.second) / 2 * excess(random);
    const bool clockwise = i % 2 == 0;
    const bool long_way = i % 4 < 2;
    const ArcCenter arc = center_from_radius(start, end, long_way ? -radius : radius, clockwise, arc_tolerance_mm);
    ASSERT_EQ(arc.fault, ArcFault::none);
    EXPECT_NEAR(std::hypot(arc.center.first - start.first, arc.center.second - start.second), radius, 1e-9 * radius);
    EXPECT_NEAR(std::hypot(arc.center.first - end.first, arc.center.second - end.second), radius, 1e-9 * radius);
    const double sweep = arc_sweep(start, end, arc.center, clockwise ? -1 : 1);
    EXPECT_EQ(sweep < 0, clockwise);
    EXPECT_EQ(std::abs(sweep) > pi, long_way) << sweep;
  }
}

TEST(Arc, radius_may_fall_short_of_a_semicircle_by_a_rounding_error_only) {
  EXPECT_EQ(center_from_radius({0, 0}, {10, 0}, 4.999, true, arc_tolerance_mm).fault, ArcFault::none);
  EXPECT_EQ(center_from_radius({0, 0}, {10, 0}, 4.99, true, arc_tolerance_mm).fault, ArcFault::radius_too_small);
  EXPECT_EQ(center_from_radius({0, 0}, {0, 0}, 4.99, true, arc_tolerance_mm).fault, ArcFault::ends_at_start);
}

TEST(Arc, radii_may_differ_as_far_as_rounded_numbers_make_them) {
  EXPECT_EQ(check_center({0, 0}, {10.02, 0}, {5, 0}, arc_tolerance_mm).fault, ArcFault::none);
  EXPECT_EQ(check_center({0, 0}, {10.1, 0}, {5, 0}, arc_tolerance_mm).fault, ArcFault::radii_differ);
  // The radii may differ by a tenth of a percent of a large radius, but never by more than a hundred times the
  // tolerance.
  EXPECT_EQ(check_center({0, 0}, {2000.9, 0}, {1000, 0}, arc_tolerance_mm).fault, ArcFault::none);
  EXPECT_EQ(check_center({0, 0}, {20003, 0}, {10000, 0}, arc_tolerance_mm).fault, ArcFault::radii_differ);
  EXPECT_EQ(check_center({0, 0}, {0, 0}, {0.001, 0}, arc_tolerance_mm).fault, ArcFault::zero_radius);
}

TEST(Arc, that_ends_where_it_starts_is_a_full_circle) {
  EXPECT_NEAR(arc_sweep({1, 0}, {1, 0}, {0, 0}, 1), 2 * pi, 1e-12);
  EXPECT_NEAR(arc_sweep({1, 0}, {1, 0}, {0, 0}, -1), -2 * pi, 1e-12);
  EXPECT_NEAR(arc_sweep({1, 0}, {0, 1}, {0, 0}, 3), 4.5 * pi, 1e-12);
  EXPECT_NEAR(arc_sweep({1, 0}, {0, 1}, {0, 0}, -2), -3.5 * pi, 1e-12);
}

TEST(Arc, has_its_centre_in_the_axes_of_its_plane) {
  const Interpreted result = interpret_text("G21 F100 G18\nG0 X0 Z0\nG2 X2 Z2 I1 K1\nG19 G3 Y4 Z2 J2 Y4\nM2\n");
  EXPECT_TRUE(result.diagnostics.any_error());  // Y twice
  const Interpreted good = interpret_text("G21 F100 G18\nG0 X0 Z0\nG2 X2 Z2 I1 K1\nG19 G3 Y4 Z2 J2\nM2\n");
  const auto arcs = good.all<operation::ArcFeed>();
  ASSERT_EQ(arcs.size(), 2U) << good.rendered();
  EXPECT_EQ(arcs[0].plane, Plane::zx);
  EXPECT_EQ(arcs[0].first_center, Mm(1));
  EXPECT_EQ(arcs[0].turns, -1);
  EXPECT_EQ(arcs[1].plane, Plane::yz);
  EXPECT_EQ(arcs[1].first_center, Mm(2));
  EXPECT_EQ(arcs[1].second_center, Mm(2));
  EXPECT_EQ(arcs[1].turns, 1);
}

TEST(Arc, in_inches_is_told_in_millimetres) {
  const Interpreted result = interpret_text("G20\nF10 G2 X1 I.5 Z-.1 P2\nM2\n");
  const auto arc = result.last<operation::ArcFeed>();
  EXPECT_DOUBLE_EQ(arc.end[Axis::x], 25.4);
  EXPECT_DOUBLE_EQ(arc.first_center.value(), 12.7);
  EXPECT_DOUBLE_EQ(arc.end[Axis::z], -2.54);
  EXPECT_EQ(arc.turns, -2);
}

TEST(Arc, modal_centre_words_alone_make_a_circle) {
  const Interpreted result = interpret_text("G21 F100 G3 X0 Y0 I5\nJ2\nM2\n");
  EXPECT_EQ(result.all<operation::ArcFeed>().size(), 2U) << result.rendered();
}

}  // namespace
}  // namespace passo
