// Steps a second through the step generator alone, including its replay of the board.
#include <cmath>
#include <numbers>
#include <vector>

#include "kit/smooth_motion.hpp"
#include <benchmark/benchmark.h>

#include "passo/stepgen/step_generator.hpp"

namespace passo {
namespace {

class Moves final : public Source<MotionItem> {
 public:
  explicit Moves(const std::vector<MotionItem>& moves) : moves_(moves) {}
  bool next(MotionItem& item) override {
    if (next_ == moves_.size()) return false;
    item = moves_[next_++];
    return true;
  }

 private:
  const std::vector<MotionItem>& moves_;
  std::size_t next_ = 0;
};

StepOptions machine(double steps_per_mm) {
  StepOptions options;
  for (unsigned m = 0; m < 3; ++m) options.kinematics.add({.steps = {all_axes[m], steps_per_mm}});
  return options;
}

PlannedMove steady(const Curve& curve, double speed) {
  PlannedMove move;
  move.segment.curve = curve;
  move.to = move.segment.curve.length();
  move.add({.duration = curve.length() / MmPerSecond(speed), .velocity = MmPerSecond(speed)});
  return move;
}

Point at(double x, double y, double z) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

// The steps of all motors, from the increments as in board_segment.hpp's table.
double steps_of(const BoardSegment& segment) {
  double steps = 0;
  for (unsigned m = 0; m < 3; ++m) {
    const bool flip = (segment.flips >> m & 1U) != 0;
    const bool down = (segment.directions >> m & 1U) != 0;
    const double fraction = segment.increments[m] / 65536.0;
    steps += (flip ? 1 - (down ? fraction : 0) : fraction) * segment.events;
  }
  return steps;
}

void generate(benchmark::State& state, const std::vector<MotionItem>& moves, double steps_per_mm = 640) {
  double steps = 0;
  double segments = 0;
  double events = 0;
  for (auto _ : state) {
    Moves source(moves);
    StepGenerator generator(source, machine(steps_per_mm));
    BoardItem item;
    while (generator.next(item)) {
      if (const auto* segment = std::get_if<BoardSegment>(&item)) {
        ++segments;
        events += segment->events;
        steps += steps_of(*segment);
      }
    }
  }
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  state.counters["event"] = benchmark::Counter(events, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["events/segment"] = events / segments;
}

void long_diagonal(benchmark::State& state) {
  generate(state, {steady(Curve::line(at(0, 0, 0), at(300, 200, 50)), 100)});
}
BENCHMARK(long_diagonal)->Unit(benchmark::kMillisecond);

void circle_of_20_mm(benchmark::State& state) {
  generate(state, {steady(Curve::arc(at(0, 0, 0), at(0, 0, 0), Axis::x, Axis::y, 20, 0, 2 * std::numbers::pi), 80)});
}
BENCHMARK(circle_of_20_mm)->Unit(benchmark::kMillisecond);

void relief_of_tenths(benchmark::State& state) {
  std::vector<MotionItem> moves;
  Point place = at(0, 0, 0);
  for (int i = 1; i < 5000; ++i) {
    const Point next = at(i * 0.1, 0, std::sin(i * 0.05));
    moves.emplace_back(steady(Curve::line(place, next), 50));
    place = next;
  }
  generate(state, moves);
}
BENCHMARK(relief_of_tenths)->Unit(benchmark::kMillisecond);

void ramps_of_two_millimetres(benchmark::State& state) {
  std::vector<MotionItem> moves;
  for (int i = 0; i < 500; ++i) {
    PlannedMove move;
    move.segment.curve = Curve::line(at(i % 2 * 2.0, 0, 0), at((i + 1) % 2 * 2.0, 0.7 * (i % 2), 0));
    move.to = move.segment.curve.length();
    const double length = move.segment.curve.length().value();
    const double t = std::sqrt(length / 800);
    move.add({.duration = Seconds(t), .acceleration = MmPerSecond2(800)});
    move.add({.duration = Seconds(t),
              .start = Mm(length / 2),
              .velocity = MmPerSecond(800 * t),
              .acceleration = MmPerSecond2(-800)});
    moves.emplace_back(move);
  }
  generate(state, moves);
}
BENCHMARK(ramps_of_two_millimetres)->Unit(benchmark::kMillisecond);

std::vector<Curve> relief(int pieces, double piece) {
  std::vector<Point> points;
  for (int i = 0; i <= pieces; ++i) {
    const double x = i * piece;
    points.push_back(at(x, 0, 0.6 * std::sin(x) + 0.1 * std::sin(3.1 * x)));
  }
  return test::spline_through(points);
}

std::vector<MotionItem> steady(const std::vector<Curve>& curves, double speed) {
  std::vector<MotionItem> moves;
  for (const Curve& curve : curves) moves.emplace_back(steady(curve, speed));
  return moves;
}

void cubics_of_ten_millimetres(benchmark::State& state) {
  generate(state, steady(relief(20, 10), 100));
}
BENCHMARK(cubics_of_ten_millimetres)->Unit(benchmark::kMillisecond);

// Pieces of 0.1 to 0.2 mm.
void dense_relief_of_cubics(benchmark::State& state) {
  generate(state, steady(relief(4000, 0.15), 160), 400);
}
BENCHMARK(dense_relief_of_cubics)->Unit(benchmark::kMillisecond);

// Motion that speeds up and slows down all the time, with jerk: a planner's phases about every 20 mm.
void dense_relief_with_jerk(benchmark::State& state) {
  const std::vector<Curve> curves = relief(4000, 0.15);
  double length = 0;
  for (const Curve& curve : curves) length += curve.length().value();
  test::PhaseChain chain;
  for (int i = 0; i < 30; ++i) chain.change_speed(i % 2 == 0 ? 2 : 1, 1, 0.4);
  chain.change_speed(0, 1, 0.4);
  generate(state, test::moves_along(curves, chain.over(length, 200), 1000), 400);
}
BENCHMARK(dense_relief_with_jerk)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
