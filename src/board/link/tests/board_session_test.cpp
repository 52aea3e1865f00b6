#include "passo/link/board_session.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include "passo/link/await.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

// A board that answers as docs/wire.md says, and keeps what it got. Written for these tests alone.
class ScriptedBoard final : public BoardPort {
 public:
  void receive(std::span<const std::uint8_t> bytes) override {
    bytes_received += bytes.size();
    for (const std::uint8_t byte : bytes) {
      if (decoder_.feed(byte) == Decoded::frame) take(decoder_.frame());
    }
  }
  bool run(Seconds) override {
    ++runs;
    if (queue.empty() || stuck) return !to_host_.empty();
    executed.push_back(queue.front());
    queue.pop_front();
    if (refusing) {
      say(ErrorReport{.reason = refusal});
    } else {
      say(Credit{.executed = executed.back(),
                 .taken = last_,
                 .free = static_cast<std::uint8_t>(identity.capacity - queue.size())});
    }
    return true;
  }
  Seconds elapsed() const override { return Seconds(0); }
  std::span<const std::uint8_t> replies() override {
    const auto end = slow && !to_host_.empty() ? to_host_.begin() + 1 : to_host_.end();
    taken_.assign(to_host_.begin(), end);
    to_host_.erase(to_host_.begin(), end);
    return taken_;
  }

  HelloReply identity{.motors = 3, .capacity = 4, .clock = 1000};
  bool silent = false;    // does not answer a hello
  bool stuck = false;     // plays nothing
  bool slow = false;      // its answers come byte by byte
  bool refusing = false;  // complains of what it plays
  WireError refusal = WireError::bad_value;
  std::deque<std::uint16_t> queue;
  std::vector<std::uint16_t> executed;
  std::vector<BoardSegment> segments;
  std::vector<BoardOutputs> outputs;
  std::size_t most_queued = 0;
  std::uint64_t bytes_received = 0;
  std::uint64_t frames_received = 0;
  int runs = 0;

 private:
  void take(const WireFrame& frame) {
    ++frames_received;
    if (frame.type == MessageType::hello) {
      Hello hello;
      decode(frame, hello);
      motors_ = hello.motors;
      decoder_.set_motors(hello.motors);
      if (!silent) say(identity);
      return;
    }
    if (frame.type == MessageType::segment) decode(frame, motors_, segments.emplace_back());
    if (frame.type == MessageType::outputs) decode(frame, outputs.emplace_back());
    last_ = frame.sequence;
    queue.push_back(++number_);
    most_queued = std::max(most_queued, queue.size());
  }
  template <class Message>
  void say(const Message& message) {
    std::uint8_t frame[largest_frame];
    const std::uint8_t size = encode(message, 0, frame);
    to_host_.insert(to_host_.end(), frame, frame + size);
  }

  Decoder decoder_;
  std::uint8_t motors_ = 0;
  std::uint8_t last_ = 0;     // sequence number
  std::uint16_t number_ = 0;  // of the last item
  std::vector<std::uint8_t> to_host_;
  std::vector<std::uint8_t> taken_;
};

BoardSegment numbered(std::uint32_t number) {
  BoardSegment segment{.events = 1, .interval = number};
  segment.increments[2] = 7;
  return segment;
}

TEST(BoardSession, learns_what_the_board_is) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 2});
  EXPECT_FALSE(link.error());
  ASSERT_TRUE(link.board());
  EXPECT_EQ(link.board()->capacity, 4);
  EXPECT_EQ(link.board()->clock, 1000U);
}

TEST(BoardSession, asks_once_in_however_many_pieces_the_answer_comes) {
  ScriptedBoard board;
  board.slow = true;
  BoardSession link(board, {.answer_within = Seconds(0.05)});
  greet(link, {.motors = 2});
  EXPECT_FALSE(link.error());
  ASSERT_TRUE(link.board());
  EXPECT_EQ(board.frames_received, 1U);
}

TEST(BoardSession, carries_every_item_in_order) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 3});
  for (std::uint32_t i = 0; i < 1000; ++i) {
    send(link, numbered(i));
    if (i % 100 == 0) send(link, BoardOutputs{.spindle_rpm = static_cast<std::uint16_t>(i)});
  }
  drain(link);
  EXPECT_FALSE(link.error());
  ASSERT_EQ(board.segments.size(), 1000U);
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(board.segments[i].interval, i);
  EXPECT_EQ(board.segments[5].increments[2], 7);
  ASSERT_EQ(board.outputs.size(), 10U);
  EXPECT_EQ(board.outputs[9].spindle_rpm, 900);
  ASSERT_EQ(board.executed.size(), 1010U);
  for (std::size_t i = 0; i < board.executed.size(); ++i) {
    ASSERT_EQ(board.executed[i], i + 1);
  }
}

