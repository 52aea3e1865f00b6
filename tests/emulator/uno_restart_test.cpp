// The Uno's own firmware, emulated, outlives its hosts: they die at any frame, others go on by their journal, and what
// comes out of its pins is the program.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/journaled_host.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

using test::StepLog;

const std::string program =
    "G21 G90 G64 P.02 G1 F4000\nX2\nY1.5\nM3 S1000\nX.5 Y2 Z-.4\nM8\nG2 X1.5 Y1 I.5 J-.5 F1500\nM2\n";

const MachineDescription& uno_machine() {
  static const MachineDescription machine = test::example_machine("uno");
  return machine;
}

StepLog log_of_virtual_machine() {
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", program), uno_machine(), InterpreterOptions(), diagnostics);
  StepLog log;
  job.machine().add_observer(log);
  while (job.advance()) {
  }
  return log;
}

// Every host dies at its moment, and a last one comes to the end. Returns the moments of the first.
std::uint64_t run_on_uno(const std::vector<std::uint64_t>& lives, test::HostEnd end, int& died) {
  static const StepLog reference = log_of_virtual_machine();
  auto board = EmulatedBoard::start("uno", PASSO_MOTION_UNO);
  EXPECT_TRUE(board);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle), static_cast<unsigned>(motor), down);
  };
  test::JournaledHost host(uno_machine(), program);
  std::uint64_t moments = 0;
  bool done = false;
  for (const std::uint64_t life : lives) {
    done = host.live(**board, life, end, moments);
    if (done) break;
    ++died;
  }
  done = done || host.live(**board, test::never, end, moments);
  EXPECT_TRUE(done);
  // The last edges are counted with the time that passes next.
  static_cast<void>((*board)->run(Seconds(0.01)));
  test::expect_same_way(log.steps, reference.steps);
  test::expect_within_limits(uno_machine(), log.steps, 6);
  EXPECT_EQ(log.place, reference.place);
  return moments;
}

constexpr std::array ends = {test::HostEnd::before_frame, test::HostEnd::amid_frame, test::HostEnd::behind_frame,
                             test::HostEnd::stopped};

void die_at_every(std::uint64_t stride, bool again) {
  int died = 0;
  int trials = 0;
  const std::uint64_t moments = run_on_uno({}, test::HostEnd::before_frame, died);
  for (std::uint64_t at = 0; at < moments && !testing::Test::HasFatalFailure(); at += stride, ++trials) {
    // The second, if there is one, at another moment of its beginning each time.
    const std::uint64_t second = again ? at / stride % 50 : test::never;
    SCOPED_TRACE("hosts die at " + std::to_string(at) + " and " + std::to_string(second));
    run_on_uno({at, second}, ends[at / stride % ends.size()], died);
  }
  std::printf("%llu moments, %d trials, %d hosts died or were stopped\n", static_cast<unsigned long long>(moments),
              trials, died);
  EXPECT_GE(died, trials);
}

TEST(UnoOutlivesItsHosts, killed_here_and_there) {
  die_at_every(97, false);
}

TEST(UnoOutlivesItsHosts, the_second_one_too) {
  die_at_every(131, true);
}

TEST(UnoOutlivesItsHosts, in_full) {
  if (test::in_full() == 0) GTEST_SKIP() << "takes minutes: PASSO_IN_FULL=1";
  die_at_every(test::in_full(), false);
  die_at_every(test::in_full(), true);
}

}  // namespace
}  // namespace passo
