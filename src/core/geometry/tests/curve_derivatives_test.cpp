#include "passo/geometry/curve_derivatives.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

Point point(double x, double y, double z) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

void expect_same_derivatives(const Curve& curve) {
  for (const double share : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    const Mm s = curve.length() * share;
    const CurveDerivatives at = derivatives_at(curve, s);
    EXPECT_EQ(at.first.values, curve.tangent(s).values) << share;
    EXPECT_EQ(at.second.values, curve.second_derivative(s).values) << share;
    // Curve takes the angle of the third by another order of the same operations.
    const Point third = curve.third_derivative(s);
    for (std::size_t i = 0; i < axis_count; ++i) EXPECT_NEAR(at.third.values[i], third.values[i], 1e-15) << share;
  }
}

TEST(CurveDerivatives, of_a_line) {
  expect_same_derivatives(Curve::line(point(1, 2, 3), point(7, -2, 4)));
}

TEST(CurveDerivatives, of_an_arc_a_helix_and_a_spiral) {
  expect_same_derivatives(Curve::arc(point(2, 0, 0), point(0, 2, 0), Axis::x, Axis::y, 0, 0, 1.5707963267948966));
  expect_same_derivatives(Curve::arc(point(2, 0, 0), point(0, 2, 5), Axis::x, Axis::y, 0, 0, -4.71238898038469));
  expect_same_derivatives(Curve::arc(point(2, 0, 0), point(0, 2.3, 5), Axis::x, Axis::y, 0, 0, 1.5707963267948966));
}

TEST(CurveDerivatives, of_a_cubic) {
  expect_same_derivatives(Curve::cubic(point(0, 0, 0), point(1, 0, 0), point(3, 2, 1), point(0, 1, 0), Mm(3.7)));
}

TEST(CurveDerivatives, of_an_arc_without_length) {
  const CurveDerivatives at =
      derivatives_at(Curve::arc(point(1, 1, 0), point(1, 1, 0), Axis::x, Axis::y, 1, 1, 6.28), Mm(0));
  EXPECT_EQ(at.first.values, Point().values);
  EXPECT_EQ(at.second.values, Point().values);
}

}  // namespace
}  // namespace passo
