// The least time under limits of jerk, against closed forms.
#include <cmath>
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

double bound_through(const std::vector<Point>& places, const std::vector<ProvenAxis>& axes = both_limited,
                     double feed = 1000) {
  ProofOptions options;
  options.axes = axes;
  options.tick_rate = Hertz(1e6);
  MotionProver prover(options);
  for (std::size_t i = 1; i < places.size(); ++i) {
    PlannedMove move{.segment = {.curve = Curve::line(places[i - 1], places[i]), .speed = MmPerSecond(feed)},
                     .phases = {}};
    move.to = move.segment.curve.length();
    move.add({.duration = Seconds(move.to.value()), .velocity = MmPerSecond(1)});
    prover.watch(PathItem(move.segment));
    prover.watch(MotionItem(move));
  }
  return prover.finish().time_bound.value();
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

}  // namespace
}  // namespace passo
