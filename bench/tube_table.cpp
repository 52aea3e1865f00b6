// What the tube gives, as two tables: circles in rounded chords against the same circle as an arc, with limits of
// acceleration and with limits of jerk too; and corners against the fastest motion inside the tube (tube_optimum.hpp),
// with the same two machines. Beside that optimum: the bound of `passo check --motion` for any path in the tube.
//
// Prints figures and decides nothing.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "kit/list_source.hpp"
#include "tube_optimum.hpp"

#include "passo/path/path_smoother.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/trajectory/planner.hpp"

namespace {

using namespace passo;

constexpr double tolerance = 0.01;  // mm
constexpr double feed = 1000;       // mm/s: more than any axis can do
constexpr double jerk = 25'000;     // mm/s³, where it is limited: full acceleration takes 20 ms

Segment segment_of(const Curve& curve) {
  return {.curve = curve, .speed = MmPerSecond(feed), .tolerance = Mm(tolerance), .merge = Mm(tolerance / 20)};
}

// The machine of examples/machines/bench.toml. `limit` of the jerk, in mm/s³; 0: none.
MotionLimits bench_limits(double limit) {
  MotionLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.velocity[axis] = MmPerSecond(axis == Axis::z ? 50 : 100);
    limits.acceleration[axis] = MmPerSecond2(500);
    limits.jerk[axis] = MmPerSecond3(limit);
  }
  return limits;
}

double time_of(const std::vector<PathItem>& path, double limit) {
  test::ListSource<PathItem> source(path);
  PathSmoother smoother(source, limit > 0 ? Smoothness::slow_bending : Smoothness::least_bending);
  Planner planner(smoother, bench_limits(limit));
  double time = 0;
  for (MotionItem item; planner.next(item);) {
    if (const auto* const move = std::get_if<PlannedMove>(&item)) time += move->duration().value();
  }
  return time;
}

Point place(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

constexpr double radius = 25;

std::vector<PathItem> arc_path() {
  const Point start = place(radius, 0);
  return {segment_of(Curve::arc(start, start, Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi))};
}

// `grid`: what coordinates are rounded to, in mm.
std::vector<PathItem> chord_path(double chord, double grid) {
  std::vector<PathItem> path;
  const double count = std::round(2 * std::numbers::pi * radius / chord);
  Point from = place(radius, 0);
  for (double i = 1; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const Point to =
        place(std::round(radius * std::cos(angle) / grid) * grid, std::round(radius * std::sin(angle) / grid) * grid);
    const Curve line = Curve::line(from, to);
    if (line.has_length()) path.emplace_back(segment_of(line));
    from = to;
  }
  return path;
}

void print_circles() {
  const double arc = time_of(arc_path(), 0);
  const double slow_arc = time_of(arc_path(), jerk);
  std::printf("circle of R 25 as G3: %.4f s, with jerk %.4f s\n", arc, slow_arc);
  std::printf("%-10s %-10s %12s %12s\n", "grid, um", "chord, mm", "acceleration", "jerk");
  for (const double grid : {0.1, 1.0, 2.54, 5.0}) {
    for (const double chord : {0.02, 0.05, 0.2}) {
      const std::vector<PathItem> path = chord_path(chord, grid / 1000);
      std::printf("%-10g %-10g %12.4f %12.4f\n", grid, chord, time_of(path, 0) / arc, time_of(path, jerk) / slow_arc);
    }
  }
}

std::vector<PathItem> path_of(const std::vector<bench::Place>& corners) {
  std::vector<PathItem> path;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    path.emplace_back(
        segment_of(Curve::line(place(corners[i].x, corners[i].y), place(corners[i + 1].x, corners[i + 1].y))));
  }
  return path;
}

double bound_of(const std::vector<PathItem>& path) {
  ProofOptions options;
  const MotionLimits limits = bench_limits(0);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    options.axes.push_back(
        {.axis = axis, .velocity = limits.velocity[axis], .acceleration = limits.acceleration[axis]});
  }
  MotionProver prover(options);
  for (const PathItem& item : path) prover.watch(item);
  return prover.finish().tube_bound.value();
}

// A row of the table of corners, for the table of bounds.
struct Corners {
  const char* name;
  std::vector<bench::Place> places;
  double optimum;
};
std::vector<Corners> corners_done;

void print_bounds() {
  std::printf("\n%-26s %12s %12s %12s\n", "", "bound, s", "optimum / it", "ours / it");
  for (const Corners& one : corners_done) {
    const double bound = bound_of(path_of(one.places));
    std::printf("%-26s %12.5f %12.4f %12.4f\n", one.name, bound, one.optimum / bound,
                time_of(path_of(one.places), 0) / bound);
  }
}

void print_corners() {
  std::printf("\n%-22s %10s %10s %8s   %10s %10s %8s\n", "", "optimum, s", "ours, s", "ratio", "with jerk", "ours, s",
              "ratio");
  const auto print = [](const char* name, const std::vector<bench::Place>& corners, int samples) {
    std::printf("%-22s", name);
    for (const double limit : {0.0, jerk}) {
      const double best = bench::find_optimum(corners, {.tolerance = tolerance, .jerk = limit}, samples);
      if (limit == 0) corners_done.push_back({name, corners, best});
      const double ours = time_of(path_of(corners), limit);
      std::printf(" %10.5f %10.5f %8.4f  ", best, ours, ours / best);
    }
    std::printf("\n");
    std::fflush(stdout);
  };
  const auto stairs = [](double leg) {
    std::vector<bench::Place> corners;
    for (int i = 0; i <= 8; ++i) corners.push_back({leg * ((i + 1) / 2), leg * (i / 2)});
    return corners;
  };
  print("90 degrees, legs 1 mm", stairs(1), 150);
  print("90 degrees, legs 5 mm", stairs(5), 250);
  print("90 degrees, legs 20 mm", stairs(20), 400);
  const auto zigzag = [](double x, double y) {
    std::vector<bench::Place> corners;
    for (int i = 0; i <= 8; ++i) corners.push_back({x * i, i % 2 == 0 ? 0 : y});
    return corners;
  };
  print("zigzag 5 x 2 mm", zigzag(5, 2), 300);
  print("zigzag 5 x 0.5 mm", zigzag(5, 0.5), 300);
  print("zigzag 0.5 x 0.1 mm", zigzag(0.5, 0.1), 150);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1 || argv[1][0] == 'c') print_circles();
  if (argc == 1 || argv[1][0] != 'c') print_corners();
  print_bounds();
  return 0;
}
