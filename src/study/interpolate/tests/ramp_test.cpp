// The ramps in integers, step by step, compared with real numbers of more digits and with sequences of other code.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kit/ramp_sequences.hpp"
#include "kit/seed.hpp"

#include "passo/interpolate/exact_ramp.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/interpolate/recursive_ramp.hpp"
#include "passo/interpolate/table_ramp.hpp"

namespace passo {
namespace {

using test::RampSequence;
__extension__ using Wide = unsigned __int128;

struct TableView {
  const std::vector<uint16_t>* factors;
  uint16_t size() const { return static_cast<uint16_t>(factors->size()); }
  uint16_t scaled(uint16_t first, uint16_t n) const {
    return static_cast<uint16_t>(uint32_t{first} * (*factors)[n] / 65536);
  }
};

double squared(const RampSequence& ramp) {
  return ramp.clock * ramp.clock * 4 * std::numbers::pi / (ramp.steps_per_turn * ramp.acceleration);
}

// √(n+1) − √n with 64 bits. That is enough for 16 exact bits, as asserted below.
long double factor(std::size_t n) {
  return 65536.0L / (std::sqrt(static_cast<long double>(n) + 1) + std::sqrt(static_cast<long double>(n)));
}

TEST(RampTable, every_entry_is_the_factor_cut_off_after_sixteen_bits) {
  std::vector<uint16_t> factors(3'000'000);
  make_ramp_table(factors.data(), factors.size());
  for (std::size_t n = 1; n < factors.size(); ++n) {
    const long double k = factor(n);
    // If the real value is this near to a whole number, rounding in the test itself could decide.
    ASSERT_GT(std::abs(k - std::round(k)), 1e-12L) << n;
    ASSERT_EQ(factors[n], static_cast<uint16_t>(k)) << n;
  }
}

TEST(RampTable, is_made_by_the_compiler_in_any_size) {
  static_assert(ramp_table<1>.size() == 1);
  static_assert(ramp_table<2>[1] == 27145);
  static_assert(ramp_table<65535>[65534] == 128);
  static_assert(CompiledTable<512>()[511] == 1448);
  EXPECT_EQ(sizeof(ramp_table<256>), 512U);
}

TEST(TableRamp, a_first_interval_of_more_than_sixteen_bits_is_refused_and_nothing_wraps) {
  TableRamp<CompiledTable<16>> ramp;
  EXPECT_TRUE(ramp.set_first_interval(1000));
  ramp.rise();
  EXPECT_FALSE(ramp.set_first_interval(65536));
  EXPECT_FALSE(ramp.set_first_interval(79266));
  EXPECT_FALSE(ramp.set_first_interval(0));
  EXPECT_EQ(ramp.interval(), 414);  // unchanged
  EXPECT_TRUE(ramp.set_first_interval(65535));
  EXPECT_EQ(ramp.interval(), 65535);
}

TEST(TableRamp, goes_on_at_the_speed_it_has_where_the_table_ends) {
  TableRamp<CompiledTable<4>> ramp;
  ASSERT_TRUE(ramp.set_first_interval(10'000));
  for (int i = 0; i < 10; ++i) ramp.rise();
  EXPECT_EQ(ramp.index(), 3);
  EXPECT_EQ(ramp.interval(), 2679);
  EXPECT_EQ(ramp.fastest(), 2679);
}

TEST(TableRamp, an_interval_is_never_long_and_short_by_less_than_its_three_cuts) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 300; ++run) {
    const double first = std::uniform_real_distribution<double>(1, 65535.999)(random);
    TableRamp<CompiledTable<5000>> ramp;
    ASSERT_TRUE(ramp.set_first_interval(static_cast<uint32_t>(first)));
    for (uint32_t n = 0; n < 5000; ++n) {
      const long double k = n == 0 ? 1 : factor(n) / 65536;
      const long double cuts = n == 0 ? k : k + static_cast<long double>(first) / 65536 + 1;
      ASSERT_LE(ramp.interval(), first * k) << "K_b " << first << " n " << n;
      ASSERT_GT(ramp.interval(), first * k - cuts) << "K_b " << first << " n " << n;
      ramp.rise();
    }
  }
}

TEST(TableRamp, matches_the_published_sequences_to_the_tick) {
  const auto sequences = test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  int applied = 0;
  std::vector<uint16_t> factors(512);
  make_ramp_table(factors.data(), factors.size());
  for (const RampSequence& sequence : sequences) {
    TableRamp<TableView> ramp(TableView{&factors});
    const bool applies = ramp.set_first_interval(static_cast<uint32_t>(std::sqrt(squared(sequence))));
    ASSERT_EQ(applies, !sequence.table.empty());
    applied += applies ? 1 : 0;
    for (const uint32_t interval : sequence.table) {
      ASSERT_EQ(ramp.interval(), interval);
      ramp.rise();
    }
  }
  EXPECT_GT(applied, 0);
}

TEST(RoundedRoot, is_the_nearest_whole_number_over_the_whole_range) {
  std::mt19937_64 random(test::seed());
  const auto check = [](uint64_t square) {
    const auto root = static_cast<Wide>(rounded_root(square));
    // (root − ½)² < square < (root + ½)², written without halves.
    ASSERT_LE(root * root, square + root) << square;
    ASSERT_GE(root * root + root, square) << square;
    if (root > 0) {
      ASSERT_GT(square, root * root - root) << square;
    }
  };
  for (uint64_t square = 0; square < 100'000; ++square) check(square);
  for (uint64_t root = 4'294'967'290U; root <= 4'294'967'295U; ++root) {
    for (const uint64_t square : {root * root - root, root * root - root + 1, root * root}) check(square);
  }
  for (int run = 0; run < 100'000; ++run) check(random() >> (random() % 62 + 2));
}

// The rounded √ of numbers beyond 64 bits, by bisection with whole numbers.
uint64_t nearest_root(Wide square) {
  uint64_t low = 0;
  uint64_t high = uint64_t{1} << 62;
  while (low < high) {  // the smallest root with square <= root² + root
    const uint64_t middle = (low + high) / 2;
    if (Wide{middle} * middle + middle >= square) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

void expect_exact(uint64_t first_squared, uint32_t steps) {
  ExactRamp ramp(first_squared);
  std::vector<uint32_t> intervals;
  uint64_t start = 0;
  for (uint32_t n = 0; n < steps; ++n) {
    const uint64_t end = nearest_root(Wide{first_squared} * (n + 1));
    ASSERT_EQ(ramp.end(), end) << "K_b² " << first_squared << " n " << n;
    ASSERT_EQ(ramp.interval(), end - start) << "K_b² " << first_squared << " n " << n;
    start = end;
    intervals.push_back(ramp.interval());
    if (n + 1 < steps) ramp.rise();
  }
  for (uint32_t n = steps; n-- > 0;) {
    ASSERT_EQ(ramp.interval(), intervals[n]) << "K_b² " << first_squared << " down to " << n;
    ASSERT_EQ(ramp.index(), n);
    if (n > 0) ramp.fall();
  }
}

TEST(ExactRamp, every_time_is_the_rounded_root_up_and_down) {
  for (const uint64_t first : {1ULL, 2ULL, 3ULL, 10ULL, 255ULL, 256ULL, 65535ULL, 65536ULL, 1'000'000ULL,
                               2'147'483'648ULL, 4'294'967'294ULL, 4'294'967'295ULL}) {
    expect_exact(first * first, 3000);
  }
  expect_exact(79266ULL * 79266 + 12345, 300'000);
}

TEST(ExactRamp, of_random_first_intervals_is_exact) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 500; ++run) {
    const unsigned bits = static_cast<unsigned>(random() % 64);
    const uint64_t square = random() >> bits;
    expect_exact(std::clamp<uint64_t>(square, 1, 4'294'967'295ULL * 4'294'967'295ULL), 1000);
  }
}

TEST(ExactRamp, turns_at_any_step) {
  std::mt19937_64 random(test::seed());
  ExactRamp ramp(1'000'003);
  std::vector<uint32_t> intervals;
  for (ExactRamp up = ramp; intervals.size() < 2000; up.rise()) intervals.push_back(up.interval());
  for (int run = 0; run < 100'000; ++run) {
    const bool rise = ramp.index() == 0 || (ramp.index() < 1999 && random() % 2 == 0);
    rise ? ramp.rise() : ramp.fall();
    ASSERT_EQ(ramp.interval(), intervals[ramp.index()]);
  }
}

TEST(ExactRamp, is_within_one_tick_of_the_published_sequences) {
  const auto sequences = test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  for (const RampSequence& sequence : sequences) {
    ExactRamp ramp(static_cast<uint64_t>(std::llround(squared(sequence))));
    for (std::size_t n = 0; n < sequence.exact.size(); ++n) {
      ASSERT_NEAR(ramp.interval(), sequence.exact[n], 1);
      ASSERT_NEAR(static_cast<double>(ramp.end()), sequence.ends[n], 0.501);
      ramp.rise();
    }
  }
}

template <class Square>
double worst_recursion(double first_squared, std::size_t steps) {
  RecursiveRamp<Square> ramp(static_cast<Square>(std::round(first_squared)),
                             static_cast<uint32_t>(std::llround(std::sqrt(first_squared))));
  const long double first = std::sqrt(static_cast<long double>(first_squared));
  long double real = first;
  double worst = 0;
  for (std::size_t n = 0; n < steps; ++n) {
    worst = std::max(worst, static_cast<double>(std::abs(ramp.interval() - real)));
    real /= 1 + 2 * (real / first) * (real / first);
    ramp.rise();
  }
  return worst;
}

TEST(RecursiveRamp, is_within_one_tick_of_the_recursion_in_real_numbers) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 2000; ++run) {
    const double small = std::uniform_real_distribution<double>(1, 65535)(random);
    ASSERT_LT(worst_recursion<uint32_t>(small * small, 2000), 1) << small;
    const double large = std::exp2(std::uniform_real_distribution<double>(1, 31.99)(random));
    ASSERT_LT(worst_recursion<uint64_t>(large * large, 2000), 1) << large;
  }
}

TEST(RecursiveRamp, is_within_one_tick_of_the_published_sequences) {
  const auto sequences = test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  for (const RampSequence& sequence : sequences) {
    const double square = squared(sequence);
    RecursiveRamp<> ramp(static_cast<uint64_t>(std::llround(square)),
                         static_cast<uint32_t>(std::llround(std::sqrt(square))));
    for (const double interval : sequence.recursive) {
      ASSERT_NEAR(ramp.interval(), interval, 1);
      ramp.rise();
    }
  }
}

}  // namespace
}  // namespace passo
