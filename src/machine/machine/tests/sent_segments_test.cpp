// The pulses that SentSegments tells are those of the board's own player.
#include "passo/link/sent_segments.hpp"

#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/firmware/player.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo {
namespace {

constexpr Hertz rate(1e6);
constexpr Seconds whole_time(1e9);

BoardSegment drawn_segment(std::mt19937_64& random) {
  const auto between = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  BoardSegment segment;
  segment.events = static_cast<std::uint16_t>(between(1, 600));
  segment.interval =
      static_cast<std::uint32_t>(between(60, 90)) * 65536 + static_cast<std::uint32_t>(between(0, 65535));
  segment.form = static_cast<std::uint8_t>(between(0, 1) == 0 ? 0 : root_form + between(2, 7));
  segment.change = segment.form == 0 ? between(-1000, 1000) : between(-1'000'000, 1'000'000);
  for (std::uint16_t& increment : segment.increments) increment = static_cast<std::uint16_t>(between(0, 65535));
  segment.directions = static_cast<std::uint8_t>(between(0, 255));
  segment.flips = segment.directions;  // as increments below a step down
  return segment;
}

TEST(SentSegments, tell_the_pulses_of_the_player_to_the_tick) {
  std::mt19937_64 random(test::seed());
  SentSegments sent;
  sent.keep(rate);
  sent.begin(max_motors);
  Player player(max_motors);
  std::vector<BoardPulse> played;
  std::int64_t ticks = 0;
  for (std::uint16_t number = 1; number <= 50; ++number) {
    const BoardSegment segment = drawn_segment(random);
    sent.add(number, segment, Seconds(0));
    for_each_plain_part(segment, [&](const BoardSegment& part) {
      for (player.load(part); !player.done();) {
        ticks += player.wait();
        const std::uint8_t stepped = player.play();
        if (stepped != 0)
          played.push_back({Seconds(static_cast<double>(ticks) / rate.value()), stepped, part.directions});
      }
    });
  }
  const PulseWindow all = sent.window(Seconds(0), whole_time, whole_time, played.size());
  ASSERT_EQ(all.pulses.size(), played.size());
  for (std::size_t i = 0; i < played.size(); ++i) {
    ASSERT_NEAR(all.pulses[i].time.value(), played[i].time.value(), 1e-9) << i;
    ASSERT_EQ(all.pulses[i].stepped, played[i].stepped) << i;
    ASSERT_EQ(all.pulses[i].directions, played[i].directions) << i;
  }
  // A window amid them has the same pulses, and its counts are what came before.
  const std::size_t first = played.size() / 3;
  const PulseWindow some = sent.window(all.pulses[first].time, all.pulses[2 * first].time, whole_time, 100);
  ASSERT_EQ(some.pulses.size(), 100U);
  EXPECT_EQ(some.pulses.front().time, all.pulses[first].time);
  EXPECT_EQ(some.end, some.pulses.back().time);
  std::array<std::int32_t, max_motors> counts{};
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t motor = 0; motor < max_motors; ++motor) {
      if ((played[i].stepped >> motor & 1U) != 0) counts[motor] += (played[i].directions >> motor & 1U) != 0 ? -1 : 1;
    }
  }
  EXPECT_EQ(some.counts, counts);
}

TEST(SentSegments, know_no_pulse_later_than_now_and_none_that_was_replaced) {
  const BoardSegment tenth{.events = 100, .interval = 1000U << 16, .increments = {0}};
  BoardSegment steps = tenth;
  steps.flips = 1;
  SentSegments sent;
  sent.add(1, steps, Seconds(0));
  EXPECT_TRUE(sent.window(Seconds(0), whole_time, whole_time, 9999).pulses.empty());  // it keeps none
  sent.keep(rate);
  sent.begin(1);
  sent.add(1, steps, Seconds(5));
  sent.add(2, steps, Seconds(5));
  EXPECT_EQ(sent.window(Seconds(0), whole_time, Seconds(5.0505), 9999).pulses.size(), 50U);
  EXPECT_EQ(sent.window(Seconds(0), whole_time, whole_time, 9999).pulses.size(), 200U);
  sent.drop_behind(1);
  sent.add(2, tenth, Seconds(5.01));
  sent.add(3, steps, Seconds(7));  // after a rest
  const PulseWindow window = sent.window(Seconds(0), whole_time, whole_time, 9999);
  ASSERT_EQ(window.pulses.size(), 200U);
  EXPECT_NEAR(window.oldest.value(), 5, 1e-6);
  EXPECT_NEAR(window.pulses[99].time.value(), 5.1, 1e-6);
  EXPECT_NEAR(window.pulses[100].time.value(), 7.001, 1e-6);
}

TEST(SentSegments, end_where_the_probe_has_stopped_the_board) {
  const BoardSegment tenth{.events = 100, .flips = 1, .interval = 1000U << 16};
  SentSegments sent;
  sent.keep(rate);
  sent.begin(1);
  for (std::uint16_t number = 1; number <= 3; ++number) sent.add(number, tenth, Seconds(0));
  sent.stop(Seconds(0.1505));
  EXPECT_EQ(sent.window(Seconds(0), whole_time, whole_time, 9999).pulses.size(), 150U);
  const std::int32_t told[max_motors] = {148};
  sent.stand_at(told);
  sent.add(4, tenth, Seconds(1));
  const PulseWindow window = sent.window(Seconds(1), whole_time, whole_time, 9999);
  EXPECT_EQ(window.pulses.size(), 100U);
  EXPECT_EQ(window.counts[0], 148);
}

TEST(SentSegments, keep_the_last_ones) {
  const BoardSegment one{.events = 1, .flips = 1, .interval = 1000U << 16};
  SentSegments sent;
  sent.keep(rate);
  sent.begin(1);
  for (std::size_t i = 0; i < 2 * SentSegments::most; ++i) sent.add(static_cast<std::uint16_t>(i), one, Seconds(0));
  const PulseWindow window = sent.window(Seconds(0), whole_time, whole_time, 99'999);
  EXPECT_EQ(window.pulses.size(), SentSegments::most);
  EXPECT_EQ(window.counts[0], static_cast<std::int32_t>(SentSegments::most));
  EXPECT_TRUE(sent.window(Seconds(1), whole_time, whole_time, 0).pulses.empty()) << "nobody wants one";
}

}  // namespace
}  // namespace passo
