// Compares the sums of BoardModel with the board's own Player, which plays event by event.
#include "board_model.hpp"

#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/firmware/player.hpp"

namespace passo {
namespace {

class Segments {
 public:
  BoardSegment draw(unsigned motors) {
    BoardSegment segment;
    segment.events = static_cast<std::uint8_t>(between(1, 255));
    segment.interval = static_cast<std::uint32_t>(between(80 * whole_tick, 65535 * whole_tick));
    // The change is so small that the interval stays in its range up to the end of the segment.
    const std::int64_t room = std::min<std::int64_t>(segment.interval, 65535 * whole_tick - segment.interval);
    const std::int64_t most = std::min<std::int64_t>(room / segment.events, largest_change);
    segment.change = static_cast<std::int32_t>(between(-most, most));
    for (unsigned m = 0; m < motors; ++m) {
      segment.increments[m] = static_cast<std::uint16_t>(between(0, 3) == 0 ? 0 : between(0, 65535));
      if (between(0, 1) == 1) segment.flips = static_cast<std::uint8_t>(segment.flips | 1U << m);
      if (between(0, 1) == 1) segment.directions = static_cast<std::uint8_t>(segment.directions | 1U << m);
    }
    return segment;
  }

 private:
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  std::mt19937_64 random_{test::seed()};
};

TEST(BoardModel, knows_to_the_last_bit_where_the_player_is_after_any_segments) {
  constexpr std::uint8_t motors = max_motors;
  Segments segments;
  BoardModel model(motors);
  Player player(motors);
  std::array<std::int64_t, motors> steps{};
  std::int64_t ticks = 0;
  for (unsigned m = 0; m < motors; ++m) model.set_steps(m, steps[m] = m * 1000 - 3000);
  for (int n = 0; n < 5000; ++n) {
    const BoardSegment segment = segments.draw(motors);
    model.play(segment);
    for (player.load(segment); !player.done();) {
      ticks += player.wait();
      const unsigned stepped = player.play();
      for (unsigned m = 0; m < motors; ++m) {
        if ((stepped >> m & 1U) != 0) steps[m] += (segment.directions >> m & 1U) != 0 ? -1 : 1;
      }
    }
    ASSERT_EQ(model.time(), (ticks << 16) + player.tick_fraction()) << "segment " << n;
    for (unsigned m = 0; m < motors; ++m) {
      ASSERT_EQ(model.position(m), steps[m] * whole_step + player.accumulator(static_cast<std::uint8_t>(m)))
          << "segment " << n << ", motor " << m;
    }
  }
}

}  // namespace
}  // namespace passo
