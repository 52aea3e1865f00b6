// A host that is killed or cut off: the board ends its motion, then switches the outputs off.
#include "board_bench.hpp"

namespace passo {
namespace {

class SilenceTest : public BoardTest {
 protected:
  static constexpr std::uint16_t session = 5;

  void begin(const Silence& silence, std::uint8_t switches = spindle_on | mist_on | flood_on) {
    bench_.decoder.set_motors(3);
    greet();
    send(Session{.number = session, .silence = silence}, std::uint8_t{0});
    send(BoardOutputs{.switches = switches, .spindle_rpm = 1000}, std::uint8_t{1});
  }
  void be_silent(int tenths) {
    for (int i = 0; i < tenths; ++i) board_.count_silence();
  }
  // Announces one segment, with the right sums.
  void replace(std::uint8_t number, std::uint8_t events) {
    std::uint8_t frame[largest_frame];
    const std::uint8_t size =
        encode(segment_of(events, 10), std::uint8_t{3}, static_cast<std::uint8_t>(number + 1), frame);
    Announcement announcement(number, static_cast<std::uint16_t>(number - 1), 3);
    announcement.add(frame, size);
    send(announcement.replace(), number);
    send_bytes(frame, size);
  }
  std::uint16_t told_inputs() {
    bench_.replies.clear();
    send(Ask{.motors = 3}, std::uint8_t{1});
    BoardStatus status;
    decode(bench_.replies.back(), 3, status);
    return status.inputs;
  }
};

TEST_F(SilenceTest, switches_each_output_off_after_its_own_time) {
  begin({.spindle = 20, .mist = 5, .flood = 0});
  be_silent(4);
  EXPECT_EQ(bench_.on, unsigned{spindle_on | mist_on | flood_on});
  be_silent(1);
  EXPECT_EQ(bench_.on, unsigned{spindle_on | flood_on});
  be_silent(14);
  EXPECT_EQ(bench_.on, unsigned{spindle_on | flood_on});
  be_silent(1);
  EXPECT_EQ(bench_.on, unsigned{flood_on});
  be_silent(10'000);
  EXPECT_EQ(bench_.on, unsigned{flood_on}) << "0 is for ever";
}

TEST_F(SilenceTest, does_nothing_before_a_session_has_told_how_long) {
  greet();
  send(BoardOutputs{.switches = spindle_on}, std::uint8_t{1});
  be_silent(10'000);
  EXPECT_EQ(bench_.on, unsigned{spindle_on});
}

TEST_F(SilenceTest, is_broken_by_any_frame_of_the_host_and_not_by_a_stranger_who_asks) {
  begin({.spindle = 20});
  be_silent(19);
  send(Ask{.motors = 3}, std::uint8_t{1});
  be_silent(19);
  EXPECT_EQ(bench_.on & spindle_on, unsigned{spindle_on});
  send(Ask{.motors = max_motors}, std::uint8_t{1});
  be_silent(1);
  EXPECT_EQ(bench_.on & spindle_on, 0U) << "a monitor is no host";
}

TEST_F(SilenceTest, waits_for_the_end_of_the_motion) {
  begin({.spindle = 20});
  replace(2, 3);
  be_silent(100);
  EXPECT_EQ(bench_.on & spindle_on, unsigned{spindle_on});
  play_to_the_end();
  be_silent(1);
  EXPECT_EQ(bench_.on & spindle_on, 0U);
}

TEST_F(SilenceTest, lets_nothing_move_afterwards_before_the_host_has_sent_outputs) {
  begin({.spindle = 20});
  EXPECT_EQ(told_inputs() & outputs_timed_out, 0);
  be_silent(20);
  EXPECT_EQ(told_inputs() & outputs_timed_out, unsigned{outputs_timed_out});
  replace(2, 3);
  EXPECT_EQ(last_error().reason, WireError::silent_host);
  EXPECT_TRUE(board_.idle());
  send(BoardOutputs{.switches = spindle_on, .spindle_rpm = 1000}, std::uint8_t{4});
  EXPECT_EQ(told_inputs() & outputs_timed_out, 0);
  EXPECT_EQ(bench_.on, unsigned{spindle_on});
  const std::size_t before = bench_.log.size();
  std::uint8_t frame[largest_frame];
  const std::uint8_t size = encode(segment_of(3, 10), std::uint8_t{3}, std::uint8_t{6}, frame);
  Announcement announcement(5, 4, 3);
  announcement.add(frame, size);
  send(announcement.replace(), std::uint8_t{5});
  send_bytes(frame, size);
  play_to_the_end();
  EXPECT_GT(bench_.log.size(), before) << "it moves";
}

TEST_F(SilenceTest, says_nothing_of_outputs_that_were_off_already) {
  begin({.spindle = 20, .mist = 20, .flood = 20}, 0);
  be_silent(100);
  EXPECT_EQ(told_inputs() & outputs_timed_out, 0);
}

// The host was killed after its hello, before it could name its session.
TEST_F(SilenceTest, keeps_the_times_of_the_last_session_over_a_hello) {
  begin({.spindle = 20});
  greet(9);
  be_silent(20);
  EXPECT_EQ(bench_.on & spindle_on, 0U);
}

}  // namespace
}  // namespace passo
