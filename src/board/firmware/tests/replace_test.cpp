// Replacing the items that a board holds, and reporting it.
#include "board_bench.hpp"

namespace passo {
namespace {

class ReplaceTest : public BoardTest {
 protected:
  struct Planned {
    std::uint8_t events = 1;
    std::uint32_t ticks = 10;
  };
  // The items must still be sent.
  void send_replace(std::uint16_t number, std::uint16_t after, const std::vector<Planned>& items) {
    Announcement announcement(number, after, 3);
    std::uint8_t frame[largest_frame];
    for (const Planned& item : items) {
      announcement.add(frame, encode(segment_of(item.events, item.ticks), std::uint8_t{3}, std::uint8_t{0}, frame));
    }
    send(announcement.replace(), static_cast<std::uint8_t>(number));
  }
  BoardStatus status() {
    bench_.decoder.set_motors(3);
    bench_.replies.clear();
    send(Ask{.motors = 3}, std::uint8_t{0});
    EXPECT_EQ(bench_.replies.size(), 1U);
    BoardStatus status;
    if (!bench_.replies.empty()) decode(bench_.replies.back(), 3, status);
    return status;
  }
};

TEST_F(ReplaceTest, plays_what_replaces_the_tail_in_its_place) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 1, 100);
  send_replace(3, 1, {{.ticks = 20}, {.ticks = 30}});
  send_segment(4, 1, 20);
  send_segment(5, 1, 30);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "30 step 1 down 0", "60 step 1 down 0"));
  EXPECT_EQ(status().executed, 5);
  EXPECT_EQ(status().free, capacity);
}

TEST_F(ReplaceTest, plays_the_old_tail_while_the_new_one_is_not_complete) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 1, 100);
  send_replace(3, 1, {{.ticks = 20}, {.ticks = 30}});
  send_segment(4, 1, 20);
  EXPECT_EQ(status().state, board_moves | board_trusted | board_replaces);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "110 step 1 down 0"));
  EXPECT_EQ(status().executed, 2);
}

TEST_F(ReplaceTest, says_too_late_where_the_item_behind_has_begun_and_plays_the_tail) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 2, 100);
  event();
  send_replace(3, 1, {{.ticks = 20}});
  send_segment(4, 1, 20);
  EXPECT_EQ(last_error().reason, WireError::too_late);
  EXPECT_EQ(last_error().expected, 5);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 3U);
  EXPECT_EQ(status().executed, 2);
  EXPECT_EQ(status().free, capacity);
  // At rest the motion goes on after the tail's last item.
  send_replace(5, 2, {{.ticks = 20}});
  send_segment(6, 1, 20);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 4U);
  EXPECT_EQ(status().executed, 6);
}

TEST_F(ReplaceTest, refuses_one_behind_an_item_that_was_never_there) {
  greet();
  send_segment(1, 1, 10);
  send_replace(2, 77, {{.ticks = 20}});
  send_segment(3, 1, 20);
  EXPECT_EQ(last_error().reason, WireError::too_late);
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 1U);
}

TEST_F(ReplaceTest, begins_at_rest_behind_the_last_item_done) {
  greet();
  send_replace(1, 0, {{.ticks = 20}});
  send_segment(2, 1, 20);
  ASSERT_TRUE(board_.owes_report());
  play_to_the_end();
  EXPECT_EQ(bench_.log.size(), 1U);
}

TEST_F(ReplaceTest, drops_one_that_was_begun_when_another_begins) {
  greet();
  send_segment(1, 1, 10);
  send_replace(2, 1, {{.ticks = 50}, {.ticks = 50}});
  send_segment(3, 1, 50);
  send_replace(4, 1, {{.ticks = 20}});
  send_segment(5, 1, 20);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "30 step 1 down 0"));
  EXPECT_EQ(status().free, capacity);
}

