// EmulatedLineRun: a program on a board's own firmware, emulated, at the end of a bad line. Whatever the line does,
// what comes out of the board's pins is the program, within the limits of the machine.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/man_in_the_middle.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo::test {

class EmulatedLineRun {
 public:
  struct Outcome {
    std::uint64_t frames = 0;
    int faults = 0;
    int recoveries = 0;
  };
  struct Cuts {
    int trials = 0;
    int recoveries = 0;
    int recoveries_without_need = 0;  // of the run that was not cut
  };
  EmulatedLineRun(const BoardKind& board, MachineDescription machine)
      : board_(board), machine_(std::move(machine)), reference_(steps_without_line()) {}

  // `spoil` is called when the greeting is over.
  Outcome run(const std::function<void(BadLine&)>& spoil) const {
    auto board = EmulatedBoard::start(board_.name, board_.program);
    EXPECT_TRUE(board);
    StepLog log;
    (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
      log.add(static_cast<std::int64_t>(cycle) / board_.cycles_of_tick, static_cast<unsigned>(motor), down);
    };
    BadLine line(**board);
    Diagnostics diagnostics;
    DrivenProgram job(reader(), machine_, InterpreterOptions(), diagnostics, {.board = &line});
    EXPECT_FALSE(job.unsuited()) << *job.unsuited();
    spoil(line);
    while (job.advance()) {
      if (line.elapsed() < longest) continue;
      ADD_FAILURE() << "it hangs";
      break;
    }
    EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
    const std::optional<BoardStatus>& told = job.link().status();
    EXPECT_TRUE(told && (told->state & board_slipped) == 0) << "it stood still amid motion";
    // The last edges are counted with the time that passes next.
    static_cast<void>((*board)->run(Seconds(0.01)));
    expect_same_way(log.steps, reference_);
    expect_within_limits(machine_, log.steps);
    return {.frames = line.frames(), .faults = line.faults(), .recoveries = job.drive().ledger()->recoveries()};
  }

  // Cuts the line before each `stride`th frame.
  Cuts cut_at_every(std::uint64_t stride) const {
    const Outcome whole = run([](BadLine&) {});
    Cuts cuts{.recoveries_without_need = whole.recoveries};
    for (std::uint64_t frame = 3; frame < whole.frames && !testing::Test::HasFatalFailure(); frame += stride) {
      SCOPED_TRACE("cut before frame " + std::to_string(frame));
      cuts.recoveries += run([&](BadLine& line) { line.cut_at(line.frames() + frame, Seconds(0.3)); }).recoveries;
      ++cuts.trials;
    }
    std::printf("%llu frames, %d rests without need; cut before %d of them: %d rests\n",
                static_cast<unsigned long long>(whole.frames), whole.recoveries, cuts.trials, cuts.recoveries);
    return cuts;
  }

  void random_faults(int trials) const {
    const std::uint64_t seed = test::seed();
    int faults = 0;
    int recoveries = 0;
    for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
      SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
      const Outcome outcome = run([&](BadLine& line) { line.go_bad(seed + static_cast<std::uint64_t>(i)); });
      faults += outcome.faults;
      recoveries += outcome.recoveries;
    }
    std::printf("%d trials with %d faults, %d rests\n", trials, faults, recoveries);
    EXPECT_GT(faults, trials);
  }

  // A man in the middle makes at least as many faults of each kind in frames to the board. The faults that a run gets
  // depend on how the program is read ahead, and so on nothing but the seed.
  void faults_of_each_kind(int wanted) const {
    const std::uint64_t seed = test::seed();
    for (const Mischief mischief : every_mischief) {
      int faults = 0;
      int recoveries = 0;
      int runs = 0;
      for (; faults < wanted && !testing::Test::HasFailure(); ++runs) {
        SCOPED_TRACE(std::string(name_of(mischief)) + ", run " + std::to_string(runs));
        ManInTheMiddle man(mischief, seed + static_cast<std::uint64_t>(runs), 12, 400);
        const auto spoil = [&](BadLine& line) {
          line.set_trouble([&man](bool to_board, const Bytes& bytes) { return man(to_board, bytes); });
        };
        recoveries += run(spoil).recoveries;
        ASSERT_GT(man.faults_to_board, 0);
        faults += man.faults_to_board;
      }
      std::printf("%s: %d faults in frames to the board in %d runs, %d rests\n", std::string(name_of(mischief)).c_str(),
                  faults, runs, recoveries);
    }
  }

 private:
  // The program takes a second; each fault may cost a rest.
  static constexpr Seconds longest{300};

  static ProgramReader reader() {
    return ProgramReader::from_text(
        "t",
        "G21 G90 G64 P.02 G1 F4000\nX2\nY1.5\nX.5 Y2 Z-.4\nG2 X1.5 Y1 I.5 J-.5 F1500\nM3 S1000\nG0 X0 Y0 Z0\nM2\n");
  }
  StepLog::Steps steps_without_line() const {
    Diagnostics diagnostics;
    DrivenProgram job(reader(), machine_, InterpreterOptions(), diagnostics);
    StepLog log;
    job.machine().add_observer(log);
    while (job.advance()) {
    }
    return log.steps;
  }

  BoardKind board_;
  MachineDescription machine_;
  StepLog::Steps reference_;
};

}  // namespace passo::test
