// Homing with the firmware itself, emulated, at the end of a line that is good or is cut: its limit switches are closed
// by what comes out of its steps' pins.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "emulator/bad_line.hpp"
#include "emulator/board_kind.hpp"
#include "kit/in_full.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/homing_kit.hpp"

namespace passo {
namespace {

using test::BadLine;
using test::Distances;
using test::expect_homed;
using test::Homed;
using test::homing_machine;
using test::StepLog;
using test::switches_of;

using test::mega;
using test::pico;
using test::uno;
using Kind = test::BoardKind;

template <class Spoil>
Homed home(const Kind& kind, const MachineDescription& machine, const std::vector<TravelSwitch>& switches,
           const Spoil& spoil) {
  Homed result;
  auto board = EmulatedBoard::start(kind.name, kind.program);
  EXPECT_TRUE(board);
  IdealPlant plant = test::plant_with(switches);
  (*board)->connect(plant);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle) / kind.cycles_of_tick, static_cast<unsigned>(motor), down);
  };
  BadLine line(**board);
  test::DrivenHoming homing(machine, {.board = &line});
  EXPECT_FALSE(homing.unsuited());
  spoil(line);
  const std::uint64_t before = line.frames();
  while (homing.advance()) {
  }
  static_cast<void>((*board)->run(Seconds(0.01)));
  result.frames = line.frames() - before;
  test::note(homing, result);
  result.steps = log.steps;
  result.counts = log.place;
  if (result.error != LinkError::stopped) test::expect_within_limits(machine, log.steps);
  return result;
}
const auto good_line = [](BadLine&) {};

int runs(int few) {
  const char* const given = std::getenv("PASSO_RUNS");
  return given != nullptr ? std::atoi(given) : few;
}

void is_exact_from_anywhere(const Kind& kind, int few = 4) {
  test::Random random;
  const MachineDescription machine = homing_machine();
  const int trials = runs(few);
  double overrun = 0;
  for (int i = 0; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(kind.name + std::string(", trial ") + std::to_string(i));
    Distances distances;
    for (std::int64_t& steps : distances.steps) {
      const double way = random.chance(0.3) ? random.between(-500, 0) : random.between(0, 3000);
      steps = std::llround(way);
    }
    distances.hysteresis = std::llround(random.between(0, 100));
    const Homed result = home(kind, machine, switches_of(machine, distances), good_line);
    expect_homed(machine, distances, result);
    overrun = std::max(overrun, test::expect_small_overrun(machine, distances, result));
  }
  std::printf("%s: %d starts, at most %.2f mm from contact to rest at 20 mm/s\n", kind.name, trials, overrun);
}

void homing_cut_before_frames(const Kind& kind, std::uint64_t stride) {
  const MachineDescription machine = homing_machine();
  const Distances near{.steps = {300, 200, -60}};
  const auto switches = switches_of(machine, near);
  const Homed whole = home(kind, machine, switches, good_line);
  int trials = 0;
  int recoveries = 0;
  for (std::uint64_t frame = 0; frame < whole.frames && !testing::Test::HasFailure(); frame += stride, ++trials) {
    SCOPED_TRACE(kind.name + std::string(", cut before frame ") + std::to_string(frame));
    const Homed cut =
        home(kind, machine, switches, [&](BadLine& line) { line.cut_at(line.frames() + frame, Seconds(0.3)); });
    expect_homed(machine, near, cut);
    recoveries += cut.recoveries;
  }
  std::printf("%s: %llu frames, %d rests without need; %d cuts, %d rests\n", kind.name,
              static_cast<unsigned long long>(whole.frames), whole.recoveries, trials, recoveries);
  EXPECT_GT(recoveries, trials / 4);
}

void homes_by_one_pin(const Kind& kind) {
  MachineDescription machine = homing_machine();
  for (AxisDescription& axis : machine.axes) axis.home->input = 0;
  const Distances distances{.steps = {400, -200, 300}};
  auto switches = switches_of(machine, distances);
  switches.push_back({.input = 1, .motor = 0, .at_high_end = true, .closes_at = 9000, .opens_at = 8990});
  // Y stands on the switch that all share, so it goes first.
  machine.homing = {Axis::y, Axis::z, Axis::x};
  expect_homed(machine, distances, home(kind, machine, switches, good_line));
}

void stops_at_a_switch_of_another_axis(const Kind& kind) {
  const MachineDescription machine = homing_machine();
  auto switches = switches_of(machine, Distances{.steps = {400, 300, 500}});
  std::swap(switches[0].input, switches[2].input);
  const Homed result = home(kind, machine, switches, good_line);
  EXPECT_EQ(result.error, LinkError::stopped);
  EXPECT_FALSE(result.done);
  EXPECT_EQ(result.counts[2], 500) << "no further step";
}

TEST(EmulatedHoming, is_exact_from_anywhere_on_the_uno) {
  is_exact_from_anywhere(uno);
}
TEST(EmulatedHoming, is_exact_from_anywhere_on_the_mega) {
  is_exact_from_anywhere(mega);
}
// One axis at least stands on its switch while another one is homed.
TEST(EmulatedHoming, of_the_pico_is_exact) {
  if (const std::string why = test::missing(pico); !why.empty()) GTEST_SKIP() << why;
  is_exact_from_anywhere(pico, 1);
  homes_by_one_pin(pico);
  stops_at_a_switch_of_another_axis(pico);
}
TEST(EmulatedHoming, homes_by_switches_on_one_pin) {
  homes_by_one_pin(uno);
  homes_by_one_pin(mega);
}
TEST(EmulatedHoming, is_stopped_by_a_switch_of_another_axis) {
  stops_at_a_switch_of_another_axis(uno);
  stops_at_a_switch_of_another_axis(mega);
}
TEST(EmulatedHoming, is_exact_where_the_line_was_cut) {
  homing_cut_before_frames(uno, static_cast<std::uint64_t>(1597 * test::one_in(2)));
  homing_cut_before_frames(mega, static_cast<std::uint64_t>(3191 * test::one_in(2)));
}
using EmulatedHomingInFull = test::InFull<::testing::Test>;
TEST_F(EmulatedHomingInFull, is_exact_where_the_line_was_cut) {
  homing_cut_before_frames(uno, 3 * test::in_full());
  homing_cut_before_frames(mega, 7 * test::in_full());
}
TEST_F(EmulatedHomingInFull, is_exact_where_the_line_was_cut_on_the_pico) {
  if (const std::string why = test::missing(pico); !why.empty()) GTEST_SKIP() << why;
  homing_cut_before_frames(pico, std::min<std::uint64_t>(29 * test::in_full(), 4211));
}

}  // namespace
}  // namespace passo
