#include "../even_motion.hpp"

#include <algorithm>
#include <cmath>

#include "proof_kit.hpp"

namespace passo::proof {
namespace {

using Order = EvenMotion::Order;

// Bernstein polynomials of time find the same peaks as the closed form.
TEST(EvenMotions, have_the_peaks_of_the_polynomials_of_time) {
  test::Random random = test::Random::of(46);
  for (int trial = 0; trial < 500; ++trial) {
    const Derivatives start{
        .first = random.between(-1, 1), .second = random.between(-2, 2), .third = random.between(-20, 20)};
    const double velocity = random.between(0, 5);
    const double acceleration = random.between(-10, 10);
    const double longest = acceleration < 0 ? velocity / -acceleration : 0.5;
    const Phase of =
        test::phase(std::min(random.between(0.01, 0.5), longest), random.between(0, 3), velocity, acceleration);
    const EvenMotion motion(start, of);
    const AxisPolynomial polynomial(start, of);
    for (const Order order : {Order::velocity, Order::acceleration, Order::jerk}) {
      const auto peak = motion.peak_above(0, order);
      const auto expected = polynomial.peak_above(0, order);
      ASSERT_TRUE(peak && expected) << trial;
      EXPECT_NEAR(peak->value, expected->value, 1e-8 * (1 + expected->value)) << trial;
      EXPECT_NEAR(std::abs(polynomial.value(peak->time / of.duration.value(), order)), peak->value,
                  1e-8 * (1 + peak->value));
      EXPECT_NEAR(motion.highest(order, 0, motion.way()), peak->value, 1e-12 * (1 + peak->value));
    }
    EXPECT_FALSE(motion.peak_above(1e9, Order::jerk));
  }
}

}  // namespace
}  // namespace passo::proof
