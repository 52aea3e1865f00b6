// What the source of the ramps says and what its formulas give, as docs/errata.md tells it. The formulas are written
// here as the source has them.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double fault_pi = 3.14159265358979323846;
// The motor of the published sequences: 250 kHz, 400 steps a turn, 50 rad/s².
constexpr double fault_clock = 250'000;
constexpr double fault_angle = 2 * fault_pi / 400;
constexpr double fault_acceleration = 50;
const double k_b = fault_clock * std::sqrt(2 * fault_angle / fault_acceleration);

double exact_interval(int n) {
  return k_b * (std::sqrt(n + 1.0) - std::sqrt(static_cast<double>(n)));
}
double recursion(double before, double a) {
  return before * fault_angle * fault_clock * fault_clock /
         (fault_angle * fault_clock * fault_clock + a * before * before);
}

TEST(RampFaults, the_recursion_is_early_and_its_slope_is_right) {
  double interval = k_b;
  double listed = k_b;
  double exact = k_b;
  double second = 0;
  for (int n = 1; n < 2000; ++n) {
    interval = recursion(interval, fault_acceleration);
    if (n == 1) second = interval;
    if (n < 8) listed += interval;
    if (n < 8) exact += exact_interval(n);
  }
  EXPECT_NEAR(k_b, 6266.57, 0.005);
  EXPECT_NEAR(second, 2088.86, 0.005);             // K_b/3
  EXPECT_NEAR(exact_interval(1), 2595.70, 0.005);  // 0.414 K_b
  EXPECT_NEAR(1 - second / exact_interval(1), 0.195, 0.0005);
  EXPECT_NEAR(listed, 16'321, 0.5);
  EXPECT_NEAR(exact, 17'725, 0.5);
  EXPECT_NEAR(interval / exact_interval(1999), 1, 0.001);  // the slope
}

// "The same formula with a negative acceleration": it does not find its way back.
TEST(RampFaults, the_recursion_with_a_negative_acceleration_does_not_stop_where_it_should) {
  for (const auto& [up, down] : {std::array{8, 9}, std::array{100, 102}, std::array{1000, 1004}}) {
    double interval = k_b;
    for (int n = 1; n < up; ++n) interval = recursion(interval, fault_acceleration);
    int steps = 0;
    while (recursion(interval, -fault_acceleration) > 0) {
      interval = recursion(interval, -fault_acceleration);
      ++steps;
    }
    EXPECT_EQ(steps, down) << "then the next interval is negative";
    if (up == 8) {
      EXPECT_NEAR(interval, 5580.1, 0.05);
    }
  }
}

// "Of k_n only the fraction is kept": of k_0 = 1 it is 0.
TEST(RampFaults, the_first_factor_does_not_fit_into_its_format) {
  const auto fraction = [](double k) { return static_cast<unsigned>(k * 65'536) & 0xffffU; };
  EXPECT_EQ(fraction(1), 0U);
  EXPECT_EQ(fraction(std::sqrt(2.0) - 1), 27'145U);
}

// "An error afflicts the single c_n": the one of K_b is in all of them, and all have the same sign.
TEST(RampFaults, the_errors_of_the_table_add_up) {
  const double whole = std::floor(k_b);
  double listed = whole;
  double exact = k_b;
  std::vector<double> behind;
  for (int n = 1; n < 1000; ++n) {
    const double factor = std::floor((std::sqrt(n + 1.0) - std::sqrt(static_cast<double>(n))) * 65'536);
    listed += std::floor(whole * factor / 65'536);
    exact += exact_interval(n);
    if (n == 7 || n == 255 || n == 999) behind.push_back(exact - listed);
  }
  EXPECT_NEAR(behind[0], 5.5, 0.05);  // of 17 725 ticks
  EXPECT_NEAR(behind[1], 147.1, 0.05);
  EXPECT_NEAR(behind[2], 557.4, 0.05);  // of 198 166
}

// The charts of the table's limit: 256 entries, 100 steps a turn, 10 rad/s²: "about 280 pulses a second".
TEST(RampFaults, numbers_read_from_charts_are_near_the_formula) {
  EXPECT_NEAR(std::sqrt(10.0 * 256 * 100 / fault_pi), 285.46, 0.005);
  EXPECT_NEAR(fault_pi * 280 * 280 / (256 * 100), 9.62, 0.005);
  EXPECT_NEAR(fault_pi * 400 * 400 / (512 * 100), 9.82, 0.005);  // the end of the charts with the longer table
}

}  // namespace
}  // namespace passo
