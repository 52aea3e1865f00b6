// The Uno's stated rate with the real host: long straight moves at 150,000 events a second, while the board is asked
// for its status, make every step and never stand still.
#include <cstdio>
#include <string>
#include <vector>

#include "emulator/board_kind.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

struct LongProgram {
  const char* name;
  const char* text;
};
constexpr LongProgram programs[] = {
    {"a long rapid", "G0 X390\nM2\n"},
    {"rapids back and forth", "G0 X200\nG0 X-200\nG0 X300\nG0 X0\nM2\n"},
    {"rapids of two axes", "G0 X300 Y200\nG0 X-300 Y-150\nG0 X0 Y0\nM2\n"},
    {"long moves in space",
     "G64 F15000\nG1 X300 Y200 Z-30\nG1 X-250 Y150 Z10\nG1 X100 Y-220 Z-50\nG1 X-300 Y-250 Z5\nM2\n"},
    {"a diagonal", "G64 F15000\nG1 X250 Y250 Z-100\nG1 X0 Y0 Z0\nM2\n"},
    {"a zigzag", "G64 F15000\nG1 X300 Y5\nG1 X-300 Y10\nG1 X300 Y15\nG1 X-300 Y20\nM2\n"},
    {"short rapids", "G0 X60\nG0 Y60\nG0 X0\nG0 Y0\nG0 X60\nG0 Y60\nG0 X0\nG0 Y0\nM2\n"},
    {"a rapid of each axis", "G0 X350\nG0 Y280\nG0 Z-110\nG0 X0\nG0 Y0\nG0 Z0\nM2\n"}};

MachineDescription fast_uno() {
  MachineDescription machine = test::example_machine("uno");
  machine.board.highest_event_rate = Hertz(150'000);
  for (AxisDescription& axis : machine.axes) axis.velocity = MmPerSecond(234);
  return machine;
}

test::StepLog::Steps steps_without_line(const MachineDescription& machine, const std::string& text) {
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", text), machine, InterpreterOptions(), diagnostics);
  test::StepLog log;
  job.machine().add_observer(log);
  while (job.advance()) {
  }
  return log.steps;
}

void expect_no_standstill(const LongProgram& program) {
  SCOPED_TRACE(program.name);
  constexpr Seconds between_questions{0.05};
  const MachineDescription machine = fast_uno();
  const std::string text = std::string("G21 G90\n") + program.text;
  auto board = EmulatedBoard::start("uno", PASSO_MOTION_UNO);
  ASSERT_TRUE(board);
  test::StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle), static_cast<unsigned>(motor), down);
  };
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", text), machine, InterpreterOptions(), diagnostics,
                          {.board = board->get()});
  ASSERT_FALSE(job.unsuited()) << *job.unsuited();
  Seconds asked{0};
  while (job.advance()) {
    if ((*board)->elapsed() - asked < between_questions) continue;
    asked = (*board)->elapsed();
    job.session().ask();
  }
  ASSERT_FALSE(job.link().error()) << message_of(*job.link().error());
  static_cast<void>((*board)->run(Seconds(0.01)));
  test::expect_same_way(log.steps, steps_without_line(machine, text));
  std::printf("%s: %zu steps of X\n", program.name, log.steps[0].size());
}

// All programs with PASSO_IN_FULL=1, else the first one.
TEST(UnoRate, never_stands_still_at_150_kHz_with_the_real_host) {
  for (const LongProgram& program : programs) {
    expect_no_standstill(program);
    if (test::in_full() != 1) break;
  }
}

}  // namespace
}  // namespace passo
