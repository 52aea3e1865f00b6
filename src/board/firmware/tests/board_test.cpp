#include "board_bench.hpp"

namespace passo {
namespace {

TEST_F(BoardTest, answers_a_hello_with_what_it_is) {
  send(Hello{.motors = 3}, std::uint8_t{9});
  ASSERT_EQ(bench_.replies.size(), 1U);
  ASSERT_EQ(bench_.replies[0].type, MessageType::hello_reply);
  HelloReply reply;
  decode(bench_.replies[0], reply);
  EXPECT_EQ(reply.version, protocol_version);
  EXPECT_EQ(reply.motors, 4);
  EXPECT_EQ(reply.capacity, capacity);
  EXPECT_EQ(reply.clock, 16'000'000U);
}

TEST_F(BoardTest, takes_no_segment_before_it_has_agreed_with_the_host) {
  send_segment(1);
  EXPECT_TRUE(board_.idle());
  send(Hello{.motors = 5}, std::uint8_t{0});  // more motors than it has
  send_segment(1);
  EXPECT_TRUE(board_.idle());
  send(Hello{.version = 1, .motors = 3}, std::uint8_t{0});
  send_segment(1);
  EXPECT_TRUE(board_.idle());
  greet();
  send_segment(1);
  EXPECT_FALSE(board_.idle());
}

TEST_F(BoardTest, plays_segments_one_after_the_other_without_delay) {
  greet();
  send_segment(1, 2, 10);
  send_segment(2, 1, 7);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "20 step 1 down 0", "27 step 1 down 0"));
}

TEST_F(BoardTest, switches_outputs_in_order_at_the_event_before_them) {
  greet();
  send_segment(1, 2, 10);
  send(BoardOutputs{.switches = spindle_on, .spindle_rpm = 8000}, std::uint8_t{2});
  send(BoardOutputs{.switches = 0}, std::uint8_t{3});
  send_segment(4, 1, 5);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "20 step 1 down 0", "20 outputs 1 rpm 8000",
                                               "20 outputs 0 rpm 0", "25 step 1 down 0"));
}

TEST_F(BoardTest, switches_outputs_at_once_when_idle) {
  greet();
  send(BoardOutputs{.switches = flood_on}, std::uint8_t{1});
  EXPECT_THAT(bench_.log, testing::ElementsAre("0 outputs 8 rpm 0"));
  EXPECT_TRUE(board_.idle());
  EXPECT_TRUE(board_.owes_report());
}

TEST_F(BoardTest, goes_idle_when_its_queue_runs_empty_and_on_with_the_next_segment) {
  greet();
  send_segment(1);
  play_to_the_end();
  EXPECT_TRUE(board_.idle());
  send_segment(2);
  EXPECT_FALSE(board_.idle());
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 2U);
}

TEST_F(BoardTest, reports_how_far_it_has_come_and_how_much_room_there_is) {
  greet(250);
  for (std::uint8_t sequence = 251; sequence <= 253; ++sequence) send_segment(sequence);
  EXPECT_FALSE(board_.owes_report());
  event();
  ASSERT_TRUE(board_.owes_report());
  board_.report();
  EXPECT_FALSE(board_.owes_report());
  EXPECT_EQ(last_credit().executed, 251);
  EXPECT_EQ(last_credit().free, 2);
  event();
  event();
  board_.report();
  EXPECT_EQ(last_credit().executed, 253);
  EXPECT_EQ(last_credit().free, capacity);
}

TEST_F(BoardTest, counts_sequence_numbers_past_255) {
  greet(254);
  for (unsigned i = 0; i < 600; ++i) {
    send_segment(static_cast<std::uint8_t>(255 + i));
    play_to_the_end();
  }
  EXPECT_EQ(bench_.log.size(), 600U);
  EXPECT_TRUE(bench_.replies.empty());
}

TEST_F(BoardTest, takes_nothing_after_a_gap_until_the_missing_item_comes_and_says_so_once) {
  greet();
  send_segment(1);
  send_segment(3);
  send_segment(4);
  ASSERT_EQ(bench_.replies.size(), 1U);
  EXPECT_EQ(last_error().reason, WireError::out_of_sequence);
  EXPECT_EQ(last_error().expected, 2);
  send_segment(2);
  send_segment(3);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 3U);
  EXPECT_EQ(bench_.replies.size(), 1U);
}

TEST_F(BoardTest, answers_a_repeated_item_with_a_credit_and_does_not_play_it_again) {
  greet();
  send_segment(1);
  play_to_the_end();
  board_.report();
  bench_.replies.clear();
  send_segment(1);
  EXPECT_TRUE(board_.idle());
  EXPECT_EQ(last_credit().executed, 1);
}

TEST_F(BoardTest, refuses_a_garbled_segment_and_takes_it_when_it_is_repeated) {
  greet();
  std::uint8_t frame[largest_frame];
  const std::uint8_t size = encode(BoardSegment{.events = 1, .flips = 1, .interval = 1 << 16}, 3, 1, frame);
  frame[7] ^= 4;
  send_bytes(frame, size);
  EXPECT_TRUE(board_.idle());
  EXPECT_EQ(last_error().reason, WireError::bad_frame);
  EXPECT_EQ(last_error().expected, 1);
  frame[7] ^= 4;
  send_bytes(frame, size);
  EXPECT_FALSE(board_.idle());
}

