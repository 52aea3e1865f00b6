// The ramps in real numbers compared with sequences of other code; and the distance of each method from the exact ramp.
#include "passo/ramp/real_ramp.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "kit/ramp_sequences.hpp"
#include "kit/seed.hpp"

#include "passo/interpolate/exact_ramp.hpp"
#include "passo/interpolate/ramp_move.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/interpolate/recursive_ramp.hpp"
#include "passo/interpolate/table_ramp.hpp"
#include "passo/ramp/ramp_setup.hpp"

namespace passo {
namespace {

using test::RampSequence;

RampSetup setup_of(const RampSequence& sequence) {
  return {Hertz(sequence.clock), sequence.steps_per_turn, {sequence.acceleration}};
}

TEST(RealRamp, matches_the_published_sequences_to_twelve_digits) {
  const auto sequences = test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  for (const RampSequence& sequence : sequences) {
    RealExactRamp exact(first_interval(setup_of(sequence)));
    RealRecursiveRamp recursive(first_interval(setup_of(sequence)));
    for (std::size_t n = 0; n < sequence.exact.size(); ++n) {
      ASSERT_NEAR(exact.interval() / sequence.exact[n], 1, 1e-12) << n;
      ASSERT_NEAR(exact.end() / sequence.ends[n], 1, 1e-12) << n;
      ASSERT_NEAR(recursive.interval() / sequence.recursive[n], 1, 1e-12) << n;
      exact.rise();
      recursive.rise();
    }
  }
}

TEST(RealRamp, the_recursion_finds_its_way_back) {
  RealRecursiveRamp ramp(123'456.789);
  std::vector<double> intervals;
  for (int n = 0; n < 100'000; ++n, ramp.rise()) intervals.push_back(ramp.interval());
  for (std::size_t n = intervals.size(); n-- > 0;) {
    ramp.fall();
    ASSERT_NEAR(ramp.interval() / intervals[n], 1, 1e-9) << n;
  }
}

TEST(RealRamp, the_midpoint_recursion_is_exact_up_and_down) {
  RealMidpointRamp midpoint(6266.5706865775);
  RealExactRamp exact(6266.5706865775);
  EXPECT_NEAR((midpoint.rise(), midpoint.interval()), 2595.70, 0.005);
  EXPECT_NEAR((midpoint.rise(), midpoint.interval()), 1991.75, 0.005);
  exact.rise();
  exact.rise();
  for (int n = 2; n < 200'000; ++n) {
    ASSERT_NEAR(midpoint.interval() / exact.interval(), 1, 1e-9) << n;
    midpoint.rise();
    exact.rise();
  }
  // The header's bound of the way down: n²·10⁻¹⁶.
  RealMidpointRamp down(6266.5706865775);
  RealExactRamp exactly_down(6266.5706865775);
  for (int n = 0; n < 10'000; ++n, down.rise()) exactly_down.rise();
  for (int n = 10'000; n > 0; --n) {
    down.fall();
    exactly_down.fall();
    ASSERT_NEAR(down.interval() / exactly_down.interval(), 1, 1e-8) << n;
  }
}

// The source's eight steps: 16,321 ticks by the recursion, 17,725 exact.
TEST(RealRamp, the_recursion_is_early_after_eight_steps) {
  RealRecursiveRamp recursive(6266.5706865775);
  RealExactRamp exact(6266.5706865775);
  double early = 0;
  for (int n = 0; n < 8; ++n, recursive.rise()) early += recursive.interval();
  for (int n = 0; n < 7; ++n) exact.rise();
  EXPECT_NEAR(early, 16'321, 0.5);
  EXPECT_NEAR(exact.end(), 17'725, 1);
}

// The header's bound is (ln n + 2.4) / 8n; the error comes near to it.
TEST(RealRamp, the_recursion_is_short_by_what_its_header_says) {
  RealExactRamp exact(1);
  RealRecursiveRamp recursive(1);
  for (int n = 1; n < 1'000'000; ++n) {
    exact.rise();
    recursive.rise();
    const double short_by = 1 - recursive.interval() / exact.interval();
    if (n == 1) {
      EXPECT_NEAR(short_by, 0.195, 0.0005);
    }
    const double bound = (std::log(n) + 2.4) / (8 * n);
    ASSERT_LT(short_by, bound) << n;
    ASSERT_GT(short_by, bound * (n < 100 ? 0.65 : 0.96)) << n;
  }
}

struct Worst {
  double ticks = 0;
  double share = 0;
  void see(double interval, double exact) {
    ticks = std::max(ticks, std::abs(interval - exact));
    share = std::max(share, std::abs(interval - exact) / exact);
  }
};

void print(const char* method, const Worst& worst) {
  std::printf("  %-22s %12.3f ticks %9.4f %%\n", method, worst.ticks, 100 * worst.share);
}

TEST(RealRamp, the_error_of_each_method_against_the_exact_one_is_measured) {
  const auto sequences = test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  std::printf("largest error of an interval, first 512 steps of four motors:\n");
  Worst recursive;
  Worst recursive_integer;
  Worst table;
  Worst exact_integer;
  for (const RampSequence& sequence : sequences) {
    const double square = first_interval_squared(setup_of(sequence));
    const auto whole_square = static_cast<std::uint64_t>(std::llround(square));
    RealRecursiveRamp recursion(std::sqrt(square));
    RecursiveRamp<> integer_recursion(whole_square, rounded_root(whole_square));
    ExactRamp exact(whole_square);
    TableRamp<CompiledTable<512>> from_table;
    const bool applies = from_table.set_first_interval(static_cast<std::uint32_t>(std::sqrt(square)));
    for (const double interval : sequence.exact) {
      recursive.see(recursion.interval(), interval);
      recursive_integer.see(integer_recursion.interval(), interval);
      exact_integer.see(exact.interval(), interval);
      if (applies) table.see(from_table.interval(), interval);
      recursion.rise();
      integer_recursion.rise();
      exact.rise();
      from_table.rise();
    }
  }
  print("recursive, real", recursive);
  print("recursive, integer", recursive_integer);
  print("table", table);
  print("exact, integer", exact_integer);
  EXPECT_NEAR(recursive.share, 0.1953, 0.0001);
  EXPECT_NEAR(recursive_integer.share, 0.1953, 0.0001);
  EXPECT_LT(table.ticks, 2.42);
  EXPECT_LE(exact_integer.ticks, 1);
}

TEST(RealRamp, whole_moves_of_integers_are_within_a_tick_of_those_in_real_numbers) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 300; ++run) {
    const auto first = random() % 100'000 + 100;
    const auto cruise = static_cast<std::uint32_t>(random() % 100 + 5);
    const auto steps = static_cast<std::int32_t>(random() % 3000);
    RampMove<ExactRamp> whole(ExactRamp(first * first));
    RampMove<RealExactRamp> real(RealExactRamp(static_cast<double>(first)));
    ASSERT_TRUE(whole.set_rates(0, cruise));
    ASSERT_TRUE(real.set_rates(0, cruise));
    whole.move_to(steps);
    real.move_to(steps);
    while (!whole.done()) ASSERT_NEAR(whole.next(), real.next(), 1);
    ASSERT_TRUE(real.done());
  }
}

TEST(TableLimit, matches_the_published_values) {
  std::ifstream file(PASSO_SOURCE_DIR "/../shared/golden/table_limit.csv");
  if (!file) GTEST_SKIP() << "../shared/golden is not here";
  std::string line;
  std::getline(file, line);
  int rows = 0;
  double rate = 0;
  double limit = 0;
  std::int64_t size = 0;
  std::int32_t steps = 0;
  for (char comma = 0; file >> rate >> comma >> size >> comma >> steps >> comma >> limit; ++rows) {
    EXPECT_NEAR(least_acceleration(Hertz(rate), size, steps).value / limit, 1, 1e-12);
    EXPECT_NEAR(reached_rate({limit}, size, steps).value() / rate, 1, 1e-12);
  }
  EXPECT_GT(rows, 0);
}

}  // namespace
}  // namespace passo
