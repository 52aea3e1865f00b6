// What the tube gives, as three tables, with limits of acceleration and with limits of jerk too: circles in rounded
// chords against the same circle as an arc; corners between lines and arcs; and corners against the fastest motion
// inside the tube (tube_optimum.hpp). Beside that optimum: the bound of `passo check --motion` for any path in the
// tube.
//
// `tube_table circles`, `tube_table arcs` or `tube_table corners` prints that table alone.
//
// Prints figures and decides nothing.
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string_view>
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
  for (const double grid : {0.1, 1.0, 2.54, 5.0, 8.0, 12.0}) {
    for (const double chord : {0.01, 0.02, 0.05, 0.2}) {
      const std::vector<PathItem> path = chord_path(chord, grid / 1000);
      std::printf("%-10g %-10g %12.4f %12.4f\n", grid, chord, time_of(path, 0) / arc, time_of(path, jerk) / slow_arc);
    }
  }
}

// A path that is drawn from the origin on.
class Drawing {
 public:
  double x() const { return x_; }
  double y() const { return y_; }
  const std::vector<PathItem>& path() const { return path_; }

  void line_to(double x, double y) { add(Curve::line(place(x_, y_), place(x, y)), x, y); }
  // About that center, to the left for a positive sweep.
  void arc_to(double x, double y, const Point& center, double sweep) {
    add(Curve::arc(place(x_, y_), place(x, y), Axis::x, Axis::y, center[Axis::x], center[Axis::y], sweep), x, y);
  }
  // The shorter arc of that radius, to the right.
  void arc_to(double x, double y, double arc_radius) {
    const double chord = std::hypot(x - x_, y - y_);
    const double beside = std::sqrt(arc_radius * arc_radius - chord * chord / 4) / chord;
    const Point center = place((x_ + x) / 2 + (y - y_) * beside, (y_ + y) / 2 - (x - x_) * beside);
    arc_to(x, y, center, -2 * std::asin(chord / 2 / arc_radius));
  }

 private:
  void add(const Curve& curve, double x, double y) {
    path_.emplace_back(segment_of(curve));
    x_ = x;
    y_ = y;
  }
  std::vector<PathItem> path_;
  double x_ = 0;
  double y_ = 0;
};

// Six steps of 5 mm. `arc_radius` of each second leg; 0: a line.
void draw_stairs(Drawing& to, double arc_radius) {
  for (int i = 1; i <= 6; ++i) {
    to.line_to(5 * i, to.y());
    arc_radius > 0 ? to.arc_to(5 * i, 5 * i, arc_radius) : to.line_to(5 * i, 5 * i);
  }
}

// Lines of 5 mm in one direction, and between them arcs over that chord.
void draw_bumps(Drawing& to, double arc_radius, double chord) {
  for (int i = 0; i < 8; ++i) {
    to.line_to(to.x() + 5, 0);
    to.arc_to(to.x() + chord, 0, arc_radius);
  }
}

void draw_half_circles(Drawing& to) {
  for (int i = 0; i < 6; ++i) {
    to.line_to(10, 0);
    to.arc_to(0, 0, place(5, 0), std::numbers::pi);
  }
}

void draw_gear(Drawing& to) {
  constexpr int teeth = 8;
  const auto go = [&](double r, int quarter, bool is_arc) {
    const double turn = std::numbers::pi / teeth;
    const double x = r * std::cos(turn * quarter);
    const double y = r * std::sin(turn * quarter);
    is_arc ? to.arc_to(x, y, place(0, 0), turn) : to.line_to(x, y);
  };
  go(20, 0, false);
  for (int i = 0; i < teeth; ++i) {
    go(20, 2 * i + 1, true);
    go(22, 2 * i + 1, false);
    go(22, 2 * i + 2, true);
    go(20, 2 * i + 2, false);
  }
}

