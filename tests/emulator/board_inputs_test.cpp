// The emulated board's switches: how fast they act, and what the host is told.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

namespace passo {
namespace {

std::vector<BoardSegment> long_run(std::uint32_t interval, int segments) {
  BoardSegment segment{.events = 200, .flips = 7, .interval = interval << 16};
  return std::vector<BoardSegment>(static_cast<std::size_t>(segments), segment);
}

// A board, the fastest that it plays, and how its spindle's pin is given to a timer.
struct SwitchedBoard {
  BoardUnderTest board;
  std::uint32_t interval;
  std::uint16_t spindle_control;
  std::uint8_t connected;
};

// Cycles from the switch to the last edge that begins a step.
std::int64_t last_edge_after(const BoardBench& bench, const BoardUnderTest& board, std::uint64_t switched) {
  std::int64_t last = 0;
  for (const PortChange& change : bench.ports().changes()) {
    for (const MotorPins& motor : board.motors) {
      const unsigned risen = change.now & ~change.before & unsigned{motor.step.mask()};
      if (change.port != motor.step.port || risen == 0) continue;
      last = std::max(last, static_cast<std::int64_t>(change.cycle - switched));
    }
  }
  return last;
}

// In cycles after the switch, the worst of them.
struct Reaction {
  std::int64_t last_edge = 0;    // that begins a step
  std::int64_t outputs_off = 0;  // the spindle's pin is let go of
};

// Starts a motion with the spindle on, and closes a switch in the middle of it: at each cycle from one event to the
// next, or at every few, each time somewhere else in the motion.
Reaction worst_reaction(const SwitchedBoard& kind, Pin pin, FaultReason reason, std::uint32_t every) {
  Reaction worst;
  for (std::uint32_t phase = 0; phase < kind.interval; phase += every) {
    BoardBench bench(kind.board);
    std::uint64_t off = 0;
    bench.chip().on_write(kind.spindle_control, [&](std::uint8_t value) {
      if ((value & kind.connected) == 0 && off == 0) off = bench.cycles();
    });
    std::vector<BoardBench::Item> items = {BoardOutputs{.switches = spindle_on, .spindle_rpm = 12'000}};
    for (const BoardSegment& segment : long_run(kind.interval, 5)) items.emplace_back(segment);
    bench.start_items(items);
    bench.run(90'000 + phase * (kind.interval + 1));
    EXPECT_FALSE(bench.fault().has_value());
    EXPECT_FALSE(bench.ports().changes().empty()) << "it moves";
    const std::uint64_t switched = bench.cycles();
    off = 0;
    bench.ports().set_input(pin.port, pin.bit, false);
    bench.run(100'000);
    worst.last_edge = std::max(worst.last_edge, last_edge_after(bench, kind.board, switched));
    EXPECT_GT(off, switched) << "phase " << phase;
    worst.outputs_off = std::max(worst.outputs_off, static_cast<std::int64_t>(off - switched));
    EXPECT_EQ(bench.fault().value_or(Fault{.reason = FaultReason::driver}).reason, reason);
  }
  return worst;
}

// Steps that motor 0 has begun up to a cycle.
std::int32_t steps_until(const BoardBench& bench, const BoardUnderTest& board, std::uint64_t cycle) {
  const Pin step = board.motors[0].step;
  return static_cast<std::int32_t>(std::ranges::count_if(bench.ports().changes(), [&](const PortChange& change) {
    const unsigned risen = change.now & ~change.before & unsigned{step.mask()};
    return change.port == step.port && change.cycle <= cycle && risen != 0;
  }));
}

// Touches the probe at each cycle from one event to the next. `look`: cycles from the interrupt's look at the pins to
// the edge; a touch between the two counts for the next event.
void expect_exact_capture(const SwitchedBoard& kind, Pin probe, std::uint64_t look) {
  std::uint32_t between = 0;
  for (std::uint32_t phase = 0; phase < kind.interval; ++phase) {
    BoardBench bench(kind.board);
    bench.start(long_run(kind.interval, 7));
    bench.run(90'000 + phase * (kind.interval + 1));
    const std::uint64_t touched = bench.cycles();
    bench.ports().set_input(probe.port, probe.bit, false);
    bench.run(300'000);
    ASSERT_TRUE(bench.captured().has_value());
    EXPECT_EQ(bench.captured()->input, input_probe);
    const std::int32_t position = bench.captured()->positions[0];
    const std::int32_t before = steps_until(bench, kind.board, touched);
    EXPECT_GE(position, before) << "phase " << phase;
    EXPECT_LE(position, steps_until(bench, kind.board, touched + look)) << "phase " << phase;
    between += position != before ? 1U : 0U;
    EXPECT_EQ(bench.captured()->positions[1], position);
  }
  std::printf("probe: exact to the event at all of %u phases, %u of them between the look and the edge\n",
              kind.interval, between);
}

SwitchedBoard uno() {
  return {.board = uno_under_test(PASSO_MOTION_UNO), .interval = 107, .spindle_control = 0xb0, .connected = 1 << 7};
}
SwitchedBoard mega() {
  return {
      .board = mega_under_test(PASSO_MOTION_MEGA, 4), .interval = 145, .spindle_control = 0xa0, .connected = 1 << 3};
}
// `edge`: how long a step may still begin; `off`: until the outputs are off, an event's time included.
void expect_stop_within(std::int64_t edge, std::int64_t off, const SwitchedBoard& kind, Pin pin, FaultReason reason,
                        std::uint32_t every = 1) {
  const Reaction worst = worst_reaction(kind, pin, reason, every);
  std::printf("switch to last edge: %lld cycles at the most, to outputs off: %lld\n",
              static_cast<long long>(worst.last_edge), static_cast<long long>(worst.outputs_off));
  EXPECT_LE(worst.last_edge, edge);
  EXPECT_LE(worst.outputs_off, off);
}

// The drivers are off with an emergency stop, and on again with the next host, but not while it is still pressed.
void expect_no_motion_while_pressed(const SwitchedBoard& kind, Pin stop) {
  BoardBench bench(kind.board);
  const Pin enable = kind.board.motors[0].enable;
  const auto drivers_on = [&] { return (bench.ports().outputs(enable.port) & enable.mask()) == 0; };
  bench.start(long_run(kind.interval * 4, 5));
  bench.run(200'000);
  EXPECT_TRUE(drivers_on());
  bench.ports().set_input(stop.port, stop.bit, false);
  bench.run(300'000);
  EXPECT_TRUE(bench.fault().has_value());
  EXPECT_FALSE(drivers_on());
  bench.start(long_run(kind.interval * 4, 5));
  bench.run(1'000'000);
  EXPECT_FALSE(drivers_on());
  EXPECT_EQ(last_edge_after(bench, kind.board, 0), 0) << "it is still pressed";
  bench.ports().set_input(stop.port, stop.bit, true);
  bench.run(200'000);
  EXPECT_FALSE(drivers_on()) << "nobody has said that it is safe";
  EXPECT_TRUE(bench.play(long_run(kind.interval * 4, 5)).exact());
  EXPECT_TRUE(drivers_on());
}
TEST(UnoInputs, an_emergency_stop_holds_until_it_is_let_go_and_a_host_says_hello) {
  expect_no_motion_while_pressed(uno(), uno_cnc_shield.emergency_stop);
}
TEST(MegaInputs, an_emergency_stop_holds_until_it_is_let_go_and_a_host_says_hello) {
  expect_no_motion_while_pressed(mega(), mega_ramps.emergency_stop);
}

TEST(UnoInputs, an_emergency_stop_lets_no_further_step_out) {
  expect_stop_within(4, 240, uno(), uno_cnc_shield.emergency_stop, FaultReason::emergency_stop);
}
TEST(UnoInputs, a_limit_switch_lets_no_further_step_out) {
  expect_stop_within(4, 240, uno(), uno_cnc_shield.limits[1], FaultReason::limit);
}
TEST(UnoInputs, a_probe_captures_the_steps_made_when_it_touched) {
  expect_exact_capture(uno(), uno_cnc_shield.probe, 4);
}

TEST(MegaInputs, an_emergency_stop_lets_no_further_step_out) {
  expect_stop_within(20, 300, mega(), mega_ramps.emergency_stop, FaultReason::emergency_stop);
}
TEST(MegaInputs, each_limit_switch_lets_no_further_step_out) {
  for (const Pin limit : mega_ramps.limits) expect_stop_within(20, 300, mega(), limit, FaultReason::limit, 5);
}
TEST(MegaInputs, a_probe_captures_the_steps_made_when_it_touched) {
  expect_exact_capture(mega(), mega_ramps.probe, 18);
}

}  // namespace
}  // namespace passo
