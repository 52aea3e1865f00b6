// Probing with the firmware itself, emulated, at the end of a line that is good or is cut: its probe's pin is touched
// by what comes out of its steps' pins.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/step_log.hpp"
#include "pipeline/probe_line_kit.hpp"

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

using test::BadLine;
using test::below;
using test::ContactOracle;
using test::expect_as_the_oracle_saw;
using test::LineProbing;
using test::plate;
using test::StepLog;
using test::touches;

using test::mega;
using test::pico;
using test::uno;
using Kind = test::BoardKind;

// Slow enough for either.
MachineDescription machine_of_both() {
  MachineDescription machine = test::example_machine("uno");
  machine.board.highest_event_rate = Hertz(100'000);
  return machine;
}

template <class Spoil>
LineProbing run(const Kind& kind, const MachineDescription& machine, const Spoil& spoil) {
  LineProbing result;
  auto board = EmulatedBoard::start(kind.name, kind.program);
  EXPECT_TRUE(board);
  const TouchBox box = below(Axis::z, plate);
  IdealPlant plant = plant_of(machine, Point(), {box});
  (*board)->connect(plant);
  ContactOracle oracle(machine, box);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    const auto bit = static_cast<std::uint8_t>(1U << motor);
    const Ticks time{static_cast<std::int64_t>(cycle) / kind.cycles_of_tick};
    oracle.on_steps(time, bit, down ? bit : std::uint8_t{0});
    log.on_steps(time, bit, down ? bit : std::uint8_t{0});
  };
  BadLine line(**board);
  test::DrivenProgram job(ProgramReader::from_text("t", touches), machine, {}, result.diagnostics, {.board = &line});
  EXPECT_FALSE(job.unsuited());
  job.drive().probe().watch([&](const ProbeOutcome& outcome) { result.outcomes.push_back(outcome); });
  spoil(line);
  const std::uint64_t before = line.frames();
  while (job.advance()) {
  }
  static_cast<void>((*board)->run(Seconds(0.01)));
  result.frames = line.frames() - before;
  result.error = job.link().error();
  result.contacts = oracle.contacts;
  result.releases = oracle.releases;
  result.end = oracle.place();
  result.recoveries = job.drive().ledger()->recoveries();
  result.longest_ahead = job.drive().ledger()->longest_ahead();
  test::expect_within_limits(machine, log.steps);
  return result;
}

void finds_the_step(const Kind& kind) {
  const MachineDescription machine = machine_of_both();
  const LineProbing result = run(kind, machine, [](BadLine&) {});
  expect_as_the_oracle_saw(machine, result);
  std::printf(
      "%s: at most %.1f ms ahead, %d rests; from contact to rest %.3f mm at 8.3 mm/s, %.3f at 2, %.3f at 0.67\n",
      kind.name, 1000 * result.longest_ahead.value(), result.recoveries,
      distance(result.outcomes[0].rest, result.outcomes[0].contact),
      distance(result.outcomes[1].rest, result.outcomes[1].contact),
      distance(result.outcomes[2].rest, result.outcomes[2].contact));
}

void probe_cut_before_frames(const Kind& kind, std::uint64_t stride) {
  const MachineDescription machine = machine_of_both();
  const LineProbing whole = run(kind, machine, [](BadLine&) {});
  int trials = 0;
  int recoveries = 0;
  for (std::uint64_t frame = 0; frame < whole.frames && !testing::Test::HasFatalFailure(); frame += stride, ++trials) {
    SCOPED_TRACE(kind.name + std::string(", cut before frame ") + std::to_string(frame));
    const LineProbing cut =
        run(kind, machine, [&](BadLine& line) { line.cut_at(line.frames() + frame, Seconds(0.3)); });
    expect_as_the_oracle_saw(machine, cut);
    recoveries += cut.recoveries;
  }
  std::printf("%s: %d cuts, %d rests\n", kind.name, trials, recoveries);
  EXPECT_GT(recoveries, trials / 4) << "cuts that stop no motion prove little";
}

TEST(EmulatedProbing, finds_the_step_of_contact_on_the_uno) {
  finds_the_step(uno);
}
TEST(EmulatedProbing, finds_the_step_of_contact_on_the_mega) {
  finds_the_step(mega);
}
TEST(EmulatedProbing, finds_the_step_of_contact_on_the_pico) {
  if (const std::string why = test::missing(pico); !why.empty()) GTEST_SKIP() << why;
  finds_the_step(pico);
  probe_cut_before_frames(pico, 499);
}
TEST(EmulatedProbing, finds_it_where_the_line_was_cut) {
  probe_cut_before_frames(uno, static_cast<std::uint64_t>(97 * test::one_in(2)));
  probe_cut_before_frames(mega, static_cast<std::uint64_t>(211 * test::one_in(2)));
}
TEST(EmulatedProbingInFull, cut_before_every_frame) {
  if (test::in_full() == 0) GTEST_SKIP() << "takes minutes: PASSO_IN_FULL=1";
  probe_cut_before_frames(uno, test::in_full());
  probe_cut_before_frames(mega, 7 * test::in_full());
  if (test::missing(pico).empty()) probe_cut_before_frames(pico, 3 * test::in_full());
}

}  // namespace
}  // namespace passo
