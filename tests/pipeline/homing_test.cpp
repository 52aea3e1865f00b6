// Homing on the virtual machine: its place is found to the step from wherever it stands, and what is wrong is told.
#include "kit/stage_test.hpp"
#include "pipeline/homing_kit.hpp"

#include "passo/activity/machine_plant.hpp"

namespace passo {
namespace {

using test::Distances;
using test::DrivenHoming;
using test::expect_homed;
using test::Homed;
using test::homing_machine;
using test::plant_with;
using test::StepLog;
using test::switches_of;

struct Setting {
  bool over_a_line = false;
  std::vector<TravelSwitch> switches;
};

Homed home(const MachineDescription& machine, const Setting& setting) {
  IdealPlant plant = plant_with(setting.switches);
  const auto line = setting.over_a_line ? std::optional(LineOptions{}) : std::nullopt;
  DrivenHoming homing(machine, {.line = line, .plant = &plant});
  VirtualMachine& board = homing.machine();
  StepLog log;
  board.add_observer(log);
  while (homing.advance()) {
  }
  Homed result;
  test::note(homing, result);
  for (std::size_t m = 0; m < 3; ++m) result.counts[m] = board.counts().motors[m].position;
  result.steps = log.steps;
  result.inputs = board.board().inputs();
  // A stop at once leaves the limits of the acceleration.
  if (result.error != LinkError::stopped) test::expect_within_limits(machine, log.steps);
  return result;
}

Distances anywhere(test::Random& random) {
  Distances distances;
  for (std::int64_t& steps : distances.steps) {
    const double way = random.chance(0.3) ? random.between(-500, 0) : random.between(0, 6000);
    steps = std::llround(way);
  }
  distances.hysteresis = std::llround(random.between(0, 100));
  return distances;
}

class HomingFromAnywhere : public testing::TestWithParam<bool> {};
TEST_P(HomingFromAnywhere, is_exact_to_the_step) {
  test::Random random;
  const MachineDescription machine = homing_machine();
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    SCOPED_TRACE("trial " + std::to_string(i));
    const Distances distances = anywhere(random);
    const Homed result = home(machine, {.over_a_line = GetParam(), .switches = switches_of(machine, distances)});
    expect_homed(machine, distances, result);
    test::expect_small_overrun(machine, distances, result);
    EXPECT_EQ(result.inputs, 0) << "all switches are open";
  }
}
INSTANTIATE_TEST_SUITE_P(OverALine, HomingFromAnywhere, testing::Bool());

TEST(HomingTest, keeps_limits_of_jerk) {
  const MachineDescription machine = test::with_jerk_limits(homing_machine("router"));
  const Distances distances;
  for (const bool over_a_line : {false, true}) {
    expect_homed(machine, distances,
                 home(machine, {.over_a_line = over_a_line, .switches = switches_of(machine, distances)}));
  }
}

TEST(HomingTest, comes_from_far_and_goes_in_the_order_of_the_file) {
  MachineDescription machine = homing_machine("router");
  machine.homing = {Axis::y, Axis::z, Axis::x};
  const Distances distances{.steps = {100'000, 150'000, 50'000}};
  const Homed result = home(machine, {.switches = switches_of(machine, distances)});
  expect_homed(machine, distances, result);
  ASSERT_EQ(result.axes.size(), 3U);
  EXPECT_EQ(result.axes[0].axis, Axis::y);
  EXPECT_DOUBLE_EQ(result.axes[0].way, -150'000 / 640.0);
  EXPECT_DOUBLE_EQ(result.axes[1].way, 50'000 / 640.0);
  // One after the other.
  EXPECT_LT(result.steps[1].back().tick, result.steps[2].front().tick);
  EXPECT_LT(result.steps[2].back().tick, result.steps[0].front().tick);
}

// All switches in one chain on one pin, those of the other ends too.
TEST(HomingTest, homes_by_switches_that_share_a_pin) {
  MachineDescription machine = homing_machine();
  for (AxisDescription& axis : machine.axes) axis.home->input = 0;
  const Distances distances;
  std::vector<TravelSwitch> switches = switches_of(machine, distances);
  switches.push_back({.input = 1, .motor = 0, .at_high_end = true, .closes_at = 9000, .opens_at = 8990});
  for (const bool over_a_line : {false, true}) {
    expect_homed(machine, distances, home(machine, {.over_a_line = over_a_line, .switches = switches}));
  }
}

TEST(HomingTest, homes_while_other_axes_stand_on_their_switches) {
  const MachineDescription machine = homing_machine();
  const Distances distances{.steps = {-400, -10, -200}};
  for (const bool over_a_line : {false, true}) {
    expect_homed(machine, distances,
                 home(machine, {.over_a_line = over_a_line, .switches = switches_of(machine, distances)}));
  }
}

TEST(HomingTest, seeks_as_far_as_1_1_of_the_travel) {
  MachineDescription machine = homing_machine();
  machine.axes[2].travel_low = 50;  // 10 mm
  machine.axes[2].home->switch_at = 60;
  for (const bool over_a_line : {false, true}) {
    const Homed there =
        home(machine, {.over_a_line = over_a_line, .switches = switches_of(machine, {.steps = {2000, 3000, 7030}})});
    EXPECT_TRUE(there.done);
    const Homed result =
        home(machine, {.over_a_line = over_a_line, .switches = switches_of(machine, {.steps = {2000, 3000, 7050}})});
    EXPECT_FALSE(result.done);
    EXPECT_EQ(result.fault, MachineFault::switch_not_met);
    EXPECT_EQ(result.counts[2], 7040);
    EXPECT_EQ(result.counts[0], 0) << "no other axis is tried";
  }
}

TEST(HomingTest, tells_a_switch_that_does_not_open) {
  const MachineDescription machine = homing_machine();
  for (const std::int64_t steps : {-700, 1000}) {
    Distances distances{.steps = {2000, 3000, steps}};
    std::vector<TravelSwitch> switches = switches_of(machine, distances);
    if (steps > 0) switches[2].opens_at = steps - 650;
    const Homed result = home(machine, {.over_a_line = true, .switches = switches});
    EXPECT_EQ(result.fault, MachineFault::switch_still_closed);
    EXPECT_EQ(result.counts[2], steps > 0 ? steps - 640 : -640) << "no further than the pull-off";
    EXPECT_EQ(result.counts[0], 0);
  }
}

TEST(HomingTest, a_switch_of_another_axis_stops_it_at_once) {
  const MachineDescription machine = homing_machine();
  for (const bool over_a_line : {false, true}) {
    const Distances distances;
    std::vector<TravelSwitch> switches = switches_of(machine, distances);
    // Wired to the wrong pins.
    std::swap(switches[0].input, switches[2].input);
    const Homed result = home(machine, {.over_a_line = over_a_line, .switches = switches});
    EXPECT_EQ(result.error, LinkError::stopped);
    EXPECT_FALSE(result.done);
    EXPECT_EQ(result.counts[2], 1000) << "at the very step";
    EXPECT_EQ(result.inputs, 1);
  }
}

// The switch of Z is closed where `closed` says so, in its steps.
template <class Closed>
Homed home_by(const MachineDescription& machine, const Closed& closed) {
  struct Switch final : MachineObserver {
    Switch(VirtualMachine& machine, const Closed& where) : board(machine), closed_at(where) {}
    VirtualMachine& board;
    const Closed& closed_at;
    std::int64_t place = 0;
    void on_steps(Ticks, std::uint8_t stepped, std::uint8_t directions) override {
      if ((stepped & 4U) != 0) place += (directions & 4U) != 0 ? -1 : 1;
      board.set_switch(4, closed_at(place));
    }
  };
  const std::vector<TravelSwitch> switches = switches_of(machine, Distances());
  IdealPlant plant = plant_with({switches[0], switches[1]});
  DrivenHoming homing(machine, {.plant = &plant});
  VirtualMachine& board = homing.machine();
  Switch of_z(board, closed);
  board.add_observer(of_z);
  while (homing.advance()) {
  }
  Homed result;
  test::note(homing, result);
  for (std::size_t m = 0; m < 3; ++m) result.counts[m] = board.counts().motors[m].position;
  return result;
}

TEST(HomingTest, a_switch_that_bounces_is_homed_by_its_first_edge) {
  const MachineDescription machine = homing_machine();
  const Homed result =
      home_by(machine, [](std::int64_t at) { return at >= 1010 || (at >= 1000 && at < 1003) || at == 990; });
  // It also closes for a step in front of the place.
  Distances distances;
  distances.steps[2] = 990;
  expect_homed(machine, distances, result);
}

TEST(HomingTest, contacts_that_bounce_are_homed_by_their_first_edge) {
  test::Random random;
  const MachineDescription machine = homing_machine();
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    SCOPED_TRACE("trial " + std::to_string(i));
    Distances distances = anywhere(random);
    distances.bounce = Seconds(random.between(0, 20e-3));
    const Homed result = home(machine, {.over_a_line = i % 2 != 0, .switches = switches_of(machine, distances)});
    expect_homed(machine, distances, result);
    EXPECT_EQ(result.inputs, 0) << "all switches are open";
  }
}

TEST(HomingTest, tells_a_switch_that_never_comes_to_rest) {
  const Homed result = home_by(homing_machine(), [](std::int64_t at) { return (at / 4) % 2 != 0; });
  EXPECT_EQ(result.fault, MachineFault::switch_unsteady);
  EXPECT_FALSE(result.done);
  EXPECT_EQ(result.counts[0], 0);
}

TEST(HomingTest, an_operators_stop_ends_it_at_rest) {
  const MachineDescription machine = homing_machine();
  IdealPlant plant = plant_with(switches_of(machine, Distances()));
  DrivenHoming homing(machine, {.plant = &plant});
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(homing.advance());
  homing.drive().stop();
  while (homing.advance()) {
  }
  EXPECT_FALSE(homing.done());
  EXPECT_FALSE(homing.path().homing_fault());
  EXPECT_LT(homing.machine().counts().motors[2].position, 1000);
}

TEST(HomeSwitches, close_where_the_machine_file_says) {
  MachineDescription machine = homing_machine();
  std::vector<TravelSwitch> switches = home_switches(machine);
  ASSERT_EQ(switches.size(), 3U);
  EXPECT_EQ(switches[0].closes_at, -256'256);
  EXPECT_EQ(switches[0].opens_at, -256'256 + 32);
  EXPECT_FALSE(switches[0].at_high_end);
  EXPECT_TRUE(switches[1].at_high_end) << "its motor turns the other way";
  EXPECT_EQ(switches[2].closes_at, 38'656);
  EXPECT_EQ(switches[2].opens_at, 38'656 - 32);
  EXPECT_EQ(switches[2].bounce, Seconds(0));
  machine.axes[2].home->hysteresis = 0.1;
  machine.axes[2].home->bounce = Seconds(2e-3);
  switches = home_switches(machine);
  EXPECT_EQ(switches[2].opens_at, 38'656 - 64);
  EXPECT_EQ(switches[2].bounce, Seconds(2e-3));
}

}  // namespace
}  // namespace passo
