#include "passo/grbl_planner/grbl_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// 100 mm/s, 500 mm/s², 400 steps/mm.
GrblLimits limits_of_router(std::size_t blocks = 15) {
  GrblLimits limits{.blocks = blocks};
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.steps_per_mm[axis] = 400;
    limits.velocity[axis] = MmPerSecond(100);
    limits.acceleration[axis] = MmPerSecond2(500);
  }
  return limits;
}

Point at(double x, double y = 0, double z = 0) {
  Point place;
  place[Axis::x] = x;
  place[Axis::y] = y;
  place[Axis::z] = z;
  return place;
}

// The motion of each line.
class PerLine {
 public:
  struct Motion {
    double entry = -1;
    double top = 0;
    double exit = 0;
    double time = 0;
    double length = 0;
  };
  void add(const GrblPhase& phase) {
    Motion& motion = motions_[phase.block.source];
    if (motion.entry < 0) motion.entry = phase.speed.value();
    EXPECT_NEAR(motion.length, phase.from.value(), 1e-9);
    motion.exit = phase.end_speed().value();
    motion.top = std::max({motion.top, phase.speed.value(), motion.exit});
    motion.time += phase.duration.value();
    motion.length += phase.duration.value() * (phase.speed.value() + motion.exit) / 2;
    EXPECT_NEAR(phase.begun.value(), now_, 1e-9);
    now_ = (phase.begun + phase.duration).value();
  }
  const Motion& operator[](std::uint32_t line) const { return motions_.at(line); }

 private:
  std::map<std::uint32_t, Motion> motions_;
  double now_ = 0;
};

TEST(GrblPlanner, moves_in_trapezoids_and_triangles) {
  GrblPlanner planner(limits_of_router(), {});
  planner.add_line(at(100), MmPerSecond(50), 1, Seconds(0));
  EXPECT_NEAR(planner.wait_for_rest(Seconds(0), Seconds(0)).value(), 100.0 / 50 + 50.0 / 500, 1e-9);
  GrblPlanner rapid(limits_of_router(), {});
  rapid.add_line(at(5), MmPerSecond(infinite), 1, Seconds(0));
  EXPECT_NEAR(rapid.wait_for_rest(Seconds(0), Seconds(0)).value(), 2 * std::sqrt(5.0 / 500), 1e-9);
  EXPECT_NEAR(rapid.wait_for_rest(Seconds(1.5), Seconds(0)).value(), 2 * std::sqrt(5.0 / 500) + 1.5, 1e-9);
}

TEST(GrblPlanner, limits_junctions_by_their_deviation) {
  PerLine lines;
  GrblPlanner planner(limits_of_router(), {});
  planner.hear([&](const GrblPhase& phase) { lines.add(phase); });
  planner.add_line(at(50), MmPerSecond(80), 1, Seconds(0));
  planner.add_line(at(50, 50), MmPerSecond(80), 2, Seconds(0));
  planner.add_line(at(50, 0), MmPerSecond(80), 3, Seconds(0));
  const Seconds end = planner.wait_for_rest(Seconds(0), Seconds(0));
  // A right angle: the difference of the directions lies between two axes, so it has 1.414 times the acceleration.
  const double sine = std::sqrt(0.5);
  EXPECT_NEAR(lines[1].exit, std::sqrt(500 * std::numbers::sqrt2 * 0.01 * sine / (1 - sine)), 1e-9);
  EXPECT_NEAR(lines[2].entry, lines[1].exit, 1e-9);
  EXPECT_NEAR(lines[2].exit, 0, 1e-6) << "a reversal is a stop";
  double time = 0;
  for (const std::uint32_t line : {1U, 2U, 3U}) {
    EXPECT_NEAR(lines[line].top, 80, 1e-9);
    EXPECT_NEAR(lines[line].length, 50, 1e-9);
    time += lines[line].time;
  }
  EXPECT_NEAR(time, end.value(), 1e-9);
}

// The board must be able to stop at the end of what it holds.
TEST(GrblPlanner, is_slowed_by_a_short_queue) {
  const auto fastest_of = [](std::size_t queue) {
    GrblPlanner planner(limits_of_router(queue), {});
    double fastest = 0;
    planner.hear([&](const GrblPhase& phase) { fastest = std::max(fastest, phase.end_speed().value()); });
    for (int i = 1; i <= 1000; ++i) planner.add_line(at(0.1 * i), MmPerSecond(90), 1, Seconds(0));
    planner.wait_for_rest(Seconds(0), Seconds(0));
    return fastest;
  };
  EXPECT_NEAR(fastest_of(15), std::sqrt(2 * 500 * 1.5), 2);
  EXPECT_NEAR(fastest_of(100), 90, 1e-9);
}

