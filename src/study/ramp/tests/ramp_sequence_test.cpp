// What `passo ramp` shows: every method is started as asked for, or refused in words.
#include "passo/ramp/ramp_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kit/golden.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

RampRequest request_of(RampMethod method, std::int64_t steps) {
  return {.setup = {Hertz(250'000), 400, {50}}, .method = method, .steps = steps, .jerk = {0}};
}

std::vector<double> play(const RampRequest& request) {
  auto sequence = RampSequence::start(request);
  EXPECT_TRUE(sequence) << sequence.error().message;
  std::vector<double> intervals;
  while (sequence && !sequence->done()) intervals.push_back(sequence->next());
  return intervals;
}

// The interval from the definition, to 64 bits.
long double exact_interval(long double first, long n) {
  return first * (std::sqrt(static_cast<long double>(n) + 1) - std::sqrt(static_cast<long double>(n)));
}

TEST(RampSequence, a_move_by_each_method_is_what_it_was) {
  std::string text;
  for (const RampMethod method : {RampMethod::exact, RampMethod::recursive, RampMethod::table}) {
    RampRequest request = request_of(method, 17);
    request.whole_move = true;
    request.rate = Hertz(200);
    for (const double interval : play(request)) text += fmt::format("{:.9g} ", interval);
    text += "\n";
  }
  test::expect_golden("src/study/ramp/tests/golden/moves.txt", text);
}

TEST(RampSequence, a_move_rises_cruises_and_falls_by_its_definition) {
  RampRequest request = request_of(RampMethod::exact, 1000);
  request.whole_move = true;
  request.rate = Hertz(1000);
  const std::vector<double> intervals = play(request);
  ASSERT_EQ(intervals.size(), 1000U);
  const long double first = 250'000 * std::sqrt(2 * (2 * 3.14159265358979323846L / 400) / 50);
  for (long n = 0; n < 1000; ++n) {
    const long double expected = std::max<long double>(250, exact_interval(first, std::min(n, 999 - n)));
    ASSERT_NEAR(intervals[static_cast<std::size_t>(n)], static_cast<double>(expected), 1e-9) << n;
  }
}

TEST(RampSequence, a_table_is_long_enough_where_its_size_is_not_said) {
  for (const double start : {0.0, 200.0, 900.0}) {
    RampRequest request = request_of(RampMethod::table, 700);
    request.whole_move = true;
    request.start = Hertz(start);
    const std::vector<double> table = play(request);
    request.method = RampMethod::exact;
    const std::vector<double> exact = play(request);
    ASSERT_EQ(table.size(), exact.size());
    for (std::size_t i = 0; i < table.size(); ++i) ASSERT_NEAR(table[i], exact[i], 2.5) << start << " " << i;
  }
}

TEST(RampSequence, a_stop_ends_the_move_on_the_same_ramp) {
  RampRequest request = request_of(RampMethod::table, 1000);
  request.whole_move = true;
  request.stop_after = 4;
  EXPECT_EQ(play(request), std::vector<double>({6266, 2595, 1991, 1678, 1479, 1678, 1991, 2595, 6266}));
  request.method = RampMethod::exact;
  request.jerk = {500};
  request.stop_after = 300;
  const std::size_t count = play(request).size();
  EXPECT_GT(count, 600U);  // the acceleration must fall to zero first
  EXPECT_LT(count, 900U);
}

TEST(RampSequence, a_reversal_brakes_turns_and_comes_back_to_the_start) {
  RampRequest request = request_of(RampMethod::table, 1000);
  request.whole_move = true;
  request.reverse_after = 4;
  // Nine steps to rest, as after a stop; then nine steps back, a triangle.
  EXPECT_EQ(play(request), std::vector<double>({6266, 2595, 1991, 1678, 1479, 1678, 1991, 2595, 6266,  //
                                                6266, 2595, 1991, 1678, 1479, 1678, 1991, 2595, 6266}));
  for (const bool jerky : {false, true}) {
    request.method = RampMethod::exact;
    request.jerk = {jerky ? 500.0 : 0.0};
    auto sequence = RampSequence::start(request);
    std::vector<std::int64_t> places;
    while (!sequence->done()) {
      sequence->next();
      places.push_back(sequence->place());
    }
    const auto turn = std::ranges::max_element(places);
    EXPECT_GE(*turn, 5);
    EXPECT_EQ(places.back(), 0);
    EXPECT_EQ(static_cast<std::int64_t>(places.size()), 2 * *turn);
    for (std::size_t i = 1; i < places.size(); ++i) ASSERT_EQ(std::abs(places[i] - places[i - 1]), 1);
  }
}

TEST(RampSequence, the_midpoint_recursion_makes_the_exact_moves) {
  for (const bool whole : {false, true}) {
    RampRequest request = request_of(RampMethod::midpoint, 1999);
    request.whole_move = whole;
    const std::vector<double> midpoint = play(request);
    request.method = RampMethod::exact;
    const std::vector<double> exact = play(request);
    ASSERT_EQ(midpoint.size(), exact.size());
    for (std::size_t n = 0; n < exact.size(); ++n) ASSERT_NEAR(midpoint[n] / exact[n], 1, 1e-10) << n;
  }
}

TEST(RampSequence, says_why_a_method_does_not_apply) {
  const auto refusal = [](const RampRequest& request) {
    const auto sequence = RampSequence::start(request);
    return sequence ? std::string() : sequence.error().message;
  };
  RampRequest request = request_of(RampMethod::table, 10);
  EXPECT_EQ(refusal(request), "");
  request.setup.clock = Hertz(1e7);
  EXPECT_NE(refusal(request).find("16 bits"), std::string::npos);
  request.setup.clock = Hertz(10);
  EXPECT_NE(refusal(request).find("less than one tick"), std::string::npos);

  RampRequest jerky = request_of(RampMethod::recursive, 10);
  jerky.jerk = {100};
  jerky.whole_move = true;
  EXPECT_NE(refusal(jerky).find("--method exact"), std::string::npos);
  RampRequest midpoint = request_of(RampMethod::midpoint, 10);
  midpoint.whole_ticks = true;
  EXPECT_NE(refusal(midpoint).find("--method exact"), std::string::npos);
  RampRequest far = request_of(RampMethod::midpoint, 200'001);
  EXPECT_EQ(refusal(far), "");
  far.whole_move = true;
  EXPECT_NE(refusal(far).find("loses precision"), std::string::npos);
  RampRequest fast = request_of(RampMethod::exact, 10);
  fast.start = Hertz(10);
  EXPECT_NE(refusal(fast).find("start rate"), std::string::npos);
  RampRequest down = request_of(RampMethod::recursive, 10);
  down.whole_ticks = true;
  EXPECT_EQ(refusal(down), "");
  down.whole_move = true;
  EXPECT_NE(refusal(down).find("cannot decelerate"), std::string::npos);
}

TEST(RampSequence, whole_ticks_are_within_one_of_the_real_ones) {
  for (const RampMethod method : {RampMethod::exact, RampMethod::recursive}) {
    RampRequest request = request_of(method, 5000);
    const std::vector<double> real = play(request);
    request.whole_ticks = true;
    const std::vector<double> whole = play(request);
    for (std::size_t i = 0; i < real.size(); ++i) {
      ASSERT_EQ(whole[i], std::round(whole[i]));
      ASSERT_NEAR(whole[i], real[i], 1);
    }
  }
}

}  // namespace
}  // namespace passo