TEST_F(BoardTest, refuses_an_item_that_it_has_no_room_for) {
  greet();
  for (std::uint8_t sequence = 1; sequence <= capacity; ++sequence) send_segment(sequence);
  EXPECT_TRUE(bench_.replies.empty());
  send_segment(capacity + 1);
  EXPECT_EQ(last_error().reason, WireError::queue_full);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), capacity);
  send_segment(capacity + 1);
  EXPECT_FALSE(board_.idle());
}

TEST_F(BoardTest, refuses_a_segment_without_events_or_for_a_motor_that_is_not_there) {
  greet();
  send_segment(1, 0);
  EXPECT_EQ(last_error().reason, WireError::bad_value);
  greet();
  send(BoardSegment{.events = 1, .flips = 8, .interval = 1 << 16}, std::uint8_t{3}, std::uint8_t{1});
  EXPECT_EQ(last_error().reason, WireError::bad_value);
  EXPECT_TRUE(board_.idle());
}

// 100 ticks at a rate that gives 101: the host's rounding may take one less.
TEST(SlowBoard, refuses_a_segment_that_is_faster_than_it_states_at_its_start_or_its_end) {
  Bench bench;
  Board<Bench, capacity> board(
      bench, {.motors = 1, .clock = 1'010'000, .shortest_interval = shortest_interval(1'010'000, 10'000)});
  constexpr std::uint32_t tick = 1 << 16;
  constexpr std::uint32_t shortest = 100 * tick;
  const auto refused = [&](const BoardSegment& segment) {
    std::uint8_t frame[largest_frame];
    const auto send = [&](std::uint8_t size) {
      for (std::uint8_t i = 0; i < size; ++i) board.receive(frame[i]);
    };
    while (!board.idle()) board.on_event();
    send(encode(Hello{.motors = 1}, 0, frame));
    bench.replies.clear();
    send(encode(segment, 1, 1, frame));
    if (bench.replies.empty()) return false;
    ErrorReport error;
    decode(bench.replies.back(), error);
    EXPECT_EQ(error.reason, WireError::bad_value);
    EXPECT_TRUE(board.idle());
    return true;
  };
  EXPECT_FALSE(refused({.events = 9, .interval = shortest}));
  EXPECT_TRUE(refused({.events = 9, .interval = shortest - 1}));
  EXPECT_TRUE(refused({.events = 9, .interval = shortest - 1, .change = 1000}));
  EXPECT_FALSE(refused({.events = 9, .interval = shortest + 8 * tick, .change = -static_cast<std::int32_t>(tick)}));
  EXPECT_TRUE(refused({.events = 10, .interval = shortest + 8 * tick, .change = -static_cast<std::int32_t>(tick)}));
  EXPECT_FALSE(refused({.events = 255, .interval = shortest + 254 * 0x7fffff, .change = -fine_change}));
  EXPECT_TRUE(refused({.events = 255, .interval = shortest + 254 * 0x7fffff - 1, .change = -fine_change}));
  // A product of more than 32 bits.
  EXPECT_FALSE(
      refused({.events = 1001, .interval = shortest + 1000 * tick, .change = -static_cast<std::int32_t>(tick)}));
  EXPECT_TRUE(
      refused({.events = 1002, .interval = shortest + 1000 * tick, .change = -static_cast<std::int32_t>(tick)}));
  EXPECT_TRUE(refused({.events = 513, .interval = shortest + 4, .change = fine_change}));
  EXPECT_TRUE(refused({.events = most_events, .interval = shortest + 4, .change = largest_change}));
  EXPECT_FALSE(refused({.events = 2, .interval = shortest + 4, .change = largest_change}));
  // Beyond 32 bits, intervals would start again at the shortest.
  EXPECT_FALSE(refused({.events = 9, .interval = largest_interval - 8 * tick, .change = tick}));
  EXPECT_TRUE(refused({.events = 9, .interval = largest_interval - 8 * tick + 1, .change = tick}));
}

TEST_F(BoardTest, refuses_a_hello_amid_motion_and_goes_on) {
  greet();
  send_segment(1, 3);
  event();
  send(Hello{.motors = 3}, std::uint8_t{77});
  EXPECT_EQ(last_error().reason, WireError::unexpected);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 3U);
}

TEST_F(BoardTest, starts_fractions_afresh_with_each_hello) {
  BoardSegment half{.events = 1, .interval = 10 << 16};
  half.increments[0] = 0x8000;
  for (int session = 0; session < 3; ++session) {
    greet();
    bench_.log.clear();
    send(half, std::uint8_t{3}, std::uint8_t{1});
    play_to_the_end();
    EXPECT_EQ(bench_.log.size(), 1U);  // starting at one half, half a step makes a whole one
  }
}

TEST_F(BoardTest, takes_nothing_while_its_emergency_stop_is_pressed) {
  board_.set_inputs(input_emergency_stop);
  send(Hello{.motors = 3}, std::uint8_t{0});
  ASSERT_EQ(bench_.replies.size(), 2U);
  EXPECT_EQ(bench_.replies[0].type, MessageType::hello_reply);
  EXPECT_EQ(bench_.replies[1].type, MessageType::fault);
  send_segment(1);
  EXPECT_EQ(last_error().reason, WireError::unexpected);
  EXPECT_TRUE(board_.idle());
  board_.set_inputs(0);
  greet();
  send_segment(1);
  EXPECT_FALSE(board_.idle());
}

}  // namespace
}  // namespace passo
