// A board with an encoder reports the places of spindle and motion at the same time. A board without one reports its
// status.
#include "board_bench.hpp"

namespace passo {
namespace {

struct TurningBench : Bench {
  bool has_encoder() const { return fitted; }
  SpindleCount spindle() const { return count; }
  bool fitted = true;
  SpindleCount count = {.count = 0xFFFFFFF0, .tick = 0x80000001, .at_index = 0xFFFFF000, .indexes = 255};
};

class EncoderTest : public BoardOn<TurningBench> {
 protected:
  void greet() { send(Hello{.motors = 3}, std::uint8_t{0}); }
  WireFrame asked(std::uint8_t question) { return answer_to(Question::spindle, question); }
  Turned turned(std::uint8_t question) {
    const WireFrame frame = asked(question);
    EXPECT_EQ(frame.type, MessageType::turned);
    Turned turned;
    decode(frame, turned);
    return turned;
  }
};

TEST_F(EncoderTest, tells_the_count_as_it_is_and_how_far_it_has_come) {
  bench_.decoder.set_motors(3);
  greet();
  send(BoardSegment{.events = 5, .flips = 1, .interval = 10 << 16}, std::uint8_t{3}, std::uint8_t{1});
  send(BoardSegment{.events = 5, .flips = 1, .interval = 10 << 16}, std::uint8_t{3}, std::uint8_t{2});
  for (int i = 0; i < 7; ++i) {
    bench_.now += board_.ticks_to_next_event();
    board_.on_event();
  }
  const Turned told = turned(77);
  EXPECT_EQ(told.progress.executed, 1);
  EXPECT_EQ(told.progress.taken, 2);
  EXPECT_EQ(told.progress.free, capacity - 1);
  EXPECT_EQ(told.event, 2);
  EXPECT_EQ(told.answers, 77);
  EXPECT_EQ(told.spindle.count, 0xFFFFFFF0);
  EXPECT_EQ(told.spindle.tick, 0x80000001);
  EXPECT_EQ(told.spindle.at_index, 0xFFFFF000);
  EXPECT_EQ(told.spindle.indexes, 255);
}

TEST_F(EncoderTest, its_status_says_that_it_has_one) {
  bench_.decoder.set_motors(3);
  greet();
  for (const bool fitted : {true, false}) {
    bench_.fitted = fitted;
    bench_.replies.clear();
    send(Ask{.motors = 3}, std::uint8_t{1});
    ASSERT_EQ(bench_.replies.back().type, MessageType::status);
    BoardStatus status;
    decode(bench_.replies.back(), 3, status);
    EXPECT_EQ((status.state & board_encodes) != 0, fitted);
  }
}

TEST_F(EncoderTest, without_one_and_before_a_hello_the_answer_is_the_status) {
  bench_.decoder.set_motors(3);
  EXPECT_EQ(asked(1).type, MessageType::status) << "no host has said hello since it was reset";
  greet();
  bench_.fitted = false;
  EXPECT_EQ(asked(2).type, MessageType::status);
}

}  // namespace
}  // namespace passo
