// Places of curves by the referee's own formulas.
#include "../exact_curve.hpp"

#include <cmath>
#include <numbers>

#include "kit/stage_test.hpp"

namespace passo {
namespace {

using proof::distance;
using proof::ExactCurve;
using test::xyz;

// A circle's nearest place has a closed form, also where the part ends before it or goes round more than once.
TEST(ExactCurve, finds_the_nearest_place_of_a_circle) {
  test::Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = random.between(0.01, 3);
    const double from_angle = random.between(-4, 4);
    const double sign = random.chance(0.5) ? 1 : -1;
    const double sweep = sign * random.between(0.1, 9);
    const auto on_circle = [&](double angle) {
      return xyz(1 + radius * std::cos(angle), 2 + radius * std::sin(angle));
    };
    const ExactCurve arc(
        Curve::arc(on_circle(from_angle), on_circle(from_angle + sweep), Axis::x, Axis::y, 1, 2, sweep));
    const double from = arc.length() * random.between(0, 0.5);
    const double to = arc.length() * random.between(0.5, 1);
    const double x = 1 + radius * random.between(-2, 2);
    const Point point = xyz(x, 2 + radius * random.between(-2, 2));
    const ExactCurve::Nearest nearest = arc.nearest(point, from, to);
    EXPECT_NEAR(distance(arc.place(nearest.s), point), nearest.distance, 1e-12);
    double least = INFINITY;
    for (int i = 0; i <= 2000; ++i) {
      least = std::min(least, distance(arc.place(from + (to - from) * i / 2000), point));
    }
    EXPECT_LE(nearest.distance, least + 1e-12);
    // The nearest place is at most half a sample from one of them, and the point at most three radii from the centre.
    const double half_sample = (to - from) / 4000;
    EXPECT_LE(least * least, nearest.distance * nearest.distance + 3 * half_sample * half_sample + 1e-12);
  }
}

}  // namespace
}  // namespace passo
