// Threads on the firmware itself, emulated: its encoder's pins are driven by a spindle that its own outputs command,
// and the groove is where the steps come out of its pins.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/in_full.hpp"
#include "pipeline/spindle_kit.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

using test::BadLine;
using test::Cut;
using test::grooves_at;
using test::Spread;
using test::spread;
using test::thread_program;

using test::mega;
using test::pico_lathe;
using Kind = test::BoardKind;
constexpr double clock_rate = 16e6;

MachineDescription lathe_on_board(const SpindleDescription& spindle) {
  MachineDescription machine = test::example_machine("uno");
  machine.board.highest_event_rate = Hertz(100'000);
  machine.spindle = spindle;
  return machine;
}

// As the virtual machine's; a disc of 1,024 lines.
SpindleDescription rippling_disc() {
  SpindleDescription spindle = test::rippling;
  spindle.counts_per_turn = 1024;
  return spindle;
}

struct TurnedPart {
  std::vector<Cut> cuts;
  std::optional<LinkError> error;
  int rests = 0;
};

template <class Spoil>
TurnedPart turn(const Kind& kind, const std::string& program, const MachineDescription& machine, const Spoil& spoil) {
  TurnedPart result;
  auto board = EmulatedBoard::start(kind.name, kind.program);
  EXPECT_TRUE(board);
  IdealPlant plant = plant_of(machine);
  (*board)->connect(plant);
  const AxisDescription& z = machine.axes[2];
  double place = 0;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    if (motor != 2) return;
    const bool deeper = down != z.inverted;
    place += deeper ? -1 : 1;
    const double tick = static_cast<double>(cycle) / static_cast<double>(kind.cycles_of_tick);
    const double turns = plant.spindle().turns_at(Seconds(tick / clock_rate));
    if (deeper) result.cuts.push_back({place / z.steps_per_unit, turns});
  };
  BadLine line(**board);
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", program), machine, {}, diagnostics, {.board = &line});
  EXPECT_FALSE(job.unsuited()) << *job.unsuited();
  spoil(line);
  while (job.advance()) {
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  result.error = job.link().error();
  result.rests = job.drive().ledger()->recoveries();
  return result;
}

void has_its_pitch(const Kind& kind) {
  const TurnedPart result = turn(kind, thread_program("600"), lathe_on_board(rippling_disc()), [](BadLine&) {});
  EXPECT_FALSE(result.error) << message_of(*result.error);
  const double wander = spread(result.cuts, 1.5, -4, -19).mm(1.5);
  std::printf("along 10 turns the groove wanders %.4f mm\n", wander);
  EXPECT_LT(wander, 0.02);
}

void passes_lie_in_one_groove(const Kind& kind) {
  const std::string program = "G21 G18 S600 M3\nG0 X5 Z0\nG76 P1.5 Z-9 I-1 J0.3 K0.9 R1.5 H0\nM5\nM2\n";
  const TurnedPart result = turn(kind, program, lathe_on_board(rippling_disc()), [](BadLine&) {});
  EXPECT_FALSE(result.error) << message_of(*result.error);
  double worst = 0;
  std::size_t passes = 0;
  for (const double z : {-5.0, -6.0, -8.0}) {
    Spread all;
    const std::vector<double> grooves = grooves_at(result.cuts, 1.5, z);
    for (const double pass : grooves) all.see(pass);
    passes = grooves.size();
    EXPECT_GE(passes, 5U);
    worst = std::max(worst, all.mm(1.5));
  }
  std::printf("%zu passes lie within %.4f mm of each other\n", passes, worst);
  EXPECT_LT(worst, 0.02);
}

TEST(MegaThread, has_its_pitch_though_the_spindle_ripples_by_5_percent) {
  has_its_pitch(mega);
}
TEST(MegaThread, passes_of_a_threading_cycle_lie_in_one_groove) {
  passes_lie_in_one_groove(mega);
}
TEST(PicoThread, has_its_pitch_though_the_spindle_ripples_by_5_percent) {
  if (const std::string why = test::missing(pico_lathe); !why.empty()) GTEST_SKIP() << why;
  has_its_pitch(pico_lathe);
}
TEST(PicoThreadInFull, passes_of_a_threading_cycle_lie_in_one_groove) {
  if (test::in_full() == 0) GTEST_SKIP() << "takes long: PASSO_IN_FULL=1";
  if (const std::string why = test::missing(pico_lathe); !why.empty()) GTEST_SKIP() << why;
  passes_lie_in_one_groove(pico_lathe);
}

}  // namespace
}  // namespace passo
