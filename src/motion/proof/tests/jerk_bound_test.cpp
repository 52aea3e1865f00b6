// The least time under limits of jerk, against closed forms.
#include <cmath>
#include <numbers>
#include <vector>

#include "kit/stage_test.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo {
namespace {

using test::xyz;

constexpr double strongest = 500;
constexpr double sharpest = 25'000;
constexpr double rise = strongest / sharpest;

ProvenAxis axis_with(Axis axis, double own_acceleration, double own_jerk) {
  return {.axis = axis,
          .step = Mm(0.0025),
          .velocity = MmPerSecond(100),
          .acceleration = MmPerSecond2(own_acceleration),
          .jerk = MmPerSecond3(own_jerk)};
}
const std::vector<ProvenAxis> both_limited = {axis_with(Axis::x, strongest, sharpest),
                                              axis_with(Axis::y, strongest, sharpest)};

double bound_along(const std::vector<Curve>& curves, const std::vector<ProvenAxis>& axes = both_limited,
                   double feed = 1000) {
  ProofOptions options;
  options.axes = axes;
  options.tick_rate = Hertz(1e6);
  MotionProver prover(options);
  for (const Curve& curve : curves) {
    PlannedMove move{.segment = {.curve = curve, .speed = MmPerSecond(feed)}, .phases = {}};
    move.to = move.segment.curve.length();
    move.add({.duration = Seconds(move.to.value()), .velocity = MmPerSecond(1)});
    prover.watch(PathItem(move.segment));
    prover.watch(MotionItem(move));
  }
  return prover.finish().time_bound.value();
}
double bound_through(const std::vector<Point>& places, const std::vector<ProvenAxis>& axes = both_limited,
                     double feed = 1000) {
  std::vector<Curve> lines;
  for (std::size_t i = 1; i < places.size(); ++i) lines.push_back(Curve::line(places[i - 1], places[i]));
  return bound_along(lines, axes, feed);
}

// Where the highest speed is not reached.
double from_rest_to_rest(double length) {
  if (length <= 2 * strongest * rise * rise) return 4 * std::cbrt(length / 2 / sharpest);
  return rise + std::sqrt(rise * rise + 4 * length / strongest);
}

TEST(JerkBound, of_a_line_is_that_of_its_seven_phases) {
  for (const double length : {0.001, 0.1, 0.4, 8.0}) {
    EXPECT_NEAR(bound_through({xyz(0, 0), xyz(length, 0)}), from_rest_to_rest(length), 1e-9) << length;
  }
  // At the feed of 20 mm/s the acceleration reaches its limit only just.
  EXPECT_NEAR(bound_through({xyz(0, 0), xyz(60, 0)}, both_limited, 20), 60.0 / 20 + 20 / strongest + rise, 1e-9);
  EXPECT_NEAR(bound_through({xyz(0, 0), xyz(60, 0)}, both_limited, 5), 60.0 / 5 + 2 * std::sqrt(5 / sharpest), 1e-9);
}

TEST(JerkBound, of_a_line_in_pieces_is_that_of_the_line) {
  std::vector<Point> places;
  for (int i = 0; i <= 100; ++i) places.push_back(xyz(0.03 * i, 0.04 * i));
  // Y makes 4 parts of 5, and its limits count.
  EXPECT_NEAR(bound_through(places), from_rest_to_rest(4), 1e-6);
}

TEST(JerkBound, of_a_line_takes_each_limit_from_the_axis_that_sets_it) {
  const std::vector<ProvenAxis> axes = {axis_with(Axis::x, 1e6, sharpest * 3 / 5),
                                        axis_with(Axis::y, strongest * 4 / 5, 0)};
  EXPECT_NEAR(bound_through({xyz(0, 0), xyz(3, 4)}, axes), from_rest_to_rest(5), 1e-9);
}

TEST(JerkBound, knows_that_a_corner_is_a_stop_without_acceleration) {
  EXPECT_NEAR(bound_through({xyz(0, 0), xyz(0.1, 0), xyz(0.1, 0.2)}), from_rest_to_rest(0.1) + from_rest_to_rest(0.2),
              1e-9);
}

// The acceleration stays what it is while the axis turns back. Neither way is so long that it reaches its limit
// elsewhere. From rest to the speed P takes 2 √(P/j) on P √(P/j), and from there to the turn √(2P/j) on two thirds of
// P √(2P/j).
TEST(JerkBound, lets_the_acceleration_go_on_where_the_path_turns_back) {
  const double length = 0.1;
  const double top = std::cbrt(sharpest * std::pow(length / (1 + std::sqrt(8.0) / 3), 2));
  const double one_way = (2 + std::sqrt(2.0)) * std::sqrt(top / sharpest);
  EXPECT_NEAR(bound_through({xyz(0, 0), xyz(length, 0), xyz(0, 0)}), 2 * one_way, 1e-9);
  EXPECT_LT(one_way, from_rest_to_rest(length));
}

// Where an arc begins, the acceleration across the path would jump from 0 to v²/r. A thousandth of the limit is
// rounding, so v² is at most r/1000 times the limit. Each line then takes nearly as long as from rest to rest.
TEST(JerkBound, knows_that_an_arc_is_not_entered_at_speed) {
  const double radius = 5;
  const double speed = std::sqrt(radius * strongest / 1000);
  const Curve before = Curve::line(xyz(0, 0), xyz(8, 0));
  const Curve arc = Curve::arc(xyz(8, 0), xyz(8 + radius, radius), Axis::x, Axis::y, 8, radius, std::numbers::pi / 2);
  const Curve after = Curve::line(xyz(8 + radius, radius), xyz(8 + radius, radius + 8));
  const double lines = 2 * (from_rest_to_rest(8) - 2 * speed / strongest - rise);
  EXPECT_GT(bound_along({before, arc, after}), lines + radius * std::numbers::pi / 2 / 50);
  EXPECT_LT(bound_along({before, arc, after}), 2 * from_rest_to_rest(8) + 1);
}

// At a stop in a bend no axis has an acceleration, so the start-stop velocities are of little use.
TEST(JerkBound, of_an_arc_allows_hardly_any_speed_at_its_stops) {
  const double side = std::sqrt(2);
  const Curve arc = Curve::arc(xyz(side, -side), xyz(side, side), Axis::x, Axis::y, 0, 0, std::numbers::pi / 2);
  std::vector<ProvenAxis> starting = both_limited;
  for (ProvenAxis& axis : starting) axis.start_stop = MmPerSecond(20);
  EXPECT_GT(bound_along({arc}, starting), 0.95 * bound_along({arc}));
  EXPECT_LE(bound_along({arc}, starting), bound_along({arc}));
}

// A path whose bend grows evenly along the way, k s, and falls again: |d(k s v³)/ds| is at most the jerk along x and y.
TEST(JerkBound, knows_how_fast_a_bend_may_grow) {
  const double growth = 400;
  const double length = 0.03;
  const double rise_of_y = growth * length * length * length / 6;
  const double slope = growth * length * length / 2;
  const Curve in = Curve::cubic(xyz(0, 0), xyz(1, 0), xyz(length, rise_of_y), xyz(1, slope), Mm(length));
  const Point middle = xyz(length, rise_of_y);
  const Point end = xyz(2 * length, rise_of_y + 2 * slope * length - rise_of_y);
  const Curve out = Curve::cubic(middle, xyz(1, slope), end, xyz(1, 2 * slope), Mm(length));
  const Curve before = Curve::line(xyz(-20, 0), xyz(0, 0));
  const Point away = xyz(1, 2 * slope) * (20 / std::hypot(1, 2 * slope));
  const Curve after = Curve::line(end, xyz(end[Axis::x] + away[Axis::x], end[Axis::y] + away[Axis::y]));
  const double fastest = std::cbrt(sharpest * (1 + 2 * slope) / growth);
  // From rest to 100 mm/s, and down to that speed.
  const double lines = 2 * (200 - fastest) / strongest;
  EXPECT_GT(bound_along({before, in, out, after}), lines + 0.9 * 2 * length / fastest);
}

}  // namespace
}  // namespace passo
