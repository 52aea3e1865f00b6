// Compares the sums of BoardModel with the board's own Player, which plays event by event.
#include "board_model.hpp"

#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/firmware/board.hpp"
#include "passo/wire/segment_parts.hpp"

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
  // In parts, the change of the interval a root, or motors bent.
  BoardSegment draw_in_parts(unsigned motors) {
    BoardSegment segment = draw(motors);
    segment.events = static_cast<std::uint16_t>(between(1, most_events));
    segment.interval = static_cast<std::uint32_t>(between(1000 * whole_tick, 2000 * whole_tick));
    segment.form = static_cast<std::uint8_t>(between(0, 15));
    segment.change = static_cast<std::int32_t>(between(-whole_tick / 8, whole_tick / 8));
    if (is_root(segment.form)) {
      const std::int64_t parts = segment.events / part_length(segment.form) + 1;
      segment.change = static_cast<std::int32_t>((std::int64_t{1} << 31) / (between(3, 100) + parts));
      if (between(0, 1) == 1) segment.change = -segment.change;
      if (!is_fine(segment.change)) segment.change -= segment.change % coarse_change;
    }
    if (between(0, 2) == 0) return segment;
    const auto lender = static_cast<unsigned>(between(0, motors - 1));
    const bool two = motors >= least_motors_to_bend_two && between(0, 1) == 0;
    const auto bent = static_cast<unsigned>(two ? between(1, largest_scale) : between(0, motors - 1));
    if (!two && bent == lender) return segment;
    segment.bend = static_cast<std::uint8_t>(bent | lender << bend_shift<max_motors>);
    segment.flips = static_cast<std::uint8_t>((segment.flips & ~(1U << lender)) | (two ? 1U << lender : 0U));
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

// Counts steps and ticks, and says nothing.
struct Counters {
  std::array<std::int64_t, max_motors> steps{};
  void step(std::uint8_t stepped, std::uint8_t directions) {
    for (unsigned m = 0; m < max_motors; ++m) {
      if ((stepped >> m & 1U) != 0) steps[m] += (directions >> m & 1U) != 0 ? -1 : 1;
    }
  }
  void outputs(const BoardOutputs& /*outputs*/) {}
  void send(std::uint8_t /*byte*/) {}
  static std::uint8_t room() { return 0xFF; }
};

// A board with room for eight motors, and one as small as a chip's, which packs its segments.
template <std::uint8_t motors>
void compare_board_and_model() {
  Counters counters;
  Board<Counters, 32, Player, motors> board(counters, {.motors = motors, .clock = 16'000'000});
  std::uint8_t frame[largest_frame];
  const auto send = [&](std::uint8_t size) {
    for (std::uint8_t i = 0; i < size; ++i) board.receive(frame[i]);
  };
  send(encode(Hello{.motors = motors}, 0, frame));
  BoardModel model(motors);
  Segments segments;
  std::int64_t ticks = 0;
  for (int n = 0; n < 2000; ++n) {
    const BoardSegment segment = segments.draw_in_parts(motors);
    send(encode(segment, motors, static_cast<std::uint8_t>(n + 1), frame));
    ASSERT_FALSE(board.idle()) << "segment " << n << " was refused";
    model.play(segment);
    while (!board.idle()) {
      ticks += board.ticks_to_next_event();
      board.on_event();
    }
    ASSERT_EQ(model.time() >> 16, ticks) << "segment " << n << ", form " << unsigned{segment.form};
    for (unsigned m = 0; m < motors; ++m) {
      ASSERT_EQ(model.position(m) >> 16, counters.steps[m]) << "segment " << n << ", motor " << m;
    }
  }
}

TEST(BoardModel, knows_where_a_board_is_after_segments_in_parts_with_roots_and_bends) {
  compare_board_and_model<8>();
  compare_board_and_model<4>();
  compare_board_and_model<3>();
}

}  // namespace
}  // namespace passo
