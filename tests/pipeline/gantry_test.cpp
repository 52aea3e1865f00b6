// An axis with two motors on the virtual machine: homing squares it to the step, from any skew. And axes that seek
// their switches at once.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"

#include "passo/activity/machine_plant.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {
namespace {

// The Uno's router; the second motor of Y faces the first. Its switches are near.
MachineDescription gantry(double skew) {
  MachineDescription machine = test::example_machine("uno");
  for (AxisDescription& axis : machine.axes) {
    axis.home->switch_at = axis.home->toward_high ? 6 : -6;
    axis.travel_low = -20;
    axis.travel_high = 20;
  }
  machine.axes[1].second =
      SecondMotor{.inverted = !machine.axes[1].inverted, .input = 3, .square = 0.15, .most_skew = 5, .skew = skew};
  return machine;
}

// A machine with its plant, homed as a user does it.
class HomedMachine {
 public:
  HomedMachine(const MachineDescription& machine, bool over_a_line, const PinSetup& wiring)
      : plant_(plant_of(machine)),
        board_(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate),
        line_(board_, machine.board.clock, LineOptions()),
        session_(machine, over_a_line ? static_cast<BoardPort&>(line_) : board_,
                 {.over_a_line = over_a_line,
                  .care = over_a_line ? LinkTimeouts{.answer_within = Seconds(0.25), .patience = Seconds(5)}
                                      : LinkTimeouts{},
                  .greeting = {.session = static_cast<std::uint16_t>(over_a_line ? 1 : 0)},
                  .start = {.place = Point(), .trust = Trust::commanded}}) {
    board_.connect(plant_);
    board_.wire(wiring);
    while (session_.state() == MachineState::offline) session_.poll(endless);
  }

  std::vector<HomedAxis> home() {
    const auto ticket = session_.request(request::Home{});
    EXPECT_TRUE(ticket);
    while (session_.busy()) session_.poll(endless);
    return session_.homing() == nullptr ? std::vector<HomedAxis>{} : session_.homing()->homed();
  }
  void jog(Axis axis, double way) {
    request::Jog jog{.way = {.direction = Point(), .speed = MmPerSecond(10), .distance = Mm(std::abs(way))},
                     .lease = Seconds(10)};
    jog.way.direction[axis] = way;
    EXPECT_TRUE(session_.request(jog));
    while (session_.busy()) session_.poll(endless);
  }
  BoardMachineSession& session() { return session_; }
  // The true position of a motor, in steps.
  std::int64_t truth(std::size_t motor) { return std::llround(plant_.truth_at(session_.now()).positions[motor]); }

