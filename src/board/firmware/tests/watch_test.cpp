// The captures of a board: its probe, or the limit switch that a host has named.
#include "board_bench.hpp"

namespace passo {
namespace {

constexpr std::uint16_t limit_y = input_limit << 1U;

class WatchTest : public BoardTest {
 protected:
  BoardStatus ask(Question question, std::uint8_t limit = 0) {
    bench_.decoder.set_motors(3);
    bench_.replies.clear();
    send(Ask{.motors = 3, .question = question, .limit = limit}, std::uint8_t{0});
    EXPECT_EQ(bench_.replies.size(), 1U);
    BoardStatus status;
    if (!bench_.replies.empty() && bench_.replies[0].type == MessageType::status) {
      decode(bench_.replies[0], 3, status);
    }
    return status;
  }
  Captured captured() {
    Captured captured;
    EXPECT_FALSE(bench_.replies.empty());
    if (bench_.replies.empty()) return captured;
    EXPECT_EQ(bench_.replies.back().type, MessageType::captured);
    decode(bench_.replies.back(), 3, captured);
    return captured;
  }
};

TEST_F(WatchTest, a_limit_switch_that_is_named_captures_and_all_others_stop) {
  greet();
  EXPECT_EQ(board_.watched(), input_probe);
  EXPECT_EQ(board_.stopping(), input_emergency_stop | 0xFF);
  const BoardStatus status = ask(Question::watch, limit_y);
  EXPECT_EQ(status.state, board_trusted | board_homes);
  EXPECT_EQ(board_.watched(), limit_y);
  EXPECT_EQ(board_.stopping(), input_emergency_stop | 0xFD);

  send_segment(1, 20);
  for (int i = 0; i < 7; ++i) event();
  bench_.replies.clear();
  board_.set_inputs(limit_y, limit_y);
  EXPECT_EQ(captured().input, limit_y);
  EXPECT_EQ(captured().positions[0], 7);
  EXPECT_FALSE(board_.idle());
  event();
  board_.set_inputs(0, limit_y);
  EXPECT_EQ(captured().input, limit_y | captured_released);
  play_to_the_end();
  EXPECT_EQ(ask(Question::status).state, board_trusted | board_homes | board_kept);
  ask(Question::kept);
  EXPECT_EQ(captured().input, limit_y | captured_kept);
  EXPECT_EQ(captured().positions[0], 7) << "the first change";
}

TEST_F(WatchTest, the_probe_is_watched_again_when_a_host_says_so) {
  greet();
  ask(Question::watch, limit_y);
  EXPECT_EQ(ask(Question::watch).state, board_trusted);
  EXPECT_EQ(board_.watched(), input_probe);
  bench_.replies.clear();
  board_.set_inputs(limit_y);
  EXPECT_TRUE(bench_.replies.empty()) << "a limit switch is told by its stop";
}

TEST_F(WatchTest, a_hello_ends_it) {
  greet();
  ask(Question::watch, limit_y);
  greet();
  EXPECT_EQ(ask(Question::status).state, board_trusted);
  EXPECT_EQ(board_.watched(), input_probe);
}

// Motion on its way was sent under the old watch.
TEST_F(WatchTest, changes_at_rest_only) {
  greet();
  send_segment(1, 20);
  event();
  EXPECT_EQ(ask(Question::watch, limit_y).state, board_trusted | board_moves);
  EXPECT_EQ(board_.watched(), input_probe);
  play_to_the_end();
  EXPECT_EQ(ask(Question::watch, limit_y).state, board_trusted | board_homes);
  send_segment(2, 20);
  event();
  board_.set_inputs(limit_y, limit_y);
  EXPECT_EQ(ask(Question::watch).state, board_trusted | board_moves | board_homes | board_kept)
      << "another watch forgets nothing of this one";
}

TEST_F(WatchTest, several_limit_switches_can_be_named_only_where_the_hardware_can_watch_them) {
  greet();
  bench_.replies.clear();
  send(Ask{.motors = 3, .question = Question::watch, .limit = 3}, std::uint8_t{0});
  EXPECT_EQ(last_error().reason, WireError::bad_value);
  EXPECT_EQ(board_.watched(), input_probe);
}

TEST_F(WatchTest, manual_mode_ends_it) {
  greet();
  ask(Question::watch, limit_y);
  board_.begin_manual();
  EXPECT_EQ(board_.watched(), input_probe);
  ask(Question::watch, limit_y);
  EXPECT_EQ(board_.watched(), input_probe);
}

}  // namespace
}  // namespace passo
