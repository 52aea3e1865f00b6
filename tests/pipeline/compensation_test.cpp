// Machines whose screws have backlash and errors of pitch, and a host that knows them: the tool goes where the program
// says, to the step, or, where backlash is taken up in motion, within the tolerance.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::DrivenProgram;
using test::DriveOn;

using Place = std::array<double, 3>;  // of X, Y and Z, in steps

// An ideal plant that keeps every place of its slides.
class WatchedPlant final : public Plant {
 public:
  explicit WatchedPlant(const MachineDescription& machine) : plant_(plant_of(machine)) { look(Seconds(0)); }

  void pulse(Seconds time, const MotorSteps& steps) override {
    plant_.pulse(time, steps);
    look(time);
  }
  std::int64_t events_to_next_change() const override { return 1; }
  void command_spindle(Seconds time, double speed) override { plant_.command_spindle(time, speed); }
  void set_switch(std::uint16_t which, bool closed) override { plant_.set_switch(which, closed); }
  std::uint16_t inputs_at(Seconds time) override { return plant_.inputs_at(time); }
  const VirtualSpindle& spindle() const override { return plant_.spindle(); }
  Truth truth_at(Seconds time) override { return plant_.truth_at(time); }

  std::vector<Place> places;

 private:
  void look(Seconds time) {
    const MotorPositions now = plant_.truth_at(time).positions;
    const Place place{now[0], now[1], now[2]};
    if (places.empty() || places.back() != place) places.push_back(place);
  }

  IdealPlant plant_;
};

double between(const Place& a, const Place& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// How far the places of one way are from the other way, at most. Both go the same way in the same order.
double farthest(const std::vector<Place>& way, const std::vector<Place>& other) {
  constexpr std::size_t window = 300;
  double most = 0;
  std::size_t near = 0;
  for (const Place& place : way) {
    const std::size_t first = near > window ? near - window : 0;
    const std::size_t last = std::min(near + window, other.size());
    double least = 1e9;
    for (std::size_t i = first; i < last; ++i) {
      const double distance = between(place, other[i]);
      if (distance <= least) {
        least = distance;
        near = i;
      }
    }
    most = std::max(most, least);
  }
  return most;
}

MachineDescription router_with(const ScrewDescription& screw) {
  MachineDescription machine = test::example_machine("router");
  for (AxisDescription& axis : machine.axes) {
    axis.screw = screw;
    axis.home.reset();
  }
  machine.homing.clear();
  return machine;
}

struct Way {
  std::vector<Place> places;
  double seconds = 0;
  int holds = 0;
  MotorSteps counts{};
};

// Runs a program. `holds` times on the way the motion is held for a while.
Way way_of(const MachineDescription& machine, const std::string& text, const DriveOn& wanted = {}, int holds = 0) {
  WatchedPlant plant(machine);
  DriveOn on = wanted;
  on.plant = &plant;
  if (holds > 0) on.live = live_commitment;
  Diagnostics diagnostics;
  DrivenProgram run(ProgramReader::from_text("t", text), machine, {}, diagnostics, on);
  Way way;
  std::size_t next = 150;
  while (run.advance()) {
    if (way.holds == holds || plant.places.size() < next) continue;
    next = plant.places.size() + 370;
    ++way.holds;
    run.drive().hold();
    test::let_pass(run.drive(), Seconds(0.7));
    run.drive().resume();
  }
  EXPECT_FALSE(diagnostics.any_error());
  way.places = plant.places;
  way.seconds = run.drive().now().value();
  const MachineCounts counts = run.machine().counts();
  for (std::size_t m = 0; m < machine.axes.size(); ++m) way.counts[m] = counts.motors[m].position;
  return way;
}

const char* const circle = "G21 G17 F1200\nG0 X5 Y0\nG3 X5 Y0 I-5 J0\nG1 X0 Y0\nM2\n";
const char* const spiral_of_arcs = "G21 F900\nG2 X6 Y0 I3 J0\nG2 X-2 Y0 Z-1 I-4 J0\nG3 X0 Y0 I1 J0\nM2\n";
const char* const zigzag = "G21 F1500 G64 P0.02\nG1 X2 Y3\nX4 Y0\nX6 Y3\nX5 Y-1\nX1 Y-2\nX0 Y0\nM2\n";

class OnEachProgram : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Backlash, OnEachProgram, testing::Values(circle, spiral_of_arcs, zigzag));

// In steps. Backlash that is taken up in motion may use the tolerance; the longest is that of the zigzag, 0.02 mm.
double allowed() {
  constexpr double tolerance = 0.02;
  return 1 + tolerance * test::example_machine("router").axes[0].steps_per_unit;
}

TEST_P(OnEachProgram, with_backlash_the_tool_goes_as_on_a_machine_without) {
  const MachineDescription ideal = router_with({});
  const MachineDescription real = router_with({.backlash = 0.15});
  const Way wanted = way_of(ideal, GetParam());
  const Way way = way_of(real, GetParam());
  EXPECT_LE(farthest(way.places, wanted.places), allowed());
  EXPECT_LE(farthest(wanted.places, way.places), allowed());
  EXPECT_LE(between(way.places.back(), wanted.places.back()), 1e-9);
  EXPECT_EQ(way.counts, wanted.counts) << "the backlash is taken up for motion up at the end";
  EXPECT_GT(way.seconds, wanted.seconds) << "taking up the backlash takes time";

  const Way careless = way_of(router_with({.backlash = 0.15, .is_compensated = false}), GetParam());
  EXPECT_GT(farthest(careless.places, wanted.places), 10) << "without compensation the backlash shows";
}

