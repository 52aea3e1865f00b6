// Splines in the path: cubics of their length, within the tolerance, in machine coordinates.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kit/seed.hpp"
#include "path_test.hpp"

#include "passo/geometry/euclid.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {
namespace {

// The curves are worked out here by de Casteljau's rule and by the basis functions, independently of the geometry
// module.
struct Place {
  double x = 0;
  double y = 0;
};

Place cubic_at(const std::array<operation::ControlPoint, 4>& control, double u) {
  std::array<operation::ControlPoint, 4> row = control;
  for (std::size_t count = 3; count > 0; --count) {
    for (std::size_t i = 0; i < count; ++i) {
      row[i].x += u * (row[i + 1].x - row[i].x);
      row[i].y += u * (row[i + 1].y - row[i].y);
    }
  }
  return {row[0].x, row[0].y};
}

// Goes along the curve in small steps, and then closer around the nearest step.
double distance_to(const Place& place, const Segment& segment) {
  const auto distance_at = [&](double s) {
    const Point point = segment.curve.at(Mm(s));
    return std::hypot(point[Axis::x] - place.x, point[Axis::y] - place.y);
  };
  constexpr int steps = 32;
  const double step = segment.curve.length().value() / steps;
  double nearest = 0;
  for (int i = 0; i <= steps; ++i) {
    if (distance_at(i * step) < distance_at(nearest)) nearest = i * step;
  }
  double low = std::max(nearest - step, 0.0);
  double high = std::min(nearest + step, steps * step);
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    if (distance_at(low + third) < distance_at(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return distance_at((low + high) / 2);
}

double farthest(const std::vector<Segment>& pieces, const std::vector<Place>& places) {
  double worst = 0;
  for (const Place& place : places) {
    double nearest = 1e9;
    for (const Segment& piece : pieces) nearest = std::min(nearest, distance_to(place, piece));
    worst = std::max(worst, nearest);
  }
  return worst;
}

constexpr std::array<operation::ControlPoint, 4> wave = {{{0, 0}, {10, 20}, {20, -20}, {30, 5}}};

std::vector<Place> places_on_wave() {
  std::vector<Place> places;
  for (int i = 0; i <= 1000; ++i) places.push_back(cubic_at(wave, i / 1000.0));
  return places;
}

TEST_F(PathTest, a_spline_is_walked_within_a_tenth_of_the_tolerance) {
  for (const double tolerance : {0.0, 0.01, 0.1, 1.0}) {
    operations_.clear();
    add(operation::SetPathMode{tolerance > 0 ? PathMode::continuous : PathMode::exact_stop, Mm(tolerance)});
    feed(10);
    add(operation::NurbsFeed{wave, 4});
    const std::vector<Segment> pieces = segments();
    const double allowed = tolerance > 0 ? tolerance / 10 : 0.001;
    EXPECT_LE(farthest(pieces, places_on_wave()), allowed);
    EXPECT_LE(pieces.size(), 30U) << "chords would be " << std::sqrt(50 / allowed);
    EXPECT_EQ(pieces.back().curve.end()[Axis::x], 30);
    EXPECT_EQ(pieces.back().curve.end()[Axis::y], 5);
    EXPECT_EQ(pieces.back().mode, tolerance > 0 ? PathMode::continuous : PathMode::exact_stop);
    EXPECT_EQ(pieces.front().mode, PathMode::continuous);
    EXPECT_LE(pieces.front().tolerance.value(), tolerance > 0 ? 0.9 * tolerance : 0.001) << "the rest is used up";
    for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_EQ(pieces[i - 1].curve.end(), pieces[i].curve.start());
  }
}

TEST_F(PathTest, a_spline_goes_on_without_a_jump_at_the_speed_that_the_feed_counts) {
  feed(10);
  add(operation::NurbsFeed{wave, 4});
  const std::vector<Segment> pieces = segments();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curve& curve = pieces[i].curve;
    for (int at = 0; at <= 20; ++at) EXPECT_NEAR(length_of(curve.tangent(curve.length() * (at / 20.0))), 1, 0.0051);
    if (i == 0) continue;
    const Curve& before = pieces[i - 1].curve;
    EXPECT_LE(length_of(curve.tangent(Mm(0)) - before.tangent(before.length())), 1e-9) << i;
    EXPECT_LE(length_of(curve.second_derivative(Mm(0)) - before.second_derivative(before.length())), 1e-9) << i;
  }
}

TEST_F(PathTest, random_splines_are_walked_within_a_tenth_of_the_tolerance) {
  std::mt19937_64 random(test::seed());
  const auto between = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int n = 0; n < 20; ++n) {
    SCOPED_TRACE(n);
    const int degree = 2 + n % 3;
    Nurbs::Definition definition{.degree = degree};
    std::vector<operation::ControlPoint> control(static_cast<std::size_t>(degree + 1 + n / 3));
    for (operation::ControlPoint& point : control) {
      point.x = between(0, 60);
      point.y = between(0, 60);
      point.weight = n % 2 == 0 ? 1 : std::exp(between(-2, 2));
    }
    operations_.clear();
    add(operation::SetPathMode{PathMode::continuous, Mm(0.01)});
    feed(10);
    go(control[0].x, control[0].y);
    for (const operation::ControlPoint& point : control) {
      definition.control.push_back({point.x, point.y, 0});
      definition.weights.push_back(point.weight);
    }
    const Nurbs curve = *Nurbs::create(definition);
    std::vector<Place> places;
    for (int i = 0; i <= 200; ++i) {
      const Vector3 place = curve.at(curve.range().low + (curve.range().high - curve.range().low) * i / 200);
      places.push_back({place.x, place.y});
    }
    add(operation::NurbsFeed{control, degree + 1});
    const std::vector<Segment> pieces = segments();
    EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
    EXPECT_LE(farthest({pieces.begin() + 1, pieces.end()}, places), 0.001);
  }
}

// What the pieces take of the tolerance is not there for rounding their joints. A NURBS of order 3 has a jump of
// curvature at each knot.
TEST_F(PathTest, a_spline_with_its_joints_rounded_is_within_the_tolerance) {
  const std::vector<operation::ControlPoint> control = {{0, 0}, {3, 0}, {4, 3}, {1, 5}, {0, 2}, {6, 1}, {9, 4}};
  Nurbs::Definition definition{.degree = 2};
  for (const operation::ControlPoint& point : control) {
    definition.control.push_back({point.x, point.y, 0});
    definition.weights.push_back(1);
  }
  const Nurbs curve = *Nurbs::create(definition);
  std::vector<Place> places;
  for (int i = 0; i <= 500; ++i) {
    const Vector3 place = curve.at(curve.range().low + (curve.range().high - curve.range().low) * i / 500);
    places.push_back({place.x, place.y});
  }
  for (const double tolerance : {0.0, 0.002, 0.01}) {
    operations_.clear();
    add(operation::SetPathMode{tolerance > 0 ? PathMode::continuous : PathMode::exact_path, Mm(tolerance)});
    feed(10);
    add(operation::NurbsFeed{control, 3});
    EXPECT_LE(farthest(smoothed_segments(), places), tolerance > 0 ? tolerance : 0.001);
  }
}

// Where the parameter stands still the direction turns at once: a cusp, and there and back on
// a line.
TEST_F(PathTest, a_spline_with_a_cusp_is_walked_to_its_tip) {
  constexpr std::array<operation::ControlPoint, 4> cusp = {{{0, 0}, {10, 10}, {0, 10}, {10, 0}}};
  constexpr std::array<operation::ControlPoint, 3> there_and_back = {{{10, 0}, {30, 0}, {10, 0}}};
  add(operation::SetPathMode{PathMode::continuous, Mm(0.01)});
  feed(10);
  add(operation::NurbsFeed{cusp, 4});
  std::vector<Place> places;
  for (int i = 0; i <= 1000; ++i) places.push_back(cubic_at(cusp, i / 1000.0));
  const std::vector<Segment> pieces = segments();
  EXPECT_LE(farthest(pieces, places), 0.001);
  EXPECT_LE(pieces.size(), 200U);
  operations_.clear();
  add(operation::NurbsFeed{there_and_back, 3});
  double reached = 0;
  for (const Segment& piece : segments()) reached = std::max(reached, piece.curve.end()[Axis::x]);
  EXPECT_NEAR(reached, 20, 0.001);
}

TEST_F(PathTest, the_pieces_of_a_spline_are_as_long_as_it) {
  feed(10);
  add(operation::NurbsFeed{wave, 4});
  double walked = 0;
  for (const Segment& piece : segments()) walked += piece.curve.length().value();
  double length = 0;
  const std::vector<Place> places = places_on_wave();
  for (std::size_t i = 1; i < places.size(); ++i) {
    length += std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y);
  }
  EXPECT_NEAR(walked, length, length * 1e-5);
}