void print_beside_arcs() {
  std::printf("\n%-44s %12s %12s\n", "corners beside arcs", "acceleration", "jerk");
  const auto print = [](const char* name, const std::function<void(Drawing&)>& draw) {
    Drawing drawing;
    draw(drawing);
    std::printf("%-44s %12.3f %12.3f\n", name, time_of(drawing.path(), 0), time_of(drawing.path(), jerk));
  };
  print("stairs, each second leg an arc of 50 mm", [](Drawing& to) { draw_stairs(to, 50); });
  print("all legs lines", [](Drawing& to) { draw_stairs(to, 0); });
  print("arcs of 4 mm", [](Drawing& to) { draw_stairs(to, 4); });
  print("half circles of 5 mm, closed by lines", draw_half_circles);
  print("a gear: arcs of 20 and 22 mm, radial lines", draw_gear);
  print("lines and arcs of 1.5 mm that meet at 42", [](Drawing& to) { draw_bumps(to, 1.5, 2); });
  print("lines and arcs of 10 mm that meet at 12", [](Drawing& to) { draw_bumps(to, 10, 4); });
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
  std::printf("\n%-24s %10s %10s %8s   %10s %10s %8s\n", "", "optimum, s", "ours, s", "ratio", "with jerk", "ours, s",
              "ratio");
  const auto print = [](const char* name, const std::vector<bench::Place>& corners, int samples) {
    std::printf("%-24s", name);
    for (const double limit : {0.0, jerk}) {
      const double best = bench::find_optimum(corners, {.tolerance = tolerance, .jerk = limit}, samples);
      if (limit == 0) corners_done.push_back({name, corners, best});
      const double ours = time_of(path_of(corners), limit);
      std::printf(" %10.5f %10.5f %8.4f  ", best, ours, ours / best);
    }
    std::printf("\n");
    std::fflush(stdout);
  };
  // Legs that turn to and fro by an angle.
  const auto stairs = [](double leg, double turn = std::numbers::pi / 2) {
    std::vector<bench::Place> corners{{0, 0}};
    for (int i = 0; i < 8; ++i) {
      const double heading = i % 2 == 0 ? 0 : turn;
      corners.push_back({corners.back().x + leg * std::cos(heading), corners.back().y + leg * std::sin(heading)});
    }
    return corners;
  };
  const auto polygon = [](double leg, double heading) {
    std::vector<bench::Place> corners{{0, 0}};
    for (int i = 0; i < 8; ++i, heading += std::numbers::pi / 4) {
      corners.push_back({corners.back().x + leg * std::cos(heading), corners.back().y + leg * std::sin(heading)});
    }
    return corners;
  };
  print("90 degrees, legs 1 mm", stairs(1), 600);
  print("90 degrees, legs 5 mm", stairs(5), 250);
  print("90 degrees, legs 20 mm", stairs(20), 400);
  print("45 degrees, legs 3 mm", stairs(3, std::numbers::pi / 4), 300);
  print("octagon, sides 3 mm", polygon(3, 0), 300);
  print("the same, turned by 20", polygon(3, std::numbers::pi / 9), 300);
  print("90 degrees, legs 0.1 mm", stairs(0.1), 300);
  print("90 degrees, legs 0.05 mm", stairs(0.05), 300);
  print("octagon, sides 0.1 mm", polygon(0.1, 0), 300);
  const auto zigzag = [](double x, double y) {
    std::vector<bench::Place> corners;
    for (int i = 0; i <= 8; ++i) corners.push_back({x * i, i % 2 == 0 ? 0 : y});
    return corners;
  };
  print("zigzag 5 x 2 mm", zigzag(5, 2), 300);
  print("zigzag 5 x 0.5 mm", zigzag(5, 0.5), 300);
  print("zigzag 0.5 x 0.1 mm", zigzag(0.5, 0.1), 600);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view only = argc > 1 ? argv[1] : "";
  if (only.empty() || only == "circles") print_circles();
  if (only.empty() || only == "arcs") print_beside_arcs();
  if (only.empty() || only == "corners") {
    print_corners();
    print_bounds();
  }
  return 0;
}