 private:
  IdealPlant plant_;
  VirtualMachine board_;
  VirtualLine line_;
  BoardMachineSession session_;
};

void expect_square(const MachineDescription& machine, HomedMachine& homed) {
  const auto first = homed.truth(1);
  const auto second = homed.truth(machine.second_motor_of(1));
  EXPECT_EQ(machine.axes[1].inverted == machine.axes[1].second->inverted ? second : -second, first) << "square";
  const Point place = homed.session().status().position.place;
  EXPECT_EQ(std::llround(place[Axis::y] * machine.axes[1].steps_per_unit), machine.axes[1].inverted ? -first : first);
}

class Gantry : public testing::TestWithParam<bool> {};

TEST_P(Gantry, is_squared_to_the_step_from_any_skew) {
  test::Random random;
  for (int trial = 0; trial < 12 && !HasFailure(); ++trial) {
    const double skew = trial < 3 ? trial * 0.01 - 0.01 : random.between(-4, 4);
    SCOPED_TRACE("skew " + std::to_string(skew));
    const MachineDescription machine = gantry(skew);
    HomedMachine homed(machine, GetParam(), {});
    const std::vector<HomedAxis> axes = homed.home();
    ASSERT_EQ(axes.size(), 3U);
    EXPECT_EQ(homed.session().status().position.trust, Trust::homed);
    EXPECT_FALSE(homed.session().mismatch());
    expect_square(machine, homed);
    ASSERT_TRUE(axes[2].squared);
    EXPECT_NEAR(*axes[2].squared, -skew, 1.01 / 640);
    // Both go on together, also between two steps, and the board's counts agree with the plan.
    for (const double way : {1.23456, -0.54321, 0.0007}) homed.jog(Axis::y, way);
    EXPECT_FALSE(homed.session().mismatch());
    EXPECT_EQ(homed.session().status().position.trust, Trust::homed);
    EXPECT_EQ(homed.truth(3), -homed.truth(1));
  }
}

TEST_P(Gantry, is_square_again_after_a_second_homing) {
  const MachineDescription machine = gantry(1.7);
  HomedMachine homed(machine, GetParam(), {});
  homed.home();
  const std::vector<HomedAxis> again = homed.home();
  ASSERT_EQ(again.size(), 3U);
  EXPECT_NEAR(*again[2].squared, 0, 1e-9);
  EXPECT_NEAR(again[2].way, -machine.axes[1].home->pull_off, 1e-9);
  expect_square(machine, homed);
}

TEST_P(Gantry, is_not_moved_further_apart_than_the_file_allows) {
  MachineDescription machine = gantry(3);
  machine.axes[1].second->most_skew = 1;
  HomedMachine homed(machine, GetParam(), {});
  EXPECT_EQ(homed.home().size(), 2U) << "all but Y";
  EXPECT_EQ(homed.session().homing()->homing_fault(), MachineFault::switch_not_met);
  EXPECT_EQ(homed.session().status().position.trust, Trust::unknown);
}

TEST_P(Gantry, has_normally_closed_switches) {
  MachineDescription machine = gantry(-0.6);
  machine.pins.limits_high = {true, true, true, true};
  machine.pins.emergency_stop_high = machine.pins.driver_enable_high = true;
  HomedMachine homed(machine, GetParam(), pin_setup(machine));
  EXPECT_EQ(homed.home().size(), 3U);
  expect_square(machine, homed);
}
INSTANTIATE_TEST_SUITE_P(OverALine, Gantry, testing::Bool());

TEST(HomedAtOnce, find_the_same_places_sooner) {
  MachineDescription machine = gantry(0.4);
  HomedMachine one_by_one(machine, true, {});
  const Seconds from = one_by_one.session().now();
  const std::vector<HomedAxis> slow = one_by_one.home();
  const Seconds usual = one_by_one.session().now() - from;
  machine.homing_turns = {0, 1, 1};
  HomedMachine at_once(machine, true, {});
  const Seconds since = at_once.session().now();
  const std::vector<HomedAxis> fast = at_once.home();
  const Seconds saved = usual - (at_once.session().now() - since);
  ASSERT_EQ(slow.size(), 3U);
  ASSERT_EQ(fast.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto other = std::ranges::find(slow, fast[i].axis, &HomedAxis::axis);
    EXPECT_NEAR(fast[i].way, other->way, 1e-9);
    EXPECT_NEAR(fast[i].place, other->place, 1e-9);
  }
  expect_square(machine, at_once);
  EXPECT_GT(saved, Seconds(0.2)) << "the way of one of two axes, 6 mm at 25 mm/s";
}

TEST(HomedAtOnce, begin_on_a_closed_switch) {
  MachineDescription machine = gantry(0);
  machine.homing_turns = {0, 1, 1};
  machine.axes[0].home->switch_at = 0.3;  // X stands on its switch
  HomedMachine homed(machine, false, {});
  const std::vector<HomedAxis> axes = homed.home();
  ASSERT_EQ(axes.size(), 3U);
  EXPECT_EQ(axes[1].axis, Axis::x);
  EXPECT_NEAR(axes[1].way, 0.3, 1e-9);
}

}  // namespace
}  // namespace passo
