#include "passo/feedback/pid.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Pid, adds_its_three_parts) {
  Pid p({.kp = 2}, Seconds(0.1), 100);
  EXPECT_DOUBLE_EQ(p.update(3, 1), 4);
  Pid i({.ki = 2}, Seconds(0.1), 100);
  EXPECT_DOUBLE_EQ(i.update(3, 1), 0.4);
  EXPECT_DOUBLE_EQ(i.update(3, 1), 0.8);
  Pid d({.kd = 2}, Seconds(0.1), 100);
  EXPECT_DOUBLE_EQ(d.update(3, 1), 0);  // the wanted value's jump does not kick
  double out = 0;
  for (int k = 1; k < 200; ++k) out = d.update(3, 1 + 0.5 * k * 0.1);
  EXPECT_NEAR(out, -2 * 0.5, 1e-9);
}

TEST(Pid, does_not_wind_up_at_its_limit) {
  Pid pid({.kp = 1, .ki = 10}, Seconds(0.01), 1);
  for (int i = 0; i < 1000; ++i) EXPECT_LE(pid.update(100, 0), 1);
  // The error turns: so does the output, at once.
  EXPECT_LT(pid.update(-1, 0), 0);
}

// A plant whose ultimate cycle is known: 1/(s + 1)³ swings with P = 8 and the period 2π/√3.
TEST(ZieglerNichols, makes_a_known_plant_swing_less_and_less) {
  const UltimateCycle cycle{.gain = 8, .period = Seconds(3.6276)};
  const auto response = [](const PidGains& gains) {
    constexpr double h = 0.001;
    Pid pid(gains, Seconds(h), 1e9);
    double x[3] = {};
    struct {
      double highest = 0;
      double last = 0;
      double late = 0;
    } seen;
    for (int i = 0; i < 60'000; ++i) {
      const double u = pid.update(1, x[2]);
      x[2] += h * (x[1] - x[2]);
      x[1] += h * (x[0] - x[1]);
      x[0] += h * (u - x[0]);
      seen.highest = std::max(seen.highest, x[2]);
      if (i > 40'000) seen.late = std::max(seen.late, std::abs(x[2] - seen.last));
      seen.last = i > 40'000 ? seen.last : x[2];
    }
    return seen;
  };
  // With half of the gain the swing fades, and P alone leaves an error of 1/(1 + 4).
  EXPECT_NEAR(response(ziegler_nichols_p(cycle)).last, 0.8, 0.01);
  EXPECT_NEAR(response(ziegler_nichols_pi(cycle)).last, 1, 0.02);
  const auto pid = response(ziegler_nichols_pid(cycle));
  EXPECT_NEAR(pid.last, 1, 0.001);
  EXPECT_GT(pid.highest, 1.2);  // the rule is known for overshoot: a quarter of it is left after each swing
  EXPECT_LT(pid.highest, 1.8);
  EXPECT_GT(response({.kp = 8}).late, 0.5);  // and at the ultimate gain it swings on
}

}  // namespace
}  // namespace passo
