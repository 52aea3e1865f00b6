#include "board_bench.hpp"

namespace passo {
namespace {

// The player counts only up to 255, so it gets such a segment in parts. The joints of the parts must not show.
class LongSegmentTest : public BoardTest {
 protected:
  static constexpr std::uint16_t events = 600;
  static constexpr std::int64_t interval = 100 << 16;
  static constexpr std::int64_t change = 8192;
  static constexpr std::uint16_t increment = 0x5555;

  void SetUp() override {
    greet();
    bench_.decoder.set_motors(3);
    BoardSegment segment{.events = events,
                         .flips = 1,
                         .interval = static_cast<std::uint32_t>(interval),
                         .change = static_cast<std::int32_t>(change)};
    segment.increments[1] = increment;
    send(segment, std::uint8_t{3}, std::uint8_t{1});
  }
  BoardStatus status() {
    send(Ask{.motors = 3}, std::uint8_t{0});
    BoardStatus status;
    decode(bench_.replies.back(), 3, status);
    return status;
  }
};

TEST_F(LongSegmentTest, is_played_event_by_event_as_one) {
  std::int64_t before = 0;
  for (std::int64_t k = 1; k <= events; ++k) {
    ASSERT_FALSE(board_.idle());
    event();
    const std::int64_t due = k * interval + change * (k * (k - 1) / 2);
    EXPECT_EQ(bench_.now, (due + 0x8000) >> 16) << k;
    const std::int64_t steps = (k * increment + 0x8000) >> 16;
    EXPECT_EQ(bench_.log.back(), std::to_string(bench_.now) + " step " + (steps > before ? "3" : "1") + " down 0");
    before = steps;
  }
  EXPECT_TRUE(board_.idle());
  board_.report();
  EXPECT_EQ(last_credit().executed, 1);
}

TEST_F(LongSegmentTest, is_one_item_wherever_it_is_asked_for) {
  for (std::uint16_t k = 1; k < events; ++k) {
    event();
    const BoardStatus now = status();
    ASSERT_EQ(now.event, k);
    ASSERT_EQ(now.positions[0], k);
    ASSERT_EQ(now.positions[1], (k * increment + 0x8000) >> 16);
    ASSERT_EQ(now.executed, 0);
    ASSERT_EQ(now.free, capacity - 1);
  }
  event();
  EXPECT_EQ(status().executed, 1);
  EXPECT_EQ(status().free, capacity);
  EXPECT_EQ(status().positions[0], events);
}

TEST_F(LongSegmentTest, is_broken_off_in_a_later_part) {
  for (int k = 0; k < 400; ++k) event();
  board_.stop_at_once(input_limit);
  Fault fault;
  decode(bench_.replies.back(), fault);
  EXPECT_EQ(fault.event, 400);
  EXPECT_TRUE(board_.idle());
  EXPECT_EQ(status().positions[0], 400);
  EXPECT_EQ(status().free, capacity);
}

}  // namespace
}  // namespace passo