// A quarter circle is a NURBS of order 3 with the weight sqrt(1/2) in its middle.
TEST_F(PathTest, weights_make_a_circle_and_the_frame_turns_it) {
  constexpr std::array<operation::ControlPoint, 3> quarter = {{{5, 0, 1}, {5, 5, 0.70710678118654752}, {0, 5, 1}}};
  options_.start = xyz(100, 55, 7);
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(100, 50, 7)});
  add(operation::SetRotation{90});
  feed(10);
  add(operation::NurbsFeed{quarter, 3});
  const std::vector<Segment> pieces = segments();
  ASSERT_GT(pieces.size(), 1U);
  for (const Segment& piece : pieces) {
    const Point& end = piece.curve.end();
    EXPECT_NEAR(std::hypot(end[Axis::x] - 100, end[Axis::y] - 50), 5, 1e-9);
    EXPECT_EQ(end[Axis::z], 7);
  }
  EXPECT_NEAR(pieces.back().curve.end()[Axis::x], 95, 1e-9);
  EXPECT_NEAR(pieces.back().curve.end()[Axis::y], 50, 1e-9);
}

TEST_F(PathTest, a_nurbs_of_many_points_passes_its_knots) {
  // Order 3, unweighted, clamped: at an inner knot the curve is midway between two control points.
  constexpr std::array<operation::ControlPoint, 5> control = {{{0, 0}, {10, 10}, {20, 0}, {30, 10}, {40, 0}}};
  feed(10);
  add(operation::NurbsFeed{control, 3});
  EXPECT_LE(farthest(segments(), {{15, 5}, {25, 5}}), 1e-9);
}

