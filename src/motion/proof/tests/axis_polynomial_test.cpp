#include "../axis_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "proof_kit.hpp"

namespace passo::proof {
namespace {

using test::phase;
using Order = AxisPolynomial::Order;

constexpr std::array all_orders = {Order::velocity, Order::acceleration, Order::jerk};

// The derivatives of q(s(t)) at a time, by the chain rule.
double by_chain_rule(const Derivatives& start, const Phase& of, double t, Order order) {
  const double s = of.position_at(Seconds(t)).value() - of.start.value();
  const double v = of.velocity_at(Seconds(t)).value();
  const double a = of.acceleration_at(Seconds(t)).value();
  const double first = start.first + start.second * s + start.third * s * s / 2;
  const double second = start.second + start.third * s;
  if (order == Order::velocity) return first * v;
  if (order == Order::acceleration) return second * v * v + first * a;
  return start.third * v * v * v + 3 * second * v * a + first * of.jerk.value();
}

TEST(AxisPolynomials, are_the_motion_by_the_chain_rule_and_find_its_peaks) {
  test::Random random = test::Random::of(5);
  for (int trial = 0; trial < 300; ++trial) {
    const bool is_line = trial % 3 == 0;
    const Derivatives start{.first = random.between(-1, 1),
                            .second = is_line ? 0 : random.between(-2, 2),
                            .third = is_line ? 0 : random.between(-20, 20)};
    const Phase of = phase(random.between(0.01, 0.5), random.between(0, 3), random.between(0, 5),
                           random.between(-10, 10), trial % 2 == 0 ? 0 : random.between(-100, 100));
    const AxisPolynomial polynomial(start, of);
    for (const Order order : all_orders) {
      double highest = 0;
      constexpr int looks = 4000;
      for (int i = 0; i <= looks; ++i) {
        const double u = static_cast<double>(i) / looks;
        const double value = by_chain_rule(start, of, u * of.duration.value(), order);
        ASSERT_NEAR(polynomial.value(u, order), value, 1e-9 * (1 + std::abs(value)));
        highest = std::max(highest, std::abs(value));
      }
      const auto peak = polynomial.peak_above(0, order);
      ASSERT_TRUE(peak || highest == 0);
      if (!peak) continue;
      EXPECT_GE(peak->value, highest * (1 - 1e-9));
      EXPECT_NEAR(std::abs(by_chain_rule(start, of, peak->u * of.duration.value(), order)), peak->value,
                  1e-9 * (1 + peak->value))
          << "a value of the motion";
      EXPECT_GE(polynomial.highest(order), peak->value * (1 - 1e-9));
      EXPECT_FALSE(polynomial.peak_above(peak->value * (1 + 1e-6), order));
    }
  }
}

// Above the value for a hundredth of the phase, between the places where a row of looks would look.
TEST(AxisPolynomials, find_a_peak_that_is_much_shorter_than_the_phase) {
  const Phase of = phase(0.6, 0, 1, 0);
  const AxisPolynomial polynomial({.first = 0.5, .second = 1.98, .third = -7.92}, of);
  const auto peak = polynomial.peak_above(0.7474, Order::velocity);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->u * 0.6, 0.25, 1e-4);
  EXPECT_NEAR(peak->value, 0.5 + 1.98 * 0.25 - 7.92 * 0.0625 / 2, 1e-9);
}

}  // namespace
}  // namespace passo::proof
