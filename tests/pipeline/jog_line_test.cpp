// Jogging: as far as the distance or the travel, stopped at any instant, and with every step counted.
#include <cmath>
#include <string>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"

namespace passo {
namespace {

using test::DrivenJog;
using test::example_machine;

void expect_at(const MachineDescription& description, const VirtualMachine& machine, const Point& place) {
  const MachineCounts counts = machine.counts();
  for (std::size_t m = 0; m < description.axes.size(); ++m) {
    const AxisDescription& axis = description.axes[m];
    const double steps = place[axis.axis] * (axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit);
    EXPECT_NEAR(static_cast<double>(counts.motors[m].position), steps, 0.5 + 1e-6) << letter_of(axis.axis);
  }
}

TEST(JogLine, by_a_distance_goes_just_so_far) {
  const MachineDescription router = example_machine("router");
  DrivenJog jog(router, Point(), {.direction = test::xyz(3, 4), .speed = MmPerSecond(20), .distance = Mm(10)});
  while (jog.advance()) {
  }
  EXPECT_NEAR(jog.place()[Axis::x], 6, 1e-9);
  EXPECT_NEAR(jog.place()[Axis::y], 8, 1e-9);
  expect_at(router, jog.machine(), jog.place());
}

TEST(JogLine, ends_at_the_travel_at_rest) {
  const MachineDescription router = example_machine("router");
  DrivenJog jog(router, test::xyz(0, 290), {.direction = test::xyz(1, 1), .speed = MmPerSecond(500)});
  while (jog.advance()) {
  }
  EXPECT_EQ(jog.place()[Axis::y], 300);
  EXPECT_NEAR(jog.place()[Axis::x], 10, 1e-9);
  expect_at(router, jog.machine(), jog.place());
}

TEST(JogLine, that_is_stopped_at_random_instants_brakes_and_never_leaves_the_travel) {
  test::Random random;
  for (const char* name : {"bench", "router", "pantograph", "forty-eight"}) {
    SCOPED_TRACE(name);
    const MachineDescription description = example_machine(name);
    // The slowest of the axes brakes with 30 mm/s².
    double braking = 0;
    for (const AxisDescription& axis : description.axes) {
      braking = std::max(braking, axis.velocity / axis.acceleration / Seconds(1));
    }
    Point place;
    for (int i = 0; i < 100; ++i) {
      const Point direction =
          test::xyz(random.between(-1, 1), random.between(-1, 1), random.chance(0.5) ? random.between(-1, 1) : 0);
      DrivenJog jog(description, place,
                    {.direction = direction,
                     .speed = MmPerSecond(random.between(1, 120)),
                     .distance = random.chance(0.3) ? Mm(random.between(0.01, 20)) : Mm(0)});
      const std::int64_t x_before = jog.machine().counts().motors[0].position;
      const double stop_at = jog.drive().now().value() + random.between(0.08, 0.5);
      double stopped = 0;
      while (jog.advance()) {
        if (stopped > 0 || jog.drive().now().value() < stop_at) continue;
        stopped = jog.drive().now().value();
        jog.drive().stop();
      }
      if (stopped > 0) {
        // What is committed is played before the machine brakes.
        const double committed = live_commitment.horizon.value() + 3 * live_commitment.longest_move.value();
        EXPECT_LE(jog.drive().now().value(), stopped + committed + braking + 1e-3);
      }
      for (const AxisDescription& axis : description.axes) {
        EXPECT_GE(jog.place()[axis.axis], axis.travel_low);
        EXPECT_LE(jog.place()[axis.axis], axis.travel_high);
      }
      const AxisDescription& x = description.axes[0];
      const auto steps = static_cast<double>(jog.machine().counts().motors[0].position - x_before);
      EXPECT_EQ(steps,
                std::round(jog.place()[x.axis] * x.steps_per_unit) - std::round(place[x.axis] * x.steps_per_unit));
      place = jog.place();
    }
  }
}

}  // namespace
}  // namespace passo
