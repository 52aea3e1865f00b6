#include "passo/firmware/player.hpp"

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "kit/seed.hpp"

namespace passo {
namespace {

struct Played {
  std::vector<std::uint32_t> ticks;
  std::vector<std::uint8_t> stepped;
};
Played play(Player& player, const BoardSegment& segment) {
  Played played;
  player.load(segment);
  while (!player.done()) {
    played.ticks.push_back(player.wait());
    played.stepped.push_back(player.play());
  }
  return played;
}

TEST(Player, plays_as_many_events_as_the_segment_has) {
  Player player(1);
  EXPECT_TRUE(player.done());
  EXPECT_EQ(play(player, {.events = 1, .interval = 100 << 16}).ticks.size(), 1U);
  EXPECT_EQ(play(player, {.events = 255, .interval = 100 << 16}).ticks.size(), 255U);
}

TEST(Player, the_fraction_of_a_tick_runs_on_from_segment_to_segment) {
  Player player(1);
  const BoardSegment segment{.events = 1, .interval = 100 * 65536 + 0x4000};  // 100.25 ticks
  std::vector<std::uint32_t> ticks;
  for (int i = 0; i < 8; ++i) ticks.push_back(play(player, segment).ticks[0]);
  EXPECT_THAT(ticks, testing::ElementsAre(100, 101, 100, 100, 100, 101, 100, 100));
}

TEST(Player, each_interval_is_longer_than_the_one_before_by_the_change) {
  Player player(1);
  EXPECT_THAT(play(player, {.events = 4, .interval = 50 << 16, .change = 3 * 65536}).ticks,
              testing::ElementsAre(50, 53, 56, 59));
  EXPECT_THAT(play(player, {.events = 3, .interval = 50 << 16, .change = -20 * 65536}).ticks,
              testing::ElementsAre(50, 30, 10));
}

TEST(Player, a_whole_increment_is_a_step_at_every_event_in_both_directions) {
  Player player(2);
  const Played played = play(player, {.events = 5, .directions = 2, .flips = 3, .interval = 1 << 16});
  EXPECT_THAT(played.stepped, testing::Each(3));
  EXPECT_EQ(player.directions(), 2);
}

TEST(Player, an_increment_of_nothing_is_no_step) {
  Player player(8);
  EXPECT_THAT(play(player, {.events = 9, .interval = 1 << 16}).stepped, testing::Each(0));
}

TEST(Player, a_third_of_a_step_an_event_steps_at_every_third_with_the_first_one_half_way) {
  Player player(1);
  BoardSegment segment{.events = 9, .interval = 1 << 16};
  segment.increments[0] = 21846;
  EXPECT_THAT(play(player, segment).stepped, testing::ElementsAre(0, 1, 0, 0, 1, 0, 0, 1, 0));
}

// The definition in board_segment.hpp: a position that never wraps, and a step where its whole part changes.
TEST(Player, steps_where_the_whole_part_of_the_position_changes) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int64_t> any_increment(-whole_step, whole_step);
  for (std::uint8_t motors = 1; motors <= max_motors; ++motors) {
    Player player(motors);
    std::vector<std::int64_t> position(motors, whole_step / 2);
    for (int i = 0; i < 300; ++i) {
      BoardSegment segment{.events = static_cast<std::uint8_t>(1 + random() % 255), .interval = 160 << 16};
      std::vector<std::int64_t> increments(motors);
      for (unsigned m = 0; m < motors; ++m) {
        increments[m] =
            random() % 4 == 0 ? static_cast<std::int64_t>(random() % 3 - 1) * whole_step : any_increment(random);
        const auto bit = static_cast<std::uint8_t>(1U << m);
        segment.increments[m] = static_cast<std::uint16_t>(increments[m]);
        if (increments[m] < 0) segment.directions |= bit;
        if (increments[m] < 0 || increments[m] == whole_step) segment.flips |= bit;
      }
      const Played played = play(player, segment);
      for (const std::uint8_t stepped : played.stepped) {
        for (unsigned m = 0; m < motors; ++m) {
          const std::int64_t whole = position[m] >> 16;
          position[m] += increments[m];
          ASSERT_EQ((stepped >> m & 1) != 0, position[m] >> 16 != whole) << "motor " << m << " segment " << i;
        }
        ASSERT_EQ(stepped >> motors, 0);
      }
      for (std::uint8_t m = 0; m < motors; ++m) {
        ASSERT_EQ(player.accumulator(m), static_cast<std::uint16_t>(position[m]));
      }
    }
  }
}

}  // namespace
}  // namespace passo
