// Steps a second through the step generator alone, its replay of the board included.
#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include "passo/stepgen/step_generator.hpp"

namespace passo {
namespace {

class Moves final : public Source<MotionItem> {
 public:
  explicit Moves(const std::vector<PlannedMove>& moves) : moves_(moves) {}
  bool next(MotionItem& item) override {
    if (next_ == moves_.size()) return false;
    item = moves_[next_++];
    return true;
  }

 private:
  const std::vector<PlannedMove>& moves_;
  std::size_t next_ = 0;
};

StepOptions router() {
  StepOptions options;
  options.motor_count = 3;
  for (unsigned m = 0; m < 3; ++m) options.motors[m] = {.axis = all_axes[m], .steps_per_unit = 640};
  return options;
}

PlannedMove steady(const Curve& curve, double speed) {
  PlannedMove move;
  move.segment.curve = curve;
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

void generate(benchmark::State& state, const std::vector<PlannedMove>& moves) {
  std::int64_t steps = 0;
  std::int64_t segments = 0;
  std::int64_t events = 0;
  for (auto _ : state) {
    Moves source(moves);
    StepGenerator generator(source, router());
    BoardItem item;
    while (generator.next(item)) {
      if (const auto* segment = std::get_if<BoardSegment>(&item)) {
        ++segments;
        events += segment->events;
      }
    }
  }
  for (const PlannedMove& move : moves) {
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      steps += std::llround(std::fabs(move.segment.curve.end()[axis] - move.segment.curve.start()[axis]) * 640);
      if (move.segment.curve.shape() == Curve::Shape::arc && axis != Axis::z) steps += 4 * 640 * 20;
    }
  }
  state.counters["steps/s"] = benchmark::Counter(static_cast<double>(steps) * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
  state.counters["events/segment"] = static_cast<double>(events) / static_cast<double>(segments);
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
  std::vector<PlannedMove> moves;
  Point place = at(0, 0, 0);
  for (int i = 1; i < 5000; ++i) {
    const Point next = at(i * 0.1, 0, std::sin(i * 0.05));
    moves.push_back(steady(Curve::line(place, next), 50));
    place = next;
  }
  generate(state, moves);
}
BENCHMARK(relief_of_tenths)->Unit(benchmark::kMillisecond);

void ramps_of_two_millimetres(benchmark::State& state) {
  std::vector<PlannedMove> moves;
  for (int i = 0; i < 500; ++i) {
    PlannedMove move;
    move.segment.curve = Curve::line(at(i % 2 * 2.0, 0, 0), at((i + 1) % 2 * 2.0, 0.7 * (i % 2), 0));
    const double length = move.segment.curve.length().value();
    const double t = std::sqrt(length / 800);
    move.add({.duration = Seconds(t), .acceleration = MmPerSecond2(800)});
    move.add({.duration = Seconds(t),
              .start = Mm(length / 2),
              .velocity = MmPerSecond(800 * t),
              .acceleration = MmPerSecond2(-800)});
    moves.push_back(move);
  }
  generate(state, moves);
}
BENCHMARK(ramps_of_two_millimetres)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
