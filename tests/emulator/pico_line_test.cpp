// The Pico's own firmware, emulated, at the end of a bad line by USB: what comes out of its pins is the program,
// whatever the line does.
#include <cstdio>
#include <string>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

using test::BadLine;
using test::StepLog;

constexpr test::BoardKind pico{"pico", PASSO_MOTION_PICO, 8};

const std::string program =
    "G21 G90 G64 P.02 G1 F4000\nX2\nY1.5\nX.5 Y2 Z-.4\nG2 X1.5 Y1 I.5 J-.5 F1500\nM3 S1000\nG0 X0 Y0 Z0\nM2\n";

const MachineDescription& router() {
  static const MachineDescription machine = test::example_machine("pico");
  return machine;
}

struct Outcome {
  StepLog::Steps steps;
  std::uint64_t frames = 0;
  int faults = 0;
  int recoveries = 0;
};

const StepLog::Steps& reference() {
  static const StepLog::Steps steps = [] {
    Diagnostics diagnostics;
    test::DrivenProgram job(ProgramReader::from_text("t", program), router(), InterpreterOptions(), diagnostics);
    StepLog log;
    job.machine().add_observer(log);
    while (job.advance()) {
    }
    return log.steps;
  }();
  return steps;
}

template <class Spoil>
Outcome run_on_pico(const Spoil& spoil) {
  auto board = EmulatedBoard::start(pico.name, pico.program);
  EXPECT_TRUE(board);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle) / pico.cycles_of_tick, static_cast<unsigned>(motor), down);
  };
  BadLine line(**board);
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", program), router(), InterpreterOptions(), diagnostics,
                          {.board = &line});
  EXPECT_FALSE(job.unsuited()) << *job.unsuited();
  spoil(line);
  while (job.advance()) {
  }
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  // The last edges are counted with the time that passes next.
  static_cast<void>((*board)->run(Seconds(0.01)));
  test::expect_same_way(log.steps, reference());
  test::expect_within_limits(router(), log.steps);
  return {.steps = log.steps,
          .frames = line.frames(),
          .faults = line.faults(),
          .recoveries = job.drive().refiller()->recoveries()};
}

class PicoOnABadLine : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = test::missing(pico); !why.empty()) GTEST_SKIP() << why;
  }
};

void cut_at_every(std::uint64_t stride) {
  const Outcome whole = run_on_pico([](BadLine&) {});
  EXPECT_EQ(whole.recoveries, 0) << "there are places in plenty";
  int trials = 0;
  int recoveries = 0;
  for (std::uint64_t frame = 3; frame < whole.frames && !testing::Test::HasFatalFailure(); frame += stride, ++trials) {
    SCOPED_TRACE("cut before frame " + std::to_string(frame));
    recoveries += run_on_pico([&](BadLine& line) { line.cut_at(line.frames() + frame, Seconds(0.3)); }).recoveries;
  }
  std::printf("%llu frames; cut before %d of them: %d rests\n", static_cast<unsigned long long>(whole.frames), trials,
              recoveries);
  EXPECT_GT(recoveries, 0);
}

void random_faults(int trials) {
  const std::uint64_t seed = test::seed();
  int faults = 0;
  int recoveries = 0;
  for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    const Outcome outcome = run_on_pico([&](BadLine& line) { line.go_bad(seed + static_cast<std::uint64_t>(i)); });
    faults += outcome.faults;
    recoveries += outcome.recoveries;
  }
  std::printf("%d trials with %d faults, %d rests\n", trials, faults, recoveries);
  EXPECT_GT(faults, trials);
}

TEST_F(PicoOnABadLine, goes_on_from_where_it_rests_when_the_line_was_cut) {
  cut_at_every(199);
}

TEST_F(PicoOnABadLine, makes_no_wrong_step_of_random_faults) {
  random_faults(2);
}

using PicoOnABadLineInFull = test::InFull<PicoOnABadLine>;
TEST_F(PicoOnABadLineInFull, cut_before_every_frame) {
  cut_at_every(3 * test::in_full());
}

TEST_F(PicoOnABadLineInFull, random_faults) {
  random_faults(static_cast<int>(200 / test::in_full()));
}

}  // namespace
}  // namespace passo