TEST_F(ReplaceTest, refuses_one_that_it_has_no_room_for_beside_the_old_tail) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 1, 10);
  send_replace(3, 1, {{}, {}, {}});
  EXPECT_EQ(last_error().reason, WireError::queue_full);
  EXPECT_EQ(last_error().expected, 3);
  event();
  send_replace(3, 2, {{}, {}, {}});
  for (std::uint8_t sequence = 4; sequence <= 6; ++sequence) send_segment(sequence);
  play_to_the_end();
  EXPECT_EQ(status().executed, 6);
}

TEST_F(ReplaceTest, changes_nothing_where_an_item_is_another_than_was_sent) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 1, 100);
  send_replace(3, 1, {{.ticks = 20}, {.ticks = 30}});
  send_segment(4, 1, 20);
  send_segment(5, 1, 31);  // as if the segment had deceived the CRC
  EXPECT_EQ(last_error().reason, WireError::wrong_sums);
  EXPECT_EQ(last_error().expected, 6);
  play_to_the_end();
  EXPECT_THAT(bench_.log, testing::ElementsAre("10 step 1 down 0", "110 step 1 down 0"));
  EXPECT_EQ(status().executed, 2);
  EXPECT_EQ(status().free, capacity);
  send_replace(6, 2, {{.ticks = 20}});
  send_segment(7, 1, 20);
  play_to_the_end();
  EXPECT_EQ(status().executed, 7);
}

TEST_F(ReplaceTest, changes_nothing_where_the_announcement_is_another_than_was_sent) {
  greet();
  send_segment(1, 1, 10);
  send_segment(2, 1, 100);
  Announcement announcement(3, 1, 3);
  std::uint8_t frame[largest_frame];
  announcement.add(frame, encode(segment_of(1, 20), std::uint8_t{3}, std::uint8_t{4}, frame));
  Replace replace = announcement.replace();
  replace.after = 2;
  send(replace, std::uint8_t{3});
  send_segment(4, 1, 20);
  EXPECT_EQ(last_error().reason, WireError::wrong_sums);
  play_to_the_end();
  EXPECT_EQ(status().executed, 2);
}

TEST_F(ReplaceTest, moves_nothing_of_a_session_without_sums) {
  greet();
  send(Session{.number = 5}, std::uint8_t{0});
  send_segment(1);
  EXPECT_TRUE(board_.idle());
  EXPECT_TRUE(board_.owes_report());
  EXPECT_EQ(status().taken, 1);
  EXPECT_EQ(status().executed, 0);
  send_replace(2, 0, {{.ticks = 20}});
  send_segment(3, 1, 20);
  play_to_the_end();
  EXPECT_EQ(status().executed, 3);
  EXPECT_EQ(status().positions[0], 1);
}

TEST_F(ReplaceTest, says_which_question_it_answers) {
  greet();
  bench_.decoder.set_motors(3);
  send(Ask{.motors = 3}, std::uint8_t{77});
  BoardStatus status;
  decode(bench_.replies.back(), 3, status);
  EXPECT_EQ(status.answers, 77);
}

TEST_F(ReplaceTest, counts_items_beyond_a_byte) {
  greet();
  std::uint16_t last = 0;
  for (unsigned i = 0; i < 1000; ++i) {
    const auto number = static_cast<std::uint16_t>(2 * i + 1);
    send_replace(number, last, {{}});
    send_segment(static_cast<std::uint8_t>(number + 1));
    last = static_cast<std::uint16_t>(2 * i + 2);
    play_to_the_end();
  }
  EXPECT_EQ(status().executed, 2000);
  EXPECT_EQ(status().positions[0], 1000);
  EXPECT_EQ(status().free, capacity);
}

