// The bound for any path in the tube: it agrees with closed forms, and is nowhere above a motion that exists.
#include <cmath>
#include <numbers>
#include <vector>

#include "kit/stage_test.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo {
namespace {

using test::xyz;

constexpr double pi = std::numbers::pi;
constexpr double acceleration = 500;
constexpr double tolerance = 0.01;

ProofOptions bench_options() {
  ProofOptions result;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    result.axes.push_back({.axis = axis, .velocity = MmPerSecond(100), .acceleration = MmPerSecond2(acceleration)});
  }
  return result;
}

Segment segment_of(const Curve& curve, double speed = 1000) {
  return {.curve = curve, .speed = MmPerSecond(speed), .tolerance = Mm(tolerance)};
}
std::vector<Segment> lines(const std::vector<Point>& corners, double speed = 1000) {
  std::vector<Segment> path;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    path.push_back(segment_of(Curve::line(corners[i], corners[i + 1]), speed));
  }
  return path;
}
std::vector<Segment> stairs(double leg, int count) {
  std::vector<Point> corners;
  for (int i = 0; i <= count; ++i) corners.push_back(xyz(leg * ((i + 1) / 2), leg * (i / 2)));
  return lines(corners);
}

double bound_of(const std::vector<Segment>& path, const ProofOptions& limits = bench_options()) {
  MotionProver prover(limits);
  for (const Segment& segment : path) prover.watch(PathItem(segment));
  return prover.finish().tube_bound.value();
}

TEST(TubeBound, of_a_line_is_that_of_the_line) {
  EXPECT_NEAR(bound_of(lines({xyz(0, 0), xyz(8, 0)})), 2 * std::sqrt(8 / acceleration), 1e-12);
  EXPECT_NEAR(bound_of(lines({xyz(0, 0), xyz(60, 0)})), 60.0 / 100 + 100.0 / 500, 1e-12);
  EXPECT_NEAR(bound_of(lines({xyz(0, 0), xyz(3, 3)})), 2 * std::sqrt(3 / acceleration), 1e-12);
  EXPECT_NEAR(bound_of(lines({xyz(0, 0), xyz(60, 0)}, 20)), 60.0 / 20 + 20.0 / 500, 1e-12);
  EXPECT_EQ(bound_of({}), 0);
}

TEST(TubeBound, of_a_line_in_pieces_is_nearly_that_of_the_line) {
  const auto pieces = [](int count, double speed) {
    std::vector<Point> places;
    for (int i = 0; i <= count; ++i) places.push_back(xyz(i * 0.1, 0));
    return bound_of(lines(places, speed));
  };
  EXPECT_LE(pieces(600, 1000), 0.8 + 1e-12);
  EXPECT_GE(pieces(600, 1000), 0.8 * 0.999);
  EXPECT_GE(pieces(600, 20), 60.0 / 20 - 1e-9);
  // Longer than a window of stations: up to the tolerance at each window's end nothing is lost.
  EXPECT_LE(pieces(6000, 1000), 6.2 + 1e-12);
  EXPECT_GE(pieces(6000, 1000), 6.2 * 0.999);
}

// Where a leg ends, its axis is at most sqrt(2 a d) fast, with the way d = e/√2 + e from there to the outer side of the
// tube; and the next leg's axis has come as far.
TEST(TubeBound, of_right_angles_is_that_of_the_swing_to_the_outer_side) {
  for (const double leg : {1.0, 5.0, 15.0}) {
    const double inner = bound_of(stairs(leg, 8)) - bound_of(stairs(leg, 7));
    const double corner = 2 * std::sqrt(2 * (1 + std::sqrt(0.5)) * tolerance / acceleration);
    const double closed = 2 * std::sqrt((leg + 2 * tolerance) / acceleration) - corner;
    EXPECT_LE(inner, closed * (1 + 1e-9)) << leg;
    EXPECT_GE(inner, closed * 0.999) << leg;
  }
}

// Eight parabolas of 45 degrees each, on the tube's inner side.
TEST(TubeBound, of_a_turn_of_a_circle_is_nearly_that_on_the_circle) {
  const auto circle = [](double radius, double turns) {
    return segment_of(Curve::arc(xyz(radius, 0), xyz(radius, 0), Axis::x, Axis::y, 0, 0, turns * 2 * pi));
  };
  const double turn = bound_of({circle(10, 4)}) - bound_of({circle(10, 3)});
  EXPECT_LE(turn, 8 * std::sqrt(2 * 10 * (1 - std::sqrt(0.5)) / acceleration));
  EXPECT_GE(turn, 8 * std::sqrt(2 * (10 - tolerance) * (1 - std::sqrt(0.5)) / acceleration) * 0.99);
  // A circle as small as the tolerance need not be driven.
  EXPECT_LT(bound_of({circle(0.004, 100)}), 1e-3);
}

TEST(TubeBound, of_a_slow_feed_counts_the_shortest_way_in_the_tube) {
  const double around = 10 * (2 * pi * 10 / 5);
  const double bound =
      bound_of({segment_of(Curve::arc(xyz(10, 0), xyz(10, 0), Axis::x, Axis::y, 0, 0, 10 * 2 * pi), 5)});
  EXPECT_LE(bound, around * (10 - tolerance) / 10 + 0.1);
  EXPECT_GE(bound, around * (10 - 2 * tolerance) / 10);
}

TEST(TubeBound, rests_where_the_program_rests) {
  std::vector<Segment> path = lines({xyz(0, 0), xyz(2, 0), xyz(2, 2)});
  const double rounded = bound_of(path);
  const double one = 2 * std::sqrt(2 / acceleration);
  EXPECT_LT(rounded, 2 * one - 0.01);
  path[0].mode = PathMode::exact_stop;
  EXPECT_NEAR(bound_of(path), 2 * one, 1e-12);

  MotionProver prover(bench_options());
  prover.watch(PathItem(lines({xyz(0, 0), xyz(2, 0)})[0]));
  prover.watch(PathItem(Action{.kind = Action::Kind::dwell, .dwell = Seconds(3)}));
  prover.watch(PathItem(lines({xyz(2, 0), xyz(0, 0)})[0]));
  EXPECT_NEAR(prover.finish().tube_bound.value(), 3 + 2 * one, 1e-12);
}

// A wider tube, or no limit at all: never slower.
TEST(TubeBound, falls_as_the_tube_grows) {
  double last = INFINITY;
  for (const double own : {0.0, 0.002, 0.01, 0.05, 0.3}) {
    std::vector<Segment> path = stairs(3, 6);
    for (Segment& segment : path) segment.tolerance = Mm(own);
    const double bound = bound_of(path);
    EXPECT_LE(bound, last) << own;
    last = bound;
  }
  ProofOptions free = bench_options();
  for (ProvenAxis& axis : free.axes) axis.acceleration = MmPerSecond2(0);
  const double way = 6 * (3 - 2 * tolerance) / 100;
  EXPECT_GE(bound_of(stairs(3, 6), free), way);
  EXPECT_LE(bound_of(stairs(3, 6), free), way + 6 * 2 * tolerance / 100);
}

// A limit that falls with the speed, never above 500: it takes longer.
TEST(TubeBound, knows_limits_that_fall_with_the_speed) {
  ProofOptions falling = bench_options();
  for (ProvenAxis& axis : falling.axes) {
    axis.acceleration_at = [](MmPerSecond v) { return MmPerSecond2(acceleration * (1 - v.value() / 110)); };
  }
  EXPECT_GT(bound_of(stairs(5, 4), falling), bound_of(stairs(5, 4)) * 1.05);
}

}  // namespace
}  // namespace passo
