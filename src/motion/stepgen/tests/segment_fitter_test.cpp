// SegmentFitter at the board's highest rate, where a board that is late can make up for it only little by little.
#include "segment_fitter.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr std::int64_t shortest_interval = 297 * whole_tick;

// A motor that makes some steps at nearly the highest rate and then brakes. The first of them was due `late` before the
// board can make it.
struct Late {
  EventBuffer events;
  BoardModel board{1};
  unsigned until_in_time = 0;

  Late(unsigned steps, std::int64_t late) {
    constexpr unsigned fast_steps = 20;
    std::array<double, max_motors> places{};
    places[0] = static_cast<double>(board.position(0));
    events.restart(places);
    std::int64_t time = board.time() + shortest_interval - late;
    std::int64_t interval = shortest_interval + whole_tick / 4;
    std::int64_t possible = board.time();
    for (unsigned i = 1; i <= steps; ++i, time += interval) {
      places[0] += static_cast<double>(whole_step);
      events.push(time, places, 1);
      if (i > fast_steps) interval += whole_tick / 4;
      possible += shortest_interval;
      if (until_in_time == 0 && possible <= time) until_in_time = i;
    }
  }
};

// Neither the steep beginning nor the bend behind it suits a quadratic. There was a segment for each event.
TEST(SegmentFitter, makes_up_for_lateness_at_the_highest_rate_in_one_segment) {
  for (const int ticks : {10, 27, 100}) {
    Late late(400, ticks * whole_tick);
    SegmentFitter fitter(1, shortest_interval, true);
    fitter.loosen_to(2, 2047);
    BoardSegment segment;
    EXPECT_EQ(fitter.fit(late.events, {}, late.board, segment), late.until_in_time) << ticks;
    EXPECT_GT(segment.events, 20) << ticks;
    EXPECT_EQ(segment.interval, shortest_interval);
    EXPECT_EQ(segment.change, 0);
  }
}

TEST(SegmentFitter, knows_nothing_of_what_follows_the_events_that_it_has) {
  Late late(5, 10 * whole_tick);
  SegmentFitter fitter(1, shortest_interval, true);
  fitter.loosen_to(2, 2047);
  BoardSegment segment;
  EXPECT_EQ(fitter.fit(late.events, {}, late.board, segment), 5U);
}

}  // namespace
}  // namespace passo
