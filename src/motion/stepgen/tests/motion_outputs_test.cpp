// Where the outputs change between two events.
#include <cmath>
#include <vector>

#include "kit/stage_test.hpp"
#include "kit/step_oracle.hpp"

#include "passo/stepgen/step_generator.hpp"

namespace passo {
namespace {

using test::xyz;

StepOptions machine() {
  StepOptions options;
  for (const Axis axis : {Axis::x, Axis::y}) options.kinematics.add({.steps = {axis, 160}});
  return options;
}

// Random moves at changing speeds, with other outputs in each.
struct Motion {
  std::vector<MotionItem> items;
  std::vector<PathOutputs> outputs;  // the changes
  std::vector<double> times;         // s, exact
};

Motion random_motion(test::Random& random) {
  Motion motion;
  double speed = 0;
  double time = 0;
  Point place;
  for (int i = 0; i < 12; ++i) {
    const bool last = i == 11;
    const double next = last ? 0 : random.between(2, 90);
    const Point end = place + xyz(random.between(0.05, 3), random.between(-1, 1));
    PlannedMove move;
    move.segment.curve = Curve::line(place, end);
    move.to = move.segment.curve.length();
    const double length = move.to.value();
    const double duration = 2 * length / (speed + next);
    move.add({.duration = Seconds(duration),
              .start = Mm(0),
              .velocity = MmPerSecond(speed),
              .acceleration = MmPerSecond2((next - speed) / duration)});
    const PathOutputs outputs{.power = (i + 1) / 16.0};
    move.segment.outputs = outputs;
    motion.items.emplace_back(move);
    motion.outputs.push_back(outputs);
    motion.times.push_back(time);
    time += duration;
    speed = next;
    place = end;
  }
  motion.outputs.emplace_back();  // at the end
  motion.times.push_back(time);
  return motion;
}

TEST(GeneratedOutputs, change_after_the_last_event_before_their_position) {
  const StepOptions options = machine();
  test::Random random;
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion = random_motion(random);
    test::ListSource<MotionItem> source(motion.items);
    StepGenerator generator(source, options);
    std::vector<double> events;  // ticks
    std::vector<std::pair<PathOutputs, std::size_t>> changes;
    std::int64_t time = whole_tick / 2;
    for (BoardItem item; generator.next(item);) {
      if (const auto* outputs = std::get_if<PathOutputs>(&item)) {
        changes.emplace_back(*outputs, events.size());
        continue;
      }
      for (const std::int64_t interval : oracle::intervals_of(std::get<BoardSegment>(item))) {
        time += interval;
        events.push_back(static_cast<double>(time >> 16));
      }
    }
    ASSERT_EQ(changes.size(), motion.outputs.size());
    for (std::size_t i = 0; i < changes.size(); ++i) {
      EXPECT_EQ(changes[i].first, motion.outputs[i]);
      const double due = motion.times[i] * options.clock.tick_rate.value();
      const std::size_t next = changes[i].second;
      EXPECT_LE(next > 0 ? events[next - 1] : 0, due + 1) << "trial " << trial << " change " << i;
      // At the end, the laser is off with the last step already.
      if (i + 1 == changes.size()) continue;
      EXPECT_GE(events[next], due - 1) << "trial " << trial << " change " << i;
    }
  }
}

TEST(GeneratedOutputs, leave_each_step_where_and_when_mathematics_puts_it) {
  const StepOptions options = machine();
  test::Random random;
  for (int trial = 0; trial < 20; ++trial) {
    oracle::expect_exact(random_motion(random).items, options);
    if (testing::Test::HasFailure()) return;
  }
}

// M4: from standstill to the programmed speed, over it, and back. The oracle is the energy per millimetre.
TEST(GeneratedOutputs, power_that_follows_the_speed_gives_each_millimetre_the_same_energy) {
  PlannedMove move;
  move.segment.curve = Curve::line(xyz(0, 0), xyz(30, 0));
  move.segment.speed = MmPerSecond(80);
  move.segment.outputs = {.power = 0.5, .follows_speed = true};
  move.to = Mm(30);
  move.add({.duration = Seconds(0.25), .start = Mm(0), .acceleration = MmPerSecond2(400)});
  move.add({.duration = Seconds(0.05), .start = Mm(12.5), .velocity = MmPerSecond(100)});
  move.add(
      {.duration = Seconds(0.25), .start = Mm(17.5), .velocity = MmPerSecond(100), .acceleration = MmPerSecond2(-400)});
  test::ListSource<MotionItem> source({move});
  StepGenerator generator(source, machine());
  const double tick = 1 / 16e6;
  std::vector<double> energy(30, 0.0);
  double power = 0;
  std::int64_t place = whole_step / 2;
  int changes = 0;
  for (BoardItem item; generator.next(item);) {
    if (const auto* outputs = std::get_if<PathOutputs>(&item)) {
      EXPECT_FALSE(outputs->follows_speed);
      power = outputs->power;
      ++changes;
      continue;
    }
    const auto& segment = std::get<BoardSegment>(item);
    const int sign = (segment.directions & 1U) != 0 ? -1 : 1;
    for (const std::int64_t interval : oracle::intervals_of(segment)) {
      const double mm = static_cast<double>(place) / whole_step / 160;
      if (mm < 30) energy[static_cast<std::size_t>(mm)] += power * static_cast<double>(interval) / whole_tick * tick;
      const bool flipped = (segment.flips & 1U) != 0;
      place += sign * (flipped ? whole_step - segment.increments[0] : segment.increments[0]);
    }
  }
  EXPECT_NEAR(static_cast<double>(place) / whole_step / 160, 30, 0.01);
  EXPECT_EQ(power, 0) << "at the end";
  EXPECT_GT(changes, 40);
  EXPECT_LT(changes, 110);
  // 0.5 at 80 mm/s. The first and the last millimetre are slow: half a 256th of full power counts for more there.
  for (std::size_t mm = 0; mm < energy.size(); ++mm) {
    const double wanted = 0.5 / 80;
    const auto from_end = static_cast<double>(std::min(mm, 29 - mm));
    const double count = 1.0 / 512 / std::sqrt(2 * 400 * (from_end + 0.5));
    EXPECT_NEAR(energy[mm], wanted, 0.01 * wanted + count) << mm;
  }
}

TEST(GeneratedOutputs, an_action_switches_the_laser_off_before_its_dwell) {
  PlannedMove move;
  move.segment.curve = Curve::line(xyz(0, 0), xyz(1, 0));
  move.to = Mm(1);
  move.add({.duration = Seconds(0.1), .start = Mm(0), .velocity = MmPerSecond(10)});
  move.segment.outputs = {.power = 1, .switches = 4};
  Action dwell;
  dwell.dwell = Seconds(1);
  test::ListSource<MotionItem> source({move, dwell});
  StepGenerator generator(source, machine());
  std::vector<BoardItem> items;
  for (BoardItem item; generator.next(item);) items.push_back(item);
  ASSERT_GE(items.size(), 4U);
  EXPECT_EQ(std::get<PathOutputs>(items[0]), (PathOutputs{.power = 1, .switches = 4}));
  std::int64_t before = 0;
  std::size_t off = 1;
  for (; std::holds_alternative<BoardSegment>(items[off]); ++off) {
    for (const std::int64_t interval : oracle::intervals_of(std::get<BoardSegment>(items[off]))) before += interval;
  }
  EXPECT_EQ(std::get<PathOutputs>(items[off]), (PathOutputs{.power = 0, .switches = 4})) << "digital outputs stay";
  EXPECT_LE(static_cast<double>(before) / whole_tick, 0.1 * 16e6 + 1);
  EXPECT_TRUE(std::holds_alternative<Action>(items.back()));
}

}  // namespace
}  // namespace passo