TEST(BoardSession, never_has_more_under_way_than_the_board_has_room_for) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 3});
  for (std::uint32_t i = 0; i < 100; ++i) send(link, numbered(i));
  EXPECT_EQ(board.most_queued, board.identity.capacity);
}

TEST(BoardSession, lets_the_board_play_only_when_it_has_to_wait) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 3});
  for (std::uint32_t i = 0; i < 4; ++i) send(link, numbered(i));
  EXPECT_EQ(board.runs, 0);
  send(link, numbered(4));
  EXPECT_EQ(board.runs, 1);
  drain(link);
  EXPECT_TRUE(board.queue.empty());
}

TEST(BoardSession, counts_the_frames_and_bytes_that_it_sends) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 3});
  for (std::uint32_t i = 0; i < 10; ++i) send(link, numbered(i));
  send(link, BoardOutputs());
  EXPECT_EQ(link.frames_sent(), 12U);
  EXPECT_EQ(link.bytes_sent(), 8U + 10 * 23 + 9);
  EXPECT_EQ(link.frames_sent(), board.frames_received);
  EXPECT_EQ(link.bytes_sent(), board.bytes_received);
}

TEST(BoardSession, tells_when_nobody_answers) {
  ScriptedBoard board;
  board.silent = true;
  BoardSession link(board);
  greet(link, {.motors = 3});
  EXPECT_EQ(link.error(), LinkError::no_answer);
  send(link, numbered(0));
  EXPECT_TRUE(board.segments.empty());
}

TEST(BoardSession, tells_when_the_board_comes_to_a_halt_with_items_under_way) {
  ScriptedBoard board;
  BoardSession link(board);
  greet(link, {.motors = 3});
  send(link, numbered(0));
  board.stuck = true;
  drain(link);
  EXPECT_EQ(link.error(), LinkError::no_answer);
}

TEST(BoardSession, does_not_go_on_with_a_board_that_does_not_suit) {
  ScriptedBoard other_version;
  other_version.identity.version = 1;
  BoardSession with_other(other_version);
  EXPECT_FALSE(greet(with_other, {.motors = 3}));
  EXPECT_EQ(with_other.error(), LinkError::wrong_version);
  ScriptedBoard small;
  small.identity.motors = 2;
  BoardSession with_small(small);
  EXPECT_FALSE(greet(with_small, {.motors = 3}));
  EXPECT_EQ(with_small.error(), LinkError::too_few_motors);
}

TEST(BoardSession, stops_at_the_first_item_that_the_board_refuses) {
  ScriptedBoard board;
  board.refusing = true;
  BoardSession link(board);
  greet(link, {.motors = 3});
  for (std::uint32_t i = 0; i < 100; ++i) send(link, numbered(i));
  drain(link);
  EXPECT_EQ(link.error(), LinkError::refused);
  EXPECT_EQ(board.segments.size(), 4U);
}

TEST(BoardSession, says_that_a_person_moves_the_machine) {
  ScriptedBoard board;
  board.refusing = true;
  board.refusal = WireError::manual;
  BoardSession link(board);
  greet(link, {.motors = 3});
  send(link, numbered(0));
  drain(link);
  EXPECT_EQ(link.error(), LinkError::manual);
}

TEST(LinkError, has_a_sentence_for_each_reason) {
  std::vector<std::string_view> sentences;
  for (const LinkError error :
       {LinkError::no_answer, LinkError::no_progress, LinkError::wrong_version, LinkError::too_few_motors,
        LinkError::refused, LinkError::was_reset, LinkError::stopped, LinkError::too_few_places, LinkError::manual,
        LinkError::no_encoder, LinkError::spindle_stands, LinkError::encoder_wrong, LinkError::thread_lost,
        LinkError::thread_outrun}) {
    sentences.push_back(message_of(error));
  }
  std::sort(sentences.begin(), sentences.end());
  EXPECT_EQ(std::unique(sentences.begin(), sentences.end()), sentences.end());
  EXPECT_FALSE(sentences.front().empty());
}

}  // namespace
}  // namespace passo
