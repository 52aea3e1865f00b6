// The emulated board's switches: how fast they act, and what the host is told.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

namespace passo {
namespace {

std::vector<BoardSegment> long_run(std::uint32_t interval, int segments) {
  BoardSegment segment{.events = 200, .flips = 7, .interval = interval << 16};
  return std::vector<BoardSegment>(static_cast<std::size_t>(segments), segment);
}

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

// Starts a motion and closes a switch in the middle of it, at another moment each time. Worst case, in cycles.
std::int64_t worst_reaction(const BoardUnderTest& board, Pin pin, FaultReason reason) {
  std::mt19937_64 random(test::seed());
  std::int64_t worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    BoardBench bench(board);
    bench.start(long_run(board.motors.size() > 3 ? 145 : 114, 7));
    bench.run(60'000 + random() % 40'000);
    EXPECT_FALSE(bench.fault().has_value());
    EXPECT_FALSE(bench.ports().changes().empty()) << "it moves";
    const std::uint64_t switched = bench.chip().cycles();
    bench.ports().set_input(pin.port, pin.bit, false);
    bench.run(200'000);
    worst = std::max(worst, last_edge_after(bench, board, switched));
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

// `look`: cycles from the interrupt's look at the pins to the edge. A touch between the two counts for the next event.
void expect_exact_capture(const BoardUnderTest& board, Pin probe, std::uint32_t interval, std::uint64_t look) {
  std::mt19937_64 random(test::seed());
  for (int trial = 0; trial < 20; ++trial) {
    BoardBench bench(board);
    bench.start(long_run(interval, 7));
    bench.run(60'000 + random() % 40'000);
    const std::uint64_t touched = bench.chip().cycles();
    bench.ports().set_input(probe.port, probe.bit, false);
    bench.run(400'000);
    ASSERT_TRUE(bench.captured().has_value());
    EXPECT_EQ(bench.captured()->input, input_probe);
    const std::int32_t position = bench.captured()->positions[0];
    EXPECT_GE(position, steps_until(bench, board, touched)) << "trial " << trial;
    EXPECT_LE(position, steps_until(bench, board, touched + look)) << "trial " << trial;
    EXPECT_EQ(bench.captured()->positions[1], bench.captured()->positions[0]);
  }
}

BoardUnderTest uno() {
  return uno_under_test(PASSO_MOTION_UNO);
}
BoardUnderTest mega() {
  return mega_under_test(PASSO_MOTION_MEGA, 4);
}
void expect_stop_within(std::int64_t cycles, const BoardUnderTest& board, Pin pin, FaultReason reason) {
  const std::int64_t worst = worst_reaction(board, pin, reason);
  std::printf("switch to last edge: %lld cycles at the most\n", static_cast<long long>(worst));
  EXPECT_LE(worst, cycles);
}

TEST(UnoInputs, an_emergency_stop_lets_no_further_step_out) {
  expect_stop_within(16, uno(), uno_cnc_shield.emergency_stop, FaultReason::emergency_stop);
}
TEST(UnoInputs, a_limit_switch_lets_no_further_step_out) {
  expect_stop_within(16, uno(), uno_cnc_shield.limits[1], FaultReason::limit);
}
TEST(UnoInputs, a_probe_captures_the_steps_made_when_it_touched) {
  expect_exact_capture(uno(), uno_cnc_shield.probe, 120, 4);
}

TEST(MegaInputs, an_emergency_stop_lets_no_further_step_out) {
  expect_stop_within(32, mega(), mega_ramps.emergency_stop, FaultReason::emergency_stop);
}
TEST(MegaInputs, each_limit_switch_lets_no_further_step_out) {
  for (const Pin limit : mega_ramps.limits) expect_stop_within(32, mega(), limit, FaultReason::limit);
}
TEST(MegaInputs, a_probe_captures_the_steps_made_when_it_touched) {
  expect_exact_capture(mega(), mega_ramps.probe, 150, 18);
}

}  // namespace
}  // namespace passo
