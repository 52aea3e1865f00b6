// Jogging: as long as the lease, within the travel, and with every step counted.
#include <cmath>
#include <string>

#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"

#include "passo/activity/jog_line.hpp"

namespace passo {
namespace {

using test::example_machine;

VirtualMachine machine_of(const MachineDescription& description) {
  return VirtualMachine(static_cast<std::uint8_t>(description.axes.size()), description.board.clock,
                        description.board.highest_event_rate);
}

void expect_at(const MachineDescription& description, const VirtualMachine& machine, const Point& place) {
  const MachineCounts counts = machine.counts();
  for (std::size_t m = 0; m < description.axes.size(); ++m) {
    const AxisDescription& axis = description.axes[m];
    const double steps = place[axis.axis] * (axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit);
    EXPECT_NEAR(static_cast<double>(counts.motors[m].position), steps, 0.5 + 1e-6) << letter_of(axis.axis);
  }
}

TEST(Jog, by_a_distance_goes_just_so_far) {
  const MachineDescription router = example_machine("router");
  VirtualMachine machine = machine_of(router);
  Jog jog(router, machine, Point(),
          {.direction = test::xyz(3, 4), .speed = MmPerSecond(20), .distance = Mm(10), .lease = Seconds(60)});
  while (jog.advance()) {
  }
  EXPECT_NEAR(jog.place()[Axis::x], 6, 1e-9);
  EXPECT_NEAR(jog.place()[Axis::y], 8, 1e-9);
  expect_at(router, machine, jog.place());
}

TEST(Jog, ends_at_the_travel_at_rest_however_long_it_is_renewed) {
  const MachineDescription router = example_machine("router");
  VirtualMachine machine = machine_of(router);
  Jog jog(router, machine, test::xyz(0, 290), {.direction = test::xyz(1, 1), .speed = MmPerSecond(500)});
  while (jog.advance()) jog.renew();
  EXPECT_EQ(jog.place()[Axis::y], 300);
  EXPECT_NEAR(jog.place()[Axis::x], 10, 1e-9);
}

TEST(Jog, that_is_not_renewed_brakes_at_the_end_of_its_lease_at_the_latest) {
  const MachineDescription router = example_machine("router");
  VirtualMachine machine = machine_of(router);
  Jog jog(router, machine, Point(), {.direction = test::xyz(-1, 0), .speed = MmPerSecond(40)});
  while (jog.advance()) {
  }
  const double braking = 40.0 / 800;
  EXPECT_LE(jog.drive().now().value(), 0.2 + braking + 1e-3);
  EXPECT_GE(jog.drive().now().value(), 0.2 - 0.02);
  expect_at(router, machine, jog.place());
}

// With jerk the deceleration rises and falls for 20 ms each; the lease ends where braking begins all the same.
TEST(Jog, brakes_at_the_end_of_its_lease_where_the_jerk_is_limited) {
  MachineDescription router = example_machine("router");
  for (AxisDescription& axis : router.axes) axis.jerk = MmPerSecond3(axis.acceleration.value() / 0.02);
  VirtualMachine machine = machine_of(router);
  Jog jog(router, machine, Point(), {.direction = test::xyz(-1, 0), .speed = MmPerSecond(40)});
  while (jog.advance()) {
  }
  EXPECT_LE(jog.drive().now().value(), 0.2 + 40.0 / 800 + 0.02 + 2e-3);
  EXPECT_GE(jog.drive().now().value(), 0.2 - 0.02);
  expect_at(router, machine, jog.place());
}

TEST(Jog, with_random_renewals_never_outlives_its_lease_nor_leaves_the_travel) {
  test::Random random;
  for (const char* name : {"bench", "router", "pantograph", "forty-eight"}) {
    SCOPED_TRACE(name);
    const MachineDescription description = example_machine(name);
    VirtualMachine machine = machine_of(description);
    Point place;
    for (int i = 0; i < 100; ++i) {
      const Point direction =
          test::xyz(random.between(-1, 1), random.between(-1, 1), random.chance(0.5) ? random.between(-1, 1) : 0);
      const double speed = random.between(1, 120);
      const std::int64_t x_before = machine.counts().motors[0].position;
      Jog jog(description, machine, place,
              {.direction = direction,
               .speed = MmPerSecond(speed),
               .distance = random.chance(0.3) ? Mm(random.between(0.01, 20)) : Mm(0),
               .lease = Seconds(random.between(0.08, 0.5))});
      const double lease = 0.5;
      double renewed = jog.drive().now().value();
      bool holds = true;
      while (jog.advance()) {
        holds = holds && random.chance(0.97);
        if (!holds) continue;
        jog.renew();
        renewed = jog.drive().now().value();
      }
      // The slowest of the axes brakes with 30 mm/s².
      double braking = 0;
      for (const AxisDescription& axis : description.axes)
        braking = std::max(braking, axis.velocity / axis.acceleration / Seconds(1));
      EXPECT_LE(jog.drive().now().value(), renewed + lease + braking + 1e-3);
      for (const AxisDescription& axis : description.axes) {
        EXPECT_GE(jog.place()[axis.axis], axis.travel_low);
        EXPECT_LE(jog.place()[axis.axis], axis.travel_high);
      }
      const AxisDescription& x = description.axes[0];
      const auto steps = static_cast<double>(machine.counts().motors[0].position - x_before);
      EXPECT_EQ(steps,
                std::round(jog.place()[x.axis] * x.steps_per_unit) - std::round(place[x.axis] * x.steps_per_unit));
      place = jog.place();
    }
  }
}

}  // namespace
}  // namespace passo
