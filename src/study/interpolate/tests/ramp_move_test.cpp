// Whole moves: for any request, the count of steps is exact and the intervals are those of the ramp.
#include "passo/interpolate/ramp_move.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "kit/seed.hpp"

#include "passo/interpolate/exact_ramp.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/interpolate/table_ramp.hpp"

namespace passo {
namespace {

using Table = TableRamp<CompiledTable<300>>;

Table table_of(uint32_t first) {
  Table ramp;
  EXPECT_TRUE(ramp.set_first_interval(first));
  return ramp;
}

template <class Move>
std::vector<uint32_t> play(Move& move) {
  std::vector<uint32_t> intervals;
  while (!move.done()) intervals.push_back(move.next());
  return intervals;
}

template <class Ramp>
std::vector<uint32_t> play(const Ramp& ramp, uint32_t start, uint32_t cruise, int32_t steps) {
  RampMove<Ramp> move(ramp);
  using Interval = typename Ramp::Interval;
  EXPECT_TRUE(move.set_rates(static_cast<Interval>(start), static_cast<Interval>(cruise)));
  move.move_to(steps);
  return play(move);
}

using Intervals = std::vector<uint32_t>;

TEST(RampMove, a_long_move_is_a_trapezoid) {
  // K_b = 1000: 1000 414 317 267 236 213 …
  EXPECT_EQ(play(table_of(1000), 0, 250, 12),
            Intervals({1000, 414, 317, 267, 250, 250, 250, 250, 267, 317, 414, 1000}));
}

TEST(RampMove, a_short_move_turns_at_its_middle) {
  EXPECT_EQ(play(table_of(1000), 0, 1, 1), Intervals({1000}));
  EXPECT_EQ(play(table_of(1000), 0, 1, 2), Intervals({1000, 1000}));
  EXPECT_EQ(play(table_of(1000), 0, 1, 3), Intervals({1000, 414, 1000}));
  EXPECT_EQ(play(table_of(1000), 0, 1, 6), Intervals({1000, 414, 317, 317, 414, 1000}));
  EXPECT_EQ(play(table_of(1000), 0, 1, 0), Intervals());
}

TEST(RampMove, begins_and_ends_inside_the_start_stop_region) {
  EXPECT_EQ(play(table_of(1000), 300, 200, 6), Intervals({317, 267, 236, 236, 267, 317}));
  EXPECT_EQ(play(table_of(1000), 317, 200, 4), Intervals({317, 267, 267, 317}));
}

TEST(RampMove, a_wanted_rate_inside_the_start_stop_region_is_constant) {
  EXPECT_EQ(play(table_of(1000), 300, 300, 4), Intervals({300, 300, 300, 300}));
  EXPECT_EQ(play(table_of(1000), 300, 310, 3), Intervals({310, 310, 310}));
  EXPECT_EQ(play(table_of(1000), 300, 5000, 3), Intervals({5000, 5000, 5000}));
}

TEST(RampMove, a_ramp_that_begins_outside_the_start_stop_region_is_refused) {
  RampMove<Table> move(table_of(1000));
  EXPECT_FALSE(move.set_rates(1001, 200));
  EXPECT_TRUE(move.set_rates(1000, 200));
}

TEST(RampMove, goes_on_at_the_speed_it_has_where_the_table_ends) {
  const Intervals intervals = play(table_of(10'000), 0, 1, 2000);
  EXPECT_EQ(*std::ranges::min_element(intervals), 288U);  // 10 000 (√300 − √299)
  EXPECT_EQ(std::ranges::count(intervals, 288U), 2000 - 2 * 299);
}

TEST(RampMove, a_stop_in_mid_move_brakes_on_the_ramp) {
  RampMove<Table> move(table_of(1000));
  ASSERT_TRUE(move.set_rates(0, 250));
  move.move_to(-100);
  for (int i = 0; i < 20; ++i) move.next();
  EXPECT_FALSE(move.up());
  EXPECT_EQ(move.position(), -20);
  move.stop();
  EXPECT_EQ(play(move), Intervals({250, 267, 317, 414, 1000}));
  EXPECT_EQ(move.position(), -25);
  EXPECT_TRUE(move.done());
}

TEST(RampMove, a_target_behind_is_reached_by_braking_and_coming_back) {
  RampMove<Table> move(table_of(1000));
  ASSERT_TRUE(move.set_rates(0, 250));
  move.move_to(100);
  for (int i = 0; i < 20; ++i) move.next();
  move.move_to(22);
  EXPECT_EQ(play(move), Intervals({250, 267, 317, 414, 1000, 1000, 414, 1000}));
  EXPECT_EQ(move.position(), 22);
  EXPECT_FALSE(move.up());
}

TEST(RampMove, a_target_further_on_is_taken_without_a_stop) {
  RampMove<Table> move(table_of(1000));
  ASSERT_TRUE(move.set_rates(0, 250));
  move.move_to(10);
  for (int i = 0; i < 8; ++i) move.next();
  move.move_to(16);
  EXPECT_EQ(play(move), Intervals({414, 317, 267, 250, 267, 317, 414, 1000}));
}

// The expected move, from a list of the ramp's intervals: an oracle without a state machine.
template <class Ramp>
Intervals expected(Ramp ramp, uint32_t start, uint32_t cruise, uint32_t steps) {
  const uint32_t top = std::max<uint32_t>(cruise, ramp.fastest());
  if (top >= start && start > 0) return Intervals(steps, top);
  if (start > 0) {
    for (Ramp next = ramp; next.interval() >= start; next.rise()) ramp = next;
  }
  Intervals up;
  while (up.size() < (steps + 1) / 2) {
    up.push_back(std::max(top, static_cast<uint32_t>(ramp.interval())));
    if (ramp.interval() > top) ramp.rise();
  }
  Intervals whole(up);
  for (std::size_t i = steps / 2; i-- > 0;) whole.push_back(up[i]);
  return whole;
}

TEST(RampMove, of_random_rates_and_length_is_the_ramp_and_its_mirror) {
  std::mt19937_64 random(test::seed());
  const auto up_to = [&](uint64_t most) { return static_cast<uint32_t>(random() % most + 1); };
  for (int run = 0; run < 20'000; ++run) {
    const uint32_t first = up_to(65'535);
    const uint32_t start = random() % 3 == 0 ? 0 : up_to(first);
    const uint32_t cruise = up_to(random() % 2 == 0 ? first : first / 10 + 1);
    const uint32_t steps = up_to(random() % 2 == 0 ? 20 : 1500);
    const auto signed_steps = static_cast<int32_t>(steps);
    ASSERT_EQ(play(table_of(first), start, cruise, signed_steps), expected(table_of(first), start, cruise, steps))
        << first << " " << start << " " << cruise << " " << steps;
    const ExactRamp exact(uint64_t{first} * first);
    ASSERT_EQ(play(exact, start, cruise, signed_steps), expected(exact, start, cruise, steps))
        << first << " " << start << " " << cruise << " " << steps;
  }
}

// Plays a move with random requests in between, and counts on its own.
template <class Ramp, class Count>
void expect_a_safe_walk(RampMove<Ramp, Count> move, uint32_t start, const Intervals& ramp, std::mt19937_64& random) {
  int64_t position = 0;
  int64_t target = static_cast<int64_t>(random() % 4000) - 2000;
  move.move_to(static_cast<int32_t>(target));
  uint32_t before = 0;  // 0: at rest
  bool was_up = true;
  bool stopped = false;
  for (int events = 0; !move.done();) {
    const uint32_t interval = move.next();
    position += move.up() ? 1 : -1;
    ASSERT_EQ(move.position(), position);
    // At rest are: before the first step, after the last, and at a turn. Each interval there is inside the region.
    if (before == 0 || was_up != move.up()) {
      ASSERT_GE(interval, start);
      ASSERT_TRUE(before == 0 || before >= start);
    } else {
      // The two intervals are neighbours on the ramp, or equal.
      const auto larger = std::ranges::upper_bound(ramp, std::max(interval, before), std::greater<>());
      const auto smaller = std::ranges::lower_bound(ramp, std::min(interval, before), std::greater<>());
      ASSERT_LE(smaller - larger, 0) << before << " then " << interval;
    }
    before = interval;
    was_up = move.up();
    if (events < 6 && random() % 150 == 0) {
      ++events;
      stopped = random() % 2 == 0;
      if (stopped) {
        move.stop();
      } else {
        target = static_cast<int64_t>(random() % 4000) - 2000;
        move.move_to(static_cast<int32_t>(target));
      }
    }
  }
  ASSERT_TRUE(before == 0 || before >= start);
  if (!stopped) {
    ASSERT_EQ(position, target);
  }
}

TEST(RampMove, stopped_and_turned_at_random_steps_it_keeps_to_the_ramp_and_its_count) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 5000; ++run) {
    const auto first = static_cast<uint32_t>(random() % 60'000 + 5000);
    Intervals ramp;
    Table table = table_of(first);
    for (int i = 0; i < 300; ++i, table.rise()) ramp.push_back(table.interval());
    const auto start = static_cast<uint16_t>(random() % 2 == 0 ? 0 : ramp[random() % 40] - random() % 10);
    const uint16_t cruise = static_cast<uint16_t>(ramp[40 + random() % 200]);
    std::replace_if(
        ramp.begin(), ramp.end(), [&](uint32_t c) { return c < cruise; }, cruise);
    RampMove<Table> wide(table_of(first));
    ASSERT_TRUE(wide.set_rates(start, cruise));
    expect_a_safe_walk(wide, start, ramp, random);
    RampMove<Table, uint16_t> narrow(table_of(first));
    ASSERT_TRUE(narrow.set_rates(start, cruise));
    expect_a_safe_walk(narrow, start, ramp, random);
  }
}

TEST(RampMove, a_stop_takes_no_more_steps_than_the_ramp_had_gone_up) {
  std::mt19937_64 random(test::seed());
  for (int run = 0; run < 2000; ++run) {
    RampMove<ExactRamp> move(ExactRamp(100'000'000));
    ASSERT_TRUE(move.set_rates(0, 200));
    move.move_to(5000);
    const auto taken = static_cast<int32_t>(random() % 4999 + 1);
    for (int32_t i = 0; i < taken; ++i) move.next();
    move.stop();
    const auto way = static_cast<int32_t>(play(move).size());
    EXPECT_LE(way, taken + 1);
    EXPECT_LE(way, 5000 - taken);
    EXPECT_LE(way, 626);  // (10 000 / 2·200)²: all of the ramp
  }
}

TEST(RampMove, of_a_thousand_million_steps_counts_them_all) {
  RampMove<Table> move(table_of(100));
  ASSERT_TRUE(move.set_rates(0, 10));
  move.move_to(1'000'000'000);
  for (int i = 0; i < 1000; ++i) move.next();
  EXPECT_EQ(move.position(), 1000);
  move.move_to(-1'000'000'000);
  for (int i = 0; i < 1000; ++i) move.next();
  EXPECT_FALSE(move.up());
  move.stop();
  play(move);
  EXPECT_TRUE(move.done());
}

}  // namespace
}  // namespace passo
