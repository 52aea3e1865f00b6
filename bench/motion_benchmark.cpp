// Segments a second through PathBuilder and Planner. Programs are generated on the fly and nothing is stored, so the
// numbers hold for a job of any length.
#include <cmath>
#include <limits>
#include <numbers>

#include <benchmark/benchmark.h>

#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {
namespace {

// A spiral of chords of `size` mm each.
Point place(std::size_t n, double size) {
  const double angle = std::sqrt(2 * size * static_cast<double>(n));
  Point point;
  point[Axis::x] = angle * std::cos(angle);
  point[Axis::y] = angle * std::sin(angle);
  point[Axis::z] = 1e-6 * static_cast<double>(n);
  return point;
}

class Moves final : public Source<Operation> {
 public:
  Moves(std::size_t count, double size) : count_(count), size_(size) {}
  [[nodiscard]] bool next(Operation& operation) override {
    if (at_ == 0) {
      operation.what = operation::SetFeedRate{operation::FeedPerSecond{.linear = MmPerSecond(100)}};
    } else {
      operation.what = operation::StraightFeed{place(at_, size_)};
    }
    return at_++ <= count_;
  }

 private:
  std::size_t count_;
  double size_;
  std::size_t at_ = 0;
};

class Arcs final : public Source<Operation> {
 public:
  explicit Arcs(std::size_t count) : count_(count) {}
  [[nodiscard]] bool next(Operation& operation) override {
    if (at_ == 0) {
      operation.what = operation::SetFeedRate{operation::FeedPerSecond{.linear = MmPerSecond(100)}};
    } else {  // half circles of 1 mm, out and back
      Point end;
      end[Axis::x] = at_ % 2 == 1 ? 2 : 0;
      operation.what =
          operation::ArcFeed{.plane = Plane::xy, .end = end, .first_center = Mm(1), .second_center = Mm(0)};
    }
    return at_++ <= count_;
  }

 private:
  std::size_t count_;
  std::size_t at_ = 0;
};

class Segments final : public Source<PathItem> {
 public:
  Segments(std::size_t count, double size) : count_(count), size_(size) {}
  [[nodiscard]] bool next(PathItem& item) override {
    const Point end = place(++at_, size_);
    item = Segment{.curve = Curve::line(position_, end), .speed = MmPerSecond(100), .tolerance = Mm(0.01)};
    position_ = end;
    return at_ <= count_;
  }

 private:
  std::size_t count_;
  double size_;
  std::size_t at_ = 0;
  Point position_ = place(0, size_);
};

PathOptions path_options() {
  PathOptions options;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    options.axes.add(axis);
    options.travel[axis] = {.low = -1e6, .high = 1e6};
  }
  return options;
}

MotionLimits motion_limits() {
  MotionLimits limits;
  for (const Axis axis : all_axes) {
    limits.velocity[axis] = MmPerSecond(200);
    limits.acceleration[axis] = MmPerSecond2(500);
  }
  return limits;
}

constexpr std::size_t count = 200'000;

void build(benchmark::State& state, Source<Operation>& operations) {
  const PathOptions options = path_options();
  Diagnostics diagnostics;
  PathBuilder builder(operations, options, diagnostics);
  for (PathItem item; builder.next(item);) benchmark::DoNotOptimize(item);
  state.SetItemsProcessed(state.items_processed() + static_cast<std::int64_t>(count));
}

void path_lines(benchmark::State& state) {
  for (auto _ : state) {
    Moves moves(count, 0.01);
    build(state, moves);
  }
}
BENCHMARK(path_lines)->Unit(benchmark::kMillisecond);

void path_arcs(benchmark::State& state) {
  for (auto _ : state) {
    Arcs arcs(count);
    build(state, arcs);
  }
}
BENCHMARK(path_arcs)->Unit(benchmark::kMillisecond);

// The argument is the chord in micrometres. Shorter chords need a longer queue for braking.
void planner_chords(benchmark::State& state) {
  for (auto _ : state) {
    Segments segments(count, static_cast<double>(state.range(0)) / 1000);
    Planner planner(segments, motion_limits());
    for (MotionItem item; planner.next(item);) benchmark::DoNotOptimize(item);
    state.SetItemsProcessed(state.items_processed() + static_cast<std::int64_t>(count));
  }
}
BENCHMARK(planner_chords)->Arg(1)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

// The rows of a relief, 200 mm long and half a millimetre apart, in moves of a tenth of a millimetre. The hills are
// rounded to the micrometre, as CAM programs write them.
class Raster final : public Source<PathItem> {
 public:
  explicit Raster(std::size_t moves) : moves_(moves) {}
  [[nodiscard]] bool next(PathItem& item) override {
    if (given_ == moves_) return false;
    const Point end = place(++given_);
    item = Segment{
        .curve = Curve::line(position_, end), .speed = MmPerSecond(50), .tolerance = Mm(0.01), .merge = Mm(0.0005)};
    position_ = end;
    return true;
  }

 private:
  static Point place(std::size_t move) {
    constexpr std::size_t a_row = 2000;
    const std::size_t row = move / a_row;
    const double x = 0.1 * static_cast<double>(row % 2 == 0 ? move % a_row : a_row - move % a_row);
    const double y = 0.5 * static_cast<double>(row);
    Point point;
    point[Axis::x] = x;
    point[Axis::y] = y;
    point[Axis::z] = std::round((std::sin(x / 7) * std::cos(y / 11) + 0.3 * std::sin(x / 2.1 + y / 3)) * 1e3) / 1e3;
    return point;
  }
  std::size_t moves_;
  std::size_t given_ = 0;
  Point position_ = place(0);
};

// The cost of a program of such moves from path to phases: smoothed, and planned with limits of acceleration and maybe
// of jerk. The argument is the limit of jerk in mm/s³; 0: none.
void smoothed_raster(benchmark::State& state) {
  MotionLimits limits = motion_limits();
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.jerk[axis] = MmPerSecond3(static_cast<double>(state.range(0)));
  }
  for (auto _ : state) {
    Raster raster(count / 10);
    PathSmoother smoother(raster, state.range(0) > 0 ? Smoothness::slow_bending : Smoothness::least_bending);
    Planner planner(smoother, limits);
    for (MotionItem item; planner.next(item);) benchmark::DoNotOptimize(item);
    state.SetItemsProcessed(state.items_processed() + static_cast<std::int64_t>(count / 10));
  }
}
BENCHMARK(smoothed_raster)->Arg(0)->Arg(25'000)->Unit(benchmark::kMillisecond);

// The cost of the source alone, to be subtracted from the result above.
void source_chords(benchmark::State& state) {
  for (auto _ : state) {
    Segments segments(count, 0.01);
    for (PathItem item; segments.next(item);) benchmark::DoNotOptimize(item);
    state.SetItemsProcessed(state.items_processed() + static_cast<std::int64_t>(count));
  }
}
BENCHMARK(source_chords)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