TEST_F(ReplaceTest, tells_session_positions_and_the_event_within_an_item_on_request) {
  greet();
  send(Session{.number = 0xBEEF}, std::uint8_t{0});
  BoardSegment segment{.events = 200, .directions = 6, .flips = 5, .interval = 10 << 16};
  segment.increments[1] = 0;       // stands still
  segment.increments[2] = 0x9000;  // down, 7/16 of a step at an event
  segment.flips = 5;               // motor 0 up at every event
  Announcement announcement(1, 0, 3);
  std::uint8_t frame[largest_frame];
  announcement.add(frame, encode(segment, std::uint8_t{3}, std::uint8_t{2}, frame));
  send(announcement.replace(), std::uint8_t{1});
  send(segment, std::uint8_t{3}, std::uint8_t{2});
  for (int i = 0; i < 33; ++i) event();
  EXPECT_EQ(status().session, 0xBEEF);
  EXPECT_EQ(status().event, 33);
  EXPECT_EQ(status().executed, 0);
  EXPECT_EQ(status().positions[0], 33);
  EXPECT_EQ(status().positions[1], 0);
  EXPECT_EQ(status().positions[2], -14);  // the floor of 1/2 - 33 * 7/16
  play_to_the_end();
  EXPECT_EQ(status().executed, 2);
  EXPECT_EQ(status().event, 0);
  EXPECT_EQ(status().positions[0], 200);
  EXPECT_EQ(status().positions[2], -87);
  // Asking and returning changes nothing. A hello begins a new session, and positions count on.
  send(Hello{.motors = 3}, std::uint8_t{0});
  EXPECT_EQ(status().session, 0);
  EXPECT_EQ(status().positions[0], 200);
}

TEST_F(ReplaceTest, tells_where_the_motors_are_at_the_event_of_a_touch) {
  greet();
  bench_.decoder.set_motors(3);
  send_segment(1, 20);
  for (int i = 0; i < 7; ++i) event();
  board_.set_inputs(input_probe, input_probe);
  ASSERT_EQ(bench_.replies.size(), 1U);
  ASSERT_EQ(bench_.replies[0].type, MessageType::captured);
  Captured captured;
  decode(bench_.replies[0], 3, captured);
  EXPECT_EQ(captured.input, input_probe);
  EXPECT_EQ(captured.item, 1);
  EXPECT_EQ(captured.event, 7);
  EXPECT_EQ(captured.positions[0], 7);
  EXPECT_EQ(status().inputs, input_probe);
}

TEST_F(ReplaceTest, stops_at_once_in_an_emergency_and_does_not_trust_its_positions) {
  greet();
  send_segment(1, 20);
  send_segment(2, 20);
  for (int i = 0; i < 7; ++i) event();
  board_.stop_at_once(input_emergency_stop);
  EXPECT_TRUE(board_.idle());
  ASSERT_EQ(bench_.replies.back().type, MessageType::fault);
  Fault fault;
  decode(bench_.replies.back(), fault);
  EXPECT_EQ(fault.event, 7);
  EXPECT_EQ(fault.reason, FaultReason::emergency_stop);
  EXPECT_EQ(fault.inputs, input_emergency_stop);
  EXPECT_EQ(status().state, 0);
  EXPECT_EQ(status().positions[0], 7);
  send_segment(3);
  EXPECT_TRUE(board_.idle());
  greet();
  send_segment(1);
  EXPECT_FALSE(board_.idle());
}

TEST_F(ReplaceTest, knows_no_session_after_a_reset) {
  EXPECT_EQ(status().session, 0);
  EXPECT_EQ(status().motors, 0);
  send(Session{.number = 5}, std::uint8_t{0});  // without a hello
  EXPECT_EQ(status().session, 0);
}

TEST_F(ReplaceTest, says_what_it_is) {
  send(Ask{.motors = 3, .question = Question::about}, std::uint8_t{0});
  ASSERT_EQ(bench_.replies.size(), 1U);
  ASSERT_EQ(bench_.replies[0].type, MessageType::about);
  About about;
  decode(bench_.replies[0], about);
  EXPECT_STREQ(about.name, "bench");
  EXPECT_EQ(about.highest_event_rate, 100'000U);
}

}  // namespace
}  // namespace passo