TEST_F(PathTest, a_spline_may_leave_the_travel_only_as_a_whole_line_may) {
  constexpr std::array<operation::ControlPoint, 3> over = {{{0, 0}, {0, 400}, {10, 0}}};  // up to 200: inside
  constexpr std::array<operation::ControlPoint, 3> far = {{{10, 0}, {10, 700}, {20, 0}}};
  feed(10);
  add(operation::NurbsFeed{over, 3});
  EXPECT_FALSE(segments().empty());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
  add(operation::NurbsFeed{far, 3});
  EXPECT_FALSE(segments().empty());
  EXPECT_EQ(diagnostics_.errors(), 1U) << render(diagnostics_, false);
}

TEST_F(PathTest, a_spline_that_goes_nowhere_is_dropped_and_one_without_end_refused) {
  constexpr std::array<operation::ControlPoint, 4> nowhere = {};
  constexpr std::array<operation::ControlPoint, 3> weights = {{{0, 0, 1}, {5, 5, 1e6}, {9, 0, 1}}};
  feed(10);
  add(operation::NurbsFeed{nowhere, 4});
  EXPECT_TRUE(segments().empty());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
  add(operation::NurbsFeed{weights, 3});
  EXPECT_TRUE(segments().empty());
  EXPECT_EQ(codes(), std::vector<std::string>{"path.bad-spline"});
}

}  // namespace
}  // namespace passo
