// What a host says of the pins: it counts for the hello that follows, and the board answers what it can do.
#include "board_bench.hpp"

namespace passo {
namespace {

// A board that can invert its probe and the drivers' enable, and nothing else.
struct PinBench : Bench {
  PinSetup set_up(const PinSetup& wanted) {
    setup = wanted;
    setup.inputs &= input_probe;
    setup.steps = 0;
    setup.outputs &= inverted_enable;
    // The longer its pulses, the fewer events it makes.
    setup.timing.event_ticks = static_cast<std::uint16_t>(5 + setup.timing.pulse);
    return setup;
  }
  std::uint8_t drivers_rest() const { return setup.drivers_rest; }
  std::uint16_t alarms() const { return setup.alarms; }
  void enable() { drivers_on = true; }
  void release() { drivers_on = false; }

  PinSetup setup;
  bool drivers_on = true;
};

// What the bench makes for a host that says nothing of its pins.
constexpr PinSetup usual_setup{.timing = {.event_ticks = 5}};

class PinSetupTest : public BoardOn<PinBench> {
 protected:
  void set_up(const PinSetup& setup) { send(setup, std::uint8_t{0}); }
  void greet() { send(Hello{.motors = 3}, std::uint8_t{0}); }
  void be_silent(int tenths) {
    for (int i = 0; i < tenths; ++i) board_.count_silence();
  }
  BoardStatus status() {
    bench_.replies.clear();
    bench_.decoder.set_motors(max_motors);
    send(Ask{.motors = max_motors}, std::uint8_t{1});
    BoardStatus status;
    decode(bench_.replies.back(), max_motors, status);
    return status;
  }
  bool is_trusted() { return (status().state & board_trusted) != 0; }
};

TEST_F(PinSetupTest, is_answered_by_what_the_board_can_do) {
  set_up({.inputs = input_probe | input_door, .steps = 1, .outputs = inverted_enable | mist_on, .drivers_rest = 20});
  ASSERT_EQ(bench_.replies.size(), 1U);
  EXPECT_EQ(bench_.replies[0].type, MessageType::pin_setup);
  PinSetup told;
  decode(bench_.replies[0], told);
  EXPECT_EQ(
      told,
      (PinSetup{.inputs = input_probe, .outputs = inverted_enable, .drivers_rest = 20, .timing = {.event_ticks = 5}}));
}

// A segment may be one tick faster.
TEST_F(PinSetupTest, sets_the_pulses_and_how_close_events_may_be) {
  const auto is_taken = [this](std::uint32_t ticks) {
    bench_.replies.clear();
    send(BoardSegment{.events = 5, .flips = 1, .interval = ticks << 16}, std::uint8_t{3}, std::uint8_t{1});
    const bool taken = bench_.replies.empty() || bench_.replies[0].type != MessageType::error;
    while (!board_.idle()) {
      static_cast<void>(board_.ticks_to_next_event());
      board_.on_event();
    }
    return taken;
  };
  set_up({.timing = {.pulse = 40}});
  greet();
  EXPECT_FALSE(is_taken(43));
  greet();
  EXPECT_FALSE(is_taken(3)) << "a hello without a setup";
  greet();
  EXPECT_TRUE(is_taken(4));
  set_up({.timing = {.pulse = 40}});
  greet();
  EXPECT_TRUE(is_taken(44));
}

TEST_F(PinSetupTest, counts_for_one_hello) {
  set_up({.inputs = input_probe});
  greet();
  EXPECT_EQ(bench_.setup.inputs, input_probe);
  greet();
  EXPECT_EQ(bench_.setup, usual_setup) << "another host, which says nothing of the pins";
}

TEST_F(PinSetupTest, is_refused_amid_motion) {
  greet();
  send(BoardSegment{.events = 5, .flips = 1, .interval = 10 << 16}, std::uint8_t{3}, std::uint8_t{1});
  bench_.replies.clear();
  set_up({.inputs = input_probe});
  ASSERT_EQ(bench_.replies.size(), 1U);
  EXPECT_EQ(bench_.replies[0].type, MessageType::error);
  EXPECT_EQ(bench_.setup, usual_setup);
}

TEST_F(PinSetupTest, drivers_go_off_when_the_host_is_silent_and_the_place_is_not_trusted_any_more) {
  set_up({.drivers_rest = 20});
  greet();
  be_silent(19);
  EXPECT_TRUE(is_trusted());
  EXPECT_TRUE(bench_.drivers_on);
  be_silent(1);
  EXPECT_FALSE(bench_.drivers_on) << "a stranger who asks is no host";
  EXPECT_FALSE(is_trusted());
  EXPECT_EQ(status().inputs & drivers_timed_out, unsigned{drivers_timed_out}) << "the host is told why";
  set_up({.drivers_rest = 20});
  greet();
  EXPECT_TRUE(bench_.drivers_on);
  EXPECT_TRUE(is_trusted());
  EXPECT_EQ(status().inputs & drivers_timed_out, 0);
}

// The start button's input is the alarm of a drive.
TEST_F(PinSetupTest, an_alarm_of_a_drive_stops_the_motors_and_answers_a_hello) {
  set_up({.alarms = input_start});
  greet();
  EXPECT_EQ(board_.stopping() & input_start, unsigned{input_start});
  board_.set_inputs(input_start);
  bench_.replies.clear();
  board_.stop_at_once(input_start);
  ASSERT_EQ(bench_.replies.size(), 1U);
  Fault fault;
  decode(bench_.replies[0], fault);
  EXPECT_EQ(fault.reason, FaultReason::driver);
  EXPECT_EQ(fault.inputs, unsigned{input_start});
  EXPECT_FALSE(is_trusted());
  set_up({.alarms = input_start});
  greet();
  EXPECT_EQ(bench_.replies.back().type, MessageType::fault) << "it is still given";
  greet();
  EXPECT_EQ(bench_.replies.back().type, MessageType::hello_reply) << "to another host it is a button";
}

TEST_F(PinSetupTest, drivers_stay_on_amid_motion_and_without_such_a_time) {
  greet();
  be_silent(1000);
  EXPECT_TRUE(bench_.drivers_on);
  set_up({.drivers_rest = 20});
  greet();
  send(BoardSegment{.events = 5, .flips = 1, .interval = 10 << 16}, std::uint8_t{3}, std::uint8_t{1});
  be_silent(1000);
  EXPECT_TRUE(bench_.drivers_on);
}

}  // namespace
}  // namespace passo
