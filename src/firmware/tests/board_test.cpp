#include "passo/firmware/board.hpp"

#include <cstring>
#include <string>
#include <vector>

namespace passo {
namespace {

// Writes down what the board does, with the ticks since the start.
struct Bench {
  void step(std::uint8_t stepped, std::uint8_t directions) {
    log.push_back(std::to_string(now) + " step " + std::to_string(stepped) + " down " + std::to_string(directions));
  }
  void outputs(const BoardOutputs& outputs) {
    log.push_back(std::to_string(now) + " outputs " + std::to_string(outputs.switches) + " rpm " +
                  std::to_string(outputs.spindle_rpm));
  }
  void send(std::uint8_t byte) {
    if (decoder.feed(byte) == Decoded::frame) replies.push_back(decoder.frame());
  }

  bool probe() const { return touched; }

  std::int64_t now = 0;
  bool touched = false;
  std::vector<std::string> log;
  Decoder decoder;
  std::vector<WireFrame> replies;
};

constexpr std::size_t capacity = 4;

class BoardTest : public testing::Test {
 protected:
  template <class... What>
  void send(const What&... what) {
    std::uint8_t frame[largest_frame];
    send_bytes(frame, encode(what..., frame));
  }
  void send_bytes(const std::uint8_t* frame, std::uint8_t size) {
    for (std::uint8_t i = 0; i < size; ++i) board_.receive(frame[i]);
  }
  void greet(std::uint8_t sequence = 0) {
    send(Hello{.motors = 3}, sequence);
    bench_.replies.clear();
  }
  void send_segment(std::uint8_t sequence, std::uint8_t events = 1, std::uint32_t ticks = 10) {
    send(BoardSegment{.events = events, .flips = 1, .interval = ticks << 16}, std::uint8_t{3}, sequence);
  }
  void event() {
    bench_.now += board_.ticks_to_next_event();
    board_.on_event();
  }
  void play_to_the_end() {
    while (!board_.idle()) event();
  }
  ErrorReport last_error() {
    ErrorReport error;
    EXPECT_FALSE(bench_.replies.empty());
    if (bench_.replies.empty()) return error;
    EXPECT_EQ(bench_.replies.back().type, MessageType::error);
    decode(bench_.replies.back(), error);
    return error;
  }
  Credit last_credit() {
    Credit credit;
    EXPECT_FALSE(bench_.replies.empty());
    if (bench_.replies.empty()) return credit;
    EXPECT_EQ(bench_.replies.back().type, MessageType::credit);
    decode(bench_.replies.back(), credit);
    return credit;
  }

  Bench bench_;
  Board<Bench, capacity> board_{bench_, 4, 16'000'000};
};

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
  send(Hello{.version = 2, .motors = 3}, std::uint8_t{0});
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
    EXPECT_EQ(bench_.log.size(), 1U);  // from one half, half a step makes a whole one
  }
}

class BoardProbe : public BoardTest {
 protected:
  // What the board has told of its probe since the last call.
  std::vector<ProbeReport> reports() {
    if (board_.owes_report()) board_.report();
    std::vector<ProbeReport> found;
    for (const WireFrame& frame : bench_.replies) {
      if (frame.type == MessageType::probe_report) decode(frame, 3, found.emplace_back());
    }
    bench_.replies.clear();
    return found;
  }
  void events(int count) {
    for (int i = 0; i < count; ++i) event();
  }
  void greet_with_probe() {
    greet();
    bench_.decoder.set_motors(3);
  }
};

TEST_F(BoardProbe, keeps_the_steps_at_the_event_of_the_contact) {
  greet_with_probe();
  send_segment(1, 3);
  play_to_the_end();
  send(ProbeWatch{.until = ProbeUntil::touched}, std::uint8_t{2});
  const std::vector<ProbeReport> begin = reports();
  ASSERT_EQ(begin.size(), 1U);
  EXPECT_FALSE(begin[0].touched);
  EXPECT_FALSE(begin[0].happened);
  // Motor 0 up; motor 2 down.
  send(BoardSegment{.events = 9, .directions = 4, .flips = 5, .interval = 10U << 16}, std::uint8_t{3}, std::uint8_t{3});
  events(4);
  EXPECT_TRUE(reports().empty());
  bench_.touched = true;
  event();
  bench_.touched = false;
  events(2);
  const std::vector<ProbeReport> contact = reports();
  ASSERT_EQ(contact.size(), 1U);
  EXPECT_TRUE(contact[0].touched);
  EXPECT_TRUE(contact[0].happened);
  EXPECT_EQ(contact[0].steps[0], 5);
  EXPECT_EQ(contact[0].steps[1], 0);
  EXPECT_EQ(contact[0].steps[2], -5);
  bench_.touched = true;
  events(2);
  EXPECT_TRUE(reports().empty()) << "told once";
}

TEST_F(BoardProbe, waits_for_the_change_not_for_the_state) {
  greet_with_probe();
  bench_.touched = true;
  send(ProbeWatch{.until = ProbeUntil::touched}, std::uint8_t{1});
  EXPECT_TRUE(reports().at(0).touched);
  send_segment(2, 9);
  events(2);
  bench_.touched = false;
  events(2);
  EXPECT_TRUE(reports().empty());
  bench_.touched = true;
  event();
  EXPECT_EQ(reports().at(0).steps[0], 5);
}

TEST_F(BoardProbe, until_it_is_free_or_not_at_all) {
  greet_with_probe();
  bench_.touched = true;
  send(ProbeWatch{.until = ProbeUntil::released}, std::uint8_t{1});
  (void)reports();
  send_segment(2, 9);
  events(3);
  bench_.touched = false;
  event();
  const std::vector<ProbeReport> found = reports();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].touched);
  EXPECT_EQ(found[0].steps[0], 4);
  play_to_the_end();
  send(ProbeWatch{.until = ProbeUntil::touched}, std::uint8_t{3});
  (void)reports();
  send(ProbeWatch{}, std::uint8_t{4});
  send_segment(5, 2);
  bench_.touched = true;
  play_to_the_end();
  EXPECT_TRUE(reports().empty());
}

TEST_F(BoardProbe, refuses_a_watch_for_what_there_is_not) {
  greet_with_probe();
  send(ProbeWatch{.until = static_cast<ProbeUntil>(3)}, std::uint8_t{1});
  EXPECT_EQ(last_error().reason, WireError::bad_value);
}

}  // namespace
}  // namespace passo
