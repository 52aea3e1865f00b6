// The Uno's own firmware, emulated, at the end of a bad line: what comes out of its pins is the program, whatever the
// line does; and it rests where nothing more comes.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "emulator/bad_line.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/man_in_the_middle.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

using test::BadLine;
using test::StepLog;

const std::string program =
    "G21 G90 G64 P.02 G1 F4000\nX2\nY1.5\nX.5 Y2 Z-.4\nG2 X1.5 Y1 I.5 J-.5 F1500\nM3 S1000\nG0 X0 Y0 Z0\nM2\n";

const MachineDescription& uno() {
  static const MachineDescription machine = test::example_machine("uno");
  return machine;
}

struct Outcome {
  StepLog::Steps steps;
  std::uint64_t frames = 0;
  int faults = 0;
  int recoveries = 0;
};

// On the virtual machine, and no line.
const StepLog::Steps& reference() {
  static const StepLog::Steps steps = [] {
    Diagnostics diagnostics;
    test::DrivenProgram job(ProgramReader::from_text("t", program), uno(), InterpreterOptions(), diagnostics);
    StepLog log;
    job.machine().add_observer(log);
    while (job.advance()) {
    }
    return log.steps;
  }();
  return steps;
}

template <class Spoil>
Outcome run_on_uno(const Spoil& spoil) {
  auto board = EmulatedBoard::start("uno", PASSO_MOTION_UNO);
  EXPECT_TRUE(board);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle), static_cast<unsigned>(motor), down);
  };
  BadLine line(**board);
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", program), uno(), InterpreterOptions(), diagnostics,
                          {.board = &line});
  EXPECT_FALSE(job.unsuited()) << *job.unsuited();
  spoil(line);
  while (job.advance()) {
  }
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  // The last edges are counted with the time that passes next.
  static_cast<void>((*board)->run(Seconds(0.01)));
  test::expect_same_way(log.steps, reference());
  test::expect_within_limits(uno(), log.steps);
  return {.steps = log.steps,
          .frames = line.frames(),
          .faults = line.faults(),
          .recoveries = job.drive().refiller()->recoveries()};
}

void cut_at_every(std::uint64_t stride) {
  const Outcome whole = run_on_uno([](BadLine&) {});
  int trials = 0;
  int recoveries = 0;
  for (std::uint64_t frame = 3; frame < whole.frames && !testing::Test::HasFatalFailure(); frame += stride, ++trials) {
    SCOPED_TRACE("cut before frame " + std::to_string(frame));
    recoveries += run_on_uno([&](BadLine& line) { line.cut_at(line.frames() + frame, Seconds(0.3)); }).recoveries;
  }
  std::printf("%llu frames, %d rests without need; cut before %d of them: %d rests\n",
              static_cast<unsigned long long>(whole.frames), whole.recoveries, trials, recoveries);
  EXPECT_GT(recoveries, trials / 2);
}

void random_faults(int trials) {
  const std::uint64_t seed = test::seed();
  int faults = 0;
  int recoveries = 0;
  for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    const Outcome outcome = run_on_uno([&](BadLine& line) { line.go_bad(seed + static_cast<std::uint64_t>(i)); });
    faults += outcome.faults;
    recoveries += outcome.recoveries;
  }
  std::printf("%d trials with %d faults, %d rests\n", trials, faults, recoveries);
  EXPECT_GT(faults, trials);
}

// The faults that a run gets depend on how the program is read ahead, and so on nothing but the seed.
void make_faults_of_each_kind(int wanted) {
  const std::uint64_t seed = test::seed();
  for (const test::Mischief mischief : test::every_mischief) {
    int faults = 0;
    int recoveries = 0;
    for (std::uint64_t i = 0; faults < wanted && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(std::string(test::name_of(mischief)) + ", run " + std::to_string(i));
      test::ManInTheMiddle man(mischief, seed + i, 12, 400);
      recoveries +=
          run_on_uno([&](BadLine& line) {
            line.set_trouble([&man](bool to_board, const test::Bytes& bytes) { return man(to_board, bytes); });
          }).recoveries;
      ASSERT_GT(man.faults_to_board, 0);
      faults += man.faults_to_board;
    }
    std::printf("%s: %d faults in frames to the board, %d rests\n", std::string(test::name_of(mischief)).c_str(),
                faults, recoveries);
  }
}

class UnoOnABadLineInFull : public test::InFull<testing::Test> {};

TEST(UnoOnABadLine, goes_on_from_where_it_rests_when_the_line_was_cut) {
  cut_at_every(37);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_random_faults) {
  random_faults(5);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_a_man_in_the_middle) {
  make_faults_of_each_kind(15);
}

TEST_F(UnoOnABadLineInFull, a_thousand_faults_of_each_kind) {
  make_faults_of_each_kind(static_cast<int>(1000 / test::in_full()));
}

TEST_F(UnoOnABadLineInFull, cut_before_every_frame) {
  cut_at_every(test::in_full());
}

TEST_F(UnoOnABadLineInFull, random_faults) {
  random_faults(static_cast<int>(400 / test::in_full()));
}

}  // namespace
}  // namespace passo