TEST(ExactBacklash, without_a_tolerance_the_tool_goes_to_the_step_as_on_a_machine_without) {
  for (const char* const program : {circle, spiral_of_arcs}) {
    const std::string exact = std::string("G61\n") + program;
    const Way wanted = way_of(router_with({}), exact);
    const Way way = way_of(router_with({.backlash = 0.15}), exact, {}, 5);
    EXPECT_LE(farthest(way.places, wanted.places), 1 + 1e-9);
    EXPECT_LE(farthest(wanted.places, way.places), 1 + 1e-9);
  }
}

TEST_P(OnEachProgram, a_hold_does_not_lose_the_side_of_the_backlash) {
  const MachineDescription real = router_with({.backlash = 0.15});
  const Way wanted = way_of(router_with({}), GetParam());
  const Way way = way_of(real, GetParam(), {}, 12);
  EXPECT_GT(way.holds, 5);
  EXPECT_LE(farthest(way.places, wanted.places), allowed());
  EXPECT_LE(farthest(wanted.places, way.places), allowed());
  EXPECT_EQ(way.counts, wanted.counts);
}

TEST_P(OnEachProgram, a_motor_that_turns_the_other_way_takes_up_its_backlash_too) {
  MachineDescription ideal = router_with({});
  MachineDescription real = router_with({.backlash = 0.15});
  for (MachineDescription* machine : {&ideal, &real}) machine->axes[0].inverted = machine->axes[1].inverted = true;
  const Way wanted = way_of(ideal, GetParam());
  const Way way = way_of(real, GetParam());
  EXPECT_LE(farthest(way.places, wanted.places), allowed());
  EXPECT_LE(farthest(wanted.places, way.places), allowed());
}

TEST_P(OnEachProgram, over_a_line_the_side_of_the_backlash_is_kept) {
  const Way wanted = way_of(router_with({}), GetParam());
  const Way way = way_of(router_with({.backlash = 0.15}), GetParam(), {.line = LineOptions{}});
  EXPECT_LE(farthest(way.places, wanted.places), allowed());
  EXPECT_LE(farthest(wanted.places, way.places), allowed());
}

// The line is cut at many times, one run for each. The board plays a tail, and the drive goes on from its
// end.
TEST_P(OnEachProgram, a_broken_line_does_not_lose_the_side_of_the_backlash) {
  const MachineDescription real = router_with({.backlash = 0.15});
  const Way wanted = way_of(router_with({}), GetParam());
  int recoveries = 0;
  for (double cut = 0.1; cut < 3; cut += 0.13) {
    SCOPED_TRACE(cut);
    WatchedPlant plant(real);
    Diagnostics diagnostics;
    DrivenProgram run(ProgramReader::from_text("t", GetParam()), real, {}, diagnostics,
                      {.line = LineOptions{}, .plant = &plant});
    run.line().cut(Seconds(cut), Seconds(0.9));
    while (run.advance()) {
    }
    recoveries += run.drive().ledger()->recoveries();
    EXPECT_LE(farthest(plant.places, wanted.places), allowed());
    EXPECT_LE(farthest(wanted.places, plant.places), allowed());
    EXPECT_LE(between(plant.places.back(), wanted.places.back()), 1e-9);
  }
  EXPECT_GT(recoveries, 5);
}

TEST_P(OnEachProgram, with_limits_of_jerk_the_tool_stays_on_the_path_too) {
  const Way wanted = way_of(test::with_jerk_limits(router_with({})), GetParam());
  const Way way = way_of(test::with_jerk_limits(router_with({.backlash = 0.15})), GetParam(), {}, 3);
  EXPECT_LE(farthest(way.places, wanted.places), allowed());
  EXPECT_LE(farthest(wanted.places, way.places), allowed());
}

const ScrewDescription crooked{.backlash = 0,
                               .errors = {{.at = -3, .off = 0.02},
                                          {.at = -1, .off = 0.004},
                                          {.at = 0.7, .off = -0.01},
                                          {.at = 3.1, .off = 0.01},
                                          {.at = 9, .off = -0.04}}};

// The path itself, nearly: the way of a machine without errors whose steps are far smaller, in the steps of the others.
std::vector<Place> fine_way(const char* program) {
  constexpr double finer = 4;
  MachineDescription machine = router_with({});
  for (AxisDescription& axis : machine.axes) axis.steps_per_unit *= finer;
  machine.board.highest_event_rate = machine.board.highest_event_rate * finer;
  machine.board.clock = machine.board.clock * finer;
  std::vector<Place> places = way_of(machine, program).places;
  for (Place& place : places) {
    for (double& value : place) value /= finer;
  }
  return places;
}

TEST_P(OnEachProgram, with_errors_of_pitch_every_true_place_is_within_a_step) {
  const std::vector<Place> path = fine_way(GetParam());
  const Way way = way_of(router_with(crooked), GetParam());
  EXPECT_LE(farthest(way.places, path), 1);
  EXPECT_LE(farthest(path, way.places), 1);
  ScrewDescription careless = crooked;
  careless.is_compensated = false;
  EXPECT_GT(farthest(way_of(router_with(careless), GetParam()).places, path), 3);
}

TEST_P(OnEachProgram, backlash_and_errors_of_pitch_together) {
  ScrewDescription both = crooked;
  both.backlash = 0.15;
  const std::vector<Place> path = fine_way(GetParam());
  const Way way = way_of(router_with(both), GetParam(), {}, 12);
  EXPECT_LE(farthest(way.places, path), 1);
  EXPECT_LE(farthest(path, way.places), 1);
}

}  // namespace
}  // namespace passo
