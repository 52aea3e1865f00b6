// The verdicts of `passo check` on random machines, beside full physics. bench/margin_table.cpp prints the whole table.
//
// PASSO_SEED=S PASSO_RUNS=N pipeline_tests --gtest_filter=Margin.* takes the machines S to S + N - 1.
#include <cstdint>
#include <cstdlib>

#include "kit/drawn_machine.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// No machine that is called safe loses a step. The first seeds are hard ones: on 29 the jitter of steps that wait for
// the events of a faster motor makes a rotor swing; 197 swings by itself; 44 overshoots and keeps its steps; 469 keeps
// its steps with all motors of the trial, but swings far; on 518 a motion turns round on the border between two steps;
// 725 loses steps with some strengths only, in the midst of others.
TEST(Margin, nothing_that_is_called_safe_loses_steps) {
  for (const std::uint64_t seed : {29U, 197U, 44U, 469U, 518U, 725U, 9U, 24U}) {
    const test::JudgedRun run = test::judged_run(seed);
    EXPECT_FALSE(run.verdict == Verdict::safe && run.lost) << seed;
    EXPECT_FALSE(run.verdict == Verdict::lost && !run.lost) << seed;
  }
}

// A judge who doubts everything is never wrong.
TEST(Margin, says_safe_and_lost_where_that_is_so) {
  EXPECT_EQ(test::judged_run(24).verdict, Verdict::safe);
  EXPECT_EQ(test::judged_run(12).verdict, Verdict::lost);
}

TEST(Margin, keeps_its_promise_on_many) {
  const char* const given = std::getenv("PASSO_RUNS");
  const int runs = given != nullptr ? std::atoi(given) : 4;
  const std::uint64_t first = test::seed();
  int lost = 0;
  int kept_of_lost = 0;
  for (int i = 0; i < runs; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const test::JudgedRun run = test::judged_run(seed);
    EXPECT_FALSE(run.verdict == Verdict::safe && run.lost) << seed;
    lost += run.verdict == Verdict::lost ? 1 : 0;
    kept_of_lost += run.verdict == Verdict::lost && !run.lost ? 1 : 0;
  }
  EXPECT_LE(20 * kept_of_lost, lost);
}

}  // namespace
}  // namespace passo
