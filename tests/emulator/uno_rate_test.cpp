// The Uno's stated rates with the real host: long programs whose fastest motor makes as many steps a second as the
// board has events, for each length of step pulses. The board is asked for its status 20 times a second. It makes every
// step, each at its time, and never stands still.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "emulator/board_kind.hpp"
#include "emulator/stated_timing.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo {
namespace {

struct LongProgram {
  const char* name;
  const char* text;
};
constexpr LongProgram programs[] = {
    {"a large circle", "G64 F15000\nG0 X200\nG3 X200 Y0 I-200 J0\nM2\n"},
    {"a zigzag", "G64 F15000\nG1 X300 Y5\nG1 X-300 Y10\nG1 X300 Y15\nG1 X-300 Y20\nM2\n"},
    {"a helix", "G64 F15000\nG0 X150\nG3 X150 Y0 Z-40 I-150 J0\nM2\n"},
    {"a long rapid", "G0 X390\nM2\n"},
    {"circles", "G64 F15000\nG0 X60\nG3 X60 Y0 I-60 J0\nG3 X60 Y0 I-60 J0\nM2\n"},
    {"rapids of two axes", "G0 X300 Y200\nG0 X-300 Y-150\nG0 X0 Y0\nM2\n"},
    {"long moves in space",
     "G64 F15000\nG1 X300 Y200 Z-30\nG1 X-250 Y150 Z10\nG1 X100 Y-220 Z-50\nG1 X-300 Y-250 Z5\nM2\n"},
    {"a diagonal", "G64 F15000\nG1 X250 Y250 Z-100\nG1 X0 Y0 Z0\nM2\n"},
    {"short rapids", "G0 X60\nG0 Y60\nG0 X0\nG0 Y0\nG0 X60\nG0 Y60\nG0 X0\nG0 Y0\nM2\n"},
    {"a rapid of each axis", "G0 X350\nG0 Y280\nG0 Z-110\nG0 X0\nG0 Y0\nG0 Z0\nM2\n"}};

MachineDescription fast_uno(const StepTiming& timing) {
  MachineDescription machine = test::example_machine("uno");
  const double rate = std::floor(machine.board.clock.value() / timing.event_ticks);
  machine.board.highest_event_rate = Hertz(rate);
  for (AxisDescription& axis : machine.axes) axis.velocity = MmPerSecond(rate / axis.steps_per_unit * 0.999);
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

// The steps of the items as the host means them, in ticks. It does not know how long the board rests between motions.
test::StepLog::Steps steps_of(const std::vector<BoardSegment>& segments, std::uint8_t motors) {
  test::StepLog log;
  Player player(motors);
  std::int64_t now = 0;
  const auto play = [&](const BoardSegment& part) {
    for (player.load(part); !player.done();) {
      now += player.wait();
      log.on_steps(Ticks{now}, player.play(), part.directions);
    }
  };
  for (const BoardSegment& segment : segments) for_each_plain_part(segment, play);
  return log.steps;
}

// How far apart fast steps are from what the host means, at the most, in ticks. Next to a rest steps are slow.
std::int64_t greatest_error(const test::StepLog::Steps& seen, const test::StepLog::Steps& meant) {
  constexpr std::int64_t slow = 2'000;
  std::int64_t most = 0;
  for (unsigned m = 0; m < test::StepLog::motors; ++m) {
    EXPECT_EQ(seen[m].size(), meant[m].size()) << "motor " << m;
    std::int64_t earliest = 0;
    std::int64_t latest = 0;
    for (std::size_t i = 0; i < std::min(seen[m].size(), meant[m].size()); ++i) {
      const std::int64_t off = seen[m][i].tick - meant[m][i].tick;
      const bool goes_on = i != 0 && meant[m][i].tick - meant[m][i - 1].tick < slow;
      earliest = goes_on ? std::min(earliest, off) : off;
      latest = goes_on ? std::max(latest, off) : off;
      most = std::max(most, latest - earliest);
    }
  }
  return most;
}

void expect_no_standstill(const LongProgram& program, const StepTiming& wanted) {
  SCOPED_TRACE(program.name);
  constexpr Seconds between_questions{0.05};
  constexpr std::int64_t unavoidable = 3;  // board_test.cpp
  auto board = EmulatedBoard::start("uno", PASSO_MOTION_UNO);
  ASSERT_TRUE(board);
  const std::optional<StepTiming> timing = test::stated_timing(**board, wanted);
  ASSERT_TRUE(timing);
  const MachineDescription machine = fast_uno(*timing);
  const std::string text = std::string("G21 G90\n") + program.text;
  test::StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle), static_cast<unsigned>(motor), down);
  };
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", text), machine, InterpreterOptions(), diagnostics,
                          {.board = board->get()});
  ASSERT_FALSE(job.unsuited()) << *job.unsuited();
  std::vector<BoardSegment> played;
  job.drive().ledger()->watch_executed([&](const LinkItem& item) {
    if (const auto* segment = std::get_if<BoardSegment>(&item)) played.push_back(*segment);
  });
  Seconds asked{0};
  while (job.advance()) {
    if ((*board)->elapsed() - asked < between_questions) continue;
    asked = (*board)->elapsed();
    job.session().ask();
  }
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  static_cast<void>((*board)->run(Seconds(0.01)));
  const std::int64_t error =
      greatest_error(log.steps, steps_of(played, static_cast<std::uint8_t>(machine.axes.size())));
  EXPECT_LE(error, unavoidable);
  test::expect_same_way(log.steps, steps_without_line(machine, text), 8);
  std::printf("%s at %.0f a second: %zu steps of X, error %lld cycles, %zu segments\n", program.name,
              machine.board.highest_event_rate.value(), log.steps[0].size(), static_cast<long long>(error),
              played.size());
}

// The length of the pulses: 1, 2.5, 5 and 10 microseconds.
constexpr std::uint8_t shortest = 16;
class UnoRate : public testing::TestWithParam<std::uint8_t> {};
INSTANTIATE_TEST_SUITE_P(pulses, UnoRate, testing::Values(shortest, 40, 80, 160),
                         [](const auto& pulse) { return "of_" + std::to_string(pulse.param) + "_ticks"; });

// All programs with PASSO_IN_FULL=1. Else a few of them, with the shortest pulses only.
TEST_P(UnoRate, never_stands_still_at_the_rate_that_it_states_with_the_real_host) {
  const bool all = test::in_full() == 1;
  if (!all && GetParam() != shortest) GTEST_SKIP() << "takes a minute: PASSO_IN_FULL=1";
  const std::size_t count = all ? std::size(programs) : test::in_full() != 0 ? 3 : 1;
  for (std::size_t i = 0; i < count; ++i) expect_no_standstill(programs[i], {.pulse = GetParam(), .set_up = 11});
}

}  // namespace
}  // namespace passo
