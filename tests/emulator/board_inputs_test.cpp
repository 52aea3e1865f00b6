// The emulated board's switches: how fast they act, and what the host is told.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/chip/uno_cnc_shield.hpp"

namespace passo {
namespace {

std::vector<BoardSegment> long_run(std::uint32_t interval, int segments) {
  BoardSegment segment{.events = 200, .flips = 7, .interval = interval << 16};
  return std::vector<BoardSegment>(static_cast<std::size_t>(segments), segment);
}

// Cycles from the switch to the last edge that begins a step.
std::int64_t last_edge_after(const BoardBench& bench, std::uint64_t switched) {
  std::int64_t last = 0;
  for (const PortChange& change : bench.ports().changes()) {
    const unsigned risen = change.now & ~change.before & 0x1cU;
    if (change.port == 'D' && risen != 0) last = static_cast<std::int64_t>(change.cycle - switched);
  }
  return last;
}

class UnoInputs : public testing::Test {
 protected:
  // Starts a motion and closes a switch in the middle of it, at another moment each time. Worst case, in cycles.
  std::int64_t worst_reaction(Pin pin, FaultReason reason) {
    std::mt19937_64 random(test::seed());
    std::int64_t worst = 0;
    for (int trial = 0; trial < 20; ++trial) {
      BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
      bench.start(long_run(114, 10));
      bench.run(60'000 + random() % 40'000);
      EXPECT_FALSE(bench.fault().has_value());
      const std::uint64_t switched = bench.chip().cycles();
      bench.ports().set_input(pin.port, pin.bit, false);
      bench.run(200'000);
      worst = std::max(worst, last_edge_after(bench, switched));
      EXPECT_EQ(bench.fault().value_or(Fault{.reason = FaultReason::driver}).reason, reason);
    }
    return worst;
  }
};

TEST_F(UnoInputs, an_emergency_stop_lets_no_further_step_out) {
  const std::int64_t worst = worst_reaction(uno_cnc_shield.emergency_stop, FaultReason::emergency_stop);
  std::printf("emergency stop to last edge: %lld cycles at the most\n", static_cast<long long>(worst));
  EXPECT_LE(worst, 16);
}

TEST_F(UnoInputs, a_limit_switch_lets_no_further_step_out) {
  const std::int64_t worst = worst_reaction(uno_cnc_shield.limits[1], FaultReason::limit);
  std::printf("limit switch to last edge: %lld cycles at the most\n", static_cast<long long>(worst));
  EXPECT_LE(worst, 16);
}

TEST_F(UnoInputs, a_probe_captures_the_steps_made_when_it_touched) {
  std::mt19937_64 random(test::seed());
  for (int trial = 0; trial < 20; ++trial) {
    BoardBench bench(uno_under_test(PASSO_MOTION_UNO));
    bench.start(long_run(120, 10));
    bench.run(60'000 + random() % 40'000);
    const Pin probe = uno_cnc_shield.probe;
    const std::uint64_t touched = bench.chip().cycles();
    bench.ports().set_input(probe.port, probe.bit, false);
    bench.run(400'000);
    std::int32_t steps = 0;
    for (const PortChange& change : bench.ports().changes()) {
      if (change.port == 'D' && change.cycle <= touched && (change.now & ~change.before & 4U) != 0) ++steps;
    }
    ASSERT_TRUE(bench.captured().has_value());
    EXPECT_EQ(bench.captured()->input, input_probe);
    // An edge within the few cycles between the pin and the interrupt's look may count either way.
    EXPECT_NEAR(bench.captured()->positions[0], steps, 0) << "trial " << trial;
    EXPECT_EQ(bench.captured()->positions[1], bench.captured()->positions[0]);
  }
}

}  // namespace
}  // namespace passo
