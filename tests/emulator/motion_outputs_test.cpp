// Outputs that change in motion, on each board's own firmware, emulated: the edges of the pins of mist and flood,
// beside those of the step pins.
#include "kit/motion_outputs.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/driven.hpp"
#include "kit/in_full.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

struct BoardWithOutputs {
  test::BoardKind kind;
  const char* machine;
  Seconds latest;         // from a step to the edge of an output that belongs to it
  double steps_late = 0;  // at 19,200 steps/s: the Pico's main loop switches outputs, in its passes
};

std::ostream& operator<<(std::ostream& out, const BoardWithOutputs& board) {
  return out << board.kind.name;
}

class EmulatedOutputs : public testing::TestWithParam<BoardWithOutputs> {
 protected:
  void SetUp() override {
    if (const std::string why = test::missing(GetParam().kind); !why.empty()) GTEST_SKIP() << why;
  }
  // The digital outputs of a program on the emulated board, as its pins have them.
  std::vector<test::OutputsChange> run(const std::string& program, const MachineDescription& machine) {
    std::vector<test::OutputsChange> changes;
    auto board = EmulatedBoard::start(GetParam().kind.name, GetParam().kind.program);
    EXPECT_TRUE(board);
    if (!board) return changes;
    std::array<std::int64_t, 8> place{};
    std::uint64_t last_step = 0;
    test::OrderedOutputs now;
    (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
      place[motor] += down ? -1 : 1;
      last_step = cycle;
    };
    (*board)->on_outputs = [&](std::uint64_t cycle, std::uint8_t switches) {
      test::OrderedOutputs state = test::ordered_by({.switches = switches});
      if (state == now) return;
      now = state;
      const auto at = [&](std::size_t axis) {
        return static_cast<double>(place[axis]) / machine.axes[axis].steps_per_unit *
               (machine.axes[axis].inverted ? -1 : 1);
      };
      changes.push_back({.to = state, .x = at(0), .y = at(1)});
      const double rate = machine.board.clock.value() * static_cast<double>(GetParam().kind.cycles_of_tick);
      after_step_.push_back(static_cast<double>(cycle - last_step) / rate);
    };
    test::BadLine line(**board);
    Diagnostics diagnostics;
    test::DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                            {.board = &line});
    EXPECT_FALSE(job.unsuited()) << *job.unsuited();
    while (job.advance()) {
    }
    EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
    static_cast<void>((*board)->run(Seconds(0.01)));
    return changes;
  }
  // From the last step before each change to the change, s.
  std::vector<double> after_step_;
};

MachineDescription machine_of(const BoardWithOutputs& board) {
  MachineDescription machine = test::laser_machine(board.machine);
  if (board.kind.name == std::string("mega")) {
    machine.board.highest_event_rate = Hertz(110'000);
    machine.board.held_items = 160;
  }
  return machine;
}

// A board may write the ports of two outputs a few cycles apart: expect_changes() leaves out what is between.
// Without the beam, whose pin is in the hands of a timer.
std::vector<test::OutputsChange> digital(const std::vector<test::OutputsChange>& all) {
  std::vector<test::OutputsChange> changes;
  test::OrderedOutputs now;
  for (test::OutputsChange change : all) {
    change.to.s = 0;
    if (change.to == now) continue;
    now = change.to;
    changes.push_back(change);
  }
  return changes;
}

using EmulatedOutputsInFull = test::InFull<EmulatedOutputs>;

TEST_P(EmulatedOutputsInFull, change_at_their_positions) {
  const MachineDescription machine = machine_of(GetParam());
  const double step = 1 / std::min(machine.axes[0].steps_per_unit, machine.axes[1].steps_per_unit);
  test::Random random;
  const int programs = static_cast<int>(100 / test::in_full());
  std::size_t changes = 0;
  for (int trial = 0; trial < programs; ++trial) {
    SCOPED_TRACE(fmt::format("seed {}, trial {}", random.seed(), trial));
    const double tolerance = trial % 2 == 0 ? 0.02 : 0;
    const test::OutputProgram program = test::OutputProgramWriter(random, tolerance).write(40);
    const std::vector<test::OutputsChange> made = run(program.text, machine);
    test::expect_changes(made, digital(program.changes), tolerance + 3 * step);
    if (HasFatalFailure()) return;
    changes += program.changes.size();
  }
  std::printf("%d programs, %zu changes of outputs and power\n", programs, changes);
}

// At an even speed each event is a step of X: a change comes with the last step before its position.
TEST_P(EmulatedOutputs, change_with_the_step_to_which_they_belong) {
  const MachineDescription machine = machine_of(GetParam());
  std::string program = "G21 G90 G1 F1800 X2\n";
  for (int i = 0; i < 10; ++i) program += fmt::format("{} P0\nX{:.2f}\n", i % 2 == 0 ? "M62" : "M63", 2.25 + i * 0.25);
  const std::vector<test::OutputsChange> made = run(program + "X6\nM2\n", machine);
  ASSERT_EQ(made.size(), 10U);
  double latest = 0;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto due = static_cast<std::int64_t>((2 + static_cast<double>(i) * 0.25) * machine.axes[0].steps_per_unit);
    const double late = made[i].x * machine.axes[0].steps_per_unit - static_cast<double>(due);
    EXPECT_GE(late, -1.01) << i;
    EXPECT_LE(late, 1.01 + GetParam().steps_late) << i;
    latest = std::max(latest, after_step_[i]);
  }
  std::printf("from a step to the edge of its output: %.1f us at most\n", latest * 1e6);
  EXPECT_LE(latest, GetParam().latest.value());
}

const auto every_board = testing::Values(BoardWithOutputs{test::uno, "uno", Seconds(5e-6)},
                                         BoardWithOutputs{test::mega, "uno", Seconds(5e-6)},
                                         BoardWithOutputs{test::pico, "pico", Seconds(60e-6), 4});
INSTANTIATE_TEST_SUITE_P(Board, EmulatedOutputs, every_board, testing::PrintToStringParamName());
INSTANTIATE_TEST_SUITE_P(Board, EmulatedOutputsInFull, every_board, testing::PrintToStringParamName());

}  // namespace
}  // namespace passo