TEST(GrblPlanner, takes_a_line_when_it_has_room) {
  GrblPlanner planner(limits_of_router(3), {});
  EXPECT_EQ(planner.add_line(at(10), MmPerSecond(10), 1, Seconds(0)), Seconds(0));
  EXPECT_EQ(planner.add_line(at(20), MmPerSecond(10), 2, Seconds(0.2)), Seconds(0.2));
  EXPECT_EQ(planner.add_line(at(30), MmPerSecond(10), 3, Seconds(0.2)), Seconds(0.2));
  EXPECT_NEAR(planner.add_line(at(40), MmPerSecond(10), 4, Seconds(0.2)).value(), 1.01, 1e-9);
}

// Without the next line the board stops, and starts again from rest.
TEST(GrblPlanner, stops_if_lines_are_late) {
  GrblPlanner planner(limits_of_router(), {});
  planner.add_line(at(10), MmPerSecond(50), 1, Seconds(0));
  planner.add_line(at(20), MmPerSecond(50), 2, Seconds(5));
  EXPECT_NEAR(planner.wait_for_rest(Seconds(0), Seconds(5)).value(), 5 + 10.0 / 50 + 50.0 / 500, 1e-9);
  // A line that comes while the board brakes lets it accelerate again.
  GrblPlanner just(limits_of_router(), {});
  just.add_line(at(10), MmPerSecond(50), 1, Seconds(0));
  just.add_line(at(20), MmPerSecond(50), 2, Seconds(0.25));
  const double dip = 25;  // mm/s: 0.05 s after the begin of the brake
  EXPECT_NEAR(just.wait_for_rest(Seconds(0), Seconds(0)).value(),
              20.0 / 50 + 0.1 + 2 * (0.05 - (50 + dip) / 2 * 0.05 / 50), 1e-6);
}

// Along X both motors move as far as the tool; along a diagonal one of them moves twice as far in each axis.
TEST(GrblPlanner, plans_the_motors_of_a_core_xy) {
  GrblLimits limits = limits_of_router();
  limits.core_xy = true;
  const auto time = [&](const Point& end, double feed) {
    PerLine lines;
    GrblPlanner planner(limits, {});
    planner.hear([&](const GrblPhase& phase) { lines.add(phase); });
    planner.add_line(end, MmPerSecond(feed), 1, Seconds(0));
    const double taken = planner.wait_for_rest(Seconds(0), Seconds(0)).value();
    EXPECT_NEAR(lines[1].length, std::hypot(end[Axis::x], end[Axis::y]), 1e-9) << "the tool's way";
    EXPECT_NEAR(lines[1].time, taken, 1e-9);
    return taken;
  };
  EXPECT_NEAR(time(at(100), infinite), 100.0 / 100 + 100.0 / 500, 1e-9);
  EXPECT_NEAR(time(at(100, 100), infinite), 200.0 / 100 + 100.0 / 500, 1e-9);
  const double tool = 50 * std::numbers::sqrt2 / 2;  // mm/s at a feed of 50 mm/s
  const double acceleration = 500;
  EXPECT_NEAR(time(at(0, 100), 50), 100 / tool + tool / acceleration, 1e-9);
  EXPECT_NEAR(time(at(60, 60), 50), 120.0 / 50 + 50.0 / 500, 1e-9);
  // A right angle between the diagonals: one motor stops, the other one starts.
  PerLine lines;
  GrblPlanner planner(limits, {});
  planner.hear([&](const GrblPhase& phase) { lines.add(phase); });
  planner.add_line(at(50, 50), MmPerSecond(80), 1, Seconds(0));
  planner.add_line(at(100, 0), MmPerSecond(80), 2, Seconds(0));
  planner.wait_for_rest(Seconds(0), Seconds(0));
  const double sine = std::sqrt(0.5);
  const double along_motor = std::sqrt(500 * std::numbers::sqrt2 * 0.01 * sine / (1 - sine));
  EXPECT_NEAR(lines[1].exit, along_motor / std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(lines[1].top, 80 / std::numbers::sqrt2, 1e-9);
}

TEST(GrblPlanner, divides_arcs_by_the_tolerance) {
  std::vector<GrblBlock> blocks;
  GrblPlanner planner(limits_of_router(), at(10));
  planner.hear([&](const GrblPhase& phase) {
    if (phase.from == Mm(0)) blocks.push_back(phase.block);
  });
  planner.add_arc({.first_center = -10}, at(10, 0, -2), MmPerSecond(20), 7, Seconds(0));
  planner.wait_for_rest(Seconds(0), Seconds(0));
  const double chords = std::floor(std::numbers::pi * 10 / std::sqrt(0.002 * (20 - 0.002)));
  ASSERT_EQ(blocks.size(), static_cast<std::size_t>(chords));
  for (const GrblBlock& block : blocks) {
    EXPECT_NEAR(std::hypot(block.end[Axis::x], block.end[Axis::y]), 10, 0.003);
    EXPECT_EQ(block.source, 7U);
  }
  const double fall = blocks[blocks.size() / 2].end[Axis::z];
  EXPECT_NEAR(fall, -1, 0.03);
  EXPECT_EQ(blocks.back().end, at(10, 0, -2));
}

}  // namespace
}  // namespace passo
