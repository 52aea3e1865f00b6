// Splines in the path: chords within the tolerance, in machine coordinates.
#include <algorithm>
#include <array>
#include <cmath>

#include "path_test.hpp"

namespace passo {
namespace {

// The curves are worked out here by de Casteljau's rule and by the basis functions, apart from the geometry
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

double distance_to(const Place& place, const Segment& segment) {
  const Point& a = segment.curve.start();
  const Point& b = segment.curve.end();
  const double x = b[Axis::x] - a[Axis::x];
  const double y = b[Axis::y] - a[Axis::y];
  const double along = ((place.x - a[Axis::x]) * x + (place.y - a[Axis::y]) * y) / (x * x + y * y);
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(a[Axis::x] + t * x - place.x, a[Axis::y] + t * y - place.y);
}

double farthest(const std::vector<Segment>& chords, const std::vector<Place>& places) {
  double worst = 0;
  for (const Place& place : places) {
    double nearest = 1e9;
    for (const Segment& chord : chords) nearest = std::min(nearest, distance_to(place, chord));
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
    const std::vector<Segment> chords = segments();
    const double allowed = tolerance > 0 ? tolerance / 10 : 0.001;
    EXPECT_LE(farthest(chords, places_on_wave()), allowed * (1 + 1e-6));
    EXPECT_GE(farthest(chords, places_on_wave()), allowed * 0.5);
    EXPECT_EQ(chords.back().curve.end()[Axis::x], 30);
    EXPECT_EQ(chords.back().curve.end()[Axis::y], 5);
    EXPECT_EQ(chords.back().mode, tolerance > 0 ? PathMode::continuous : PathMode::exact_stop);
    EXPECT_EQ(chords.front().mode, PathMode::continuous);
    for (std::size_t i = 1; i < chords.size(); ++i) EXPECT_EQ(chords[i - 1].curve.end(), chords[i].curve.start());
  }
}

TEST_F(PathTest, the_chords_of_a_spline_are_as_long_as_it) {
  feed(10);
  add(operation::NurbsFeed{wave, 4});
  double walked = 0;
  for (const Segment& chord : segments()) walked += chord.curve.length().value();
  double length = 0;
  const std::vector<Place> places = places_on_wave();
  for (std::size_t i = 1; i < places.size(); ++i) {
    length += std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y);
  }
  EXPECT_NEAR(walked, length, length * 1e-4);
}

// A quarter circle is a NURBS of order 3 with the weight sqrt(1/2) in its middle.
TEST_F(PathTest, weights_make_a_circle_and_the_frame_turns_it) {
  constexpr std::array<operation::ControlPoint, 3> quarter = {{{5, 0, 1}, {5, 5, 0.70710678118654752}, {0, 5, 1}}};
  options_.start = xyz(100, 55, 7);
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(100, 50, 7)});
  add(operation::SetRotation{90});
  feed(10);
  add(operation::NurbsFeed{quarter, 3});
  const std::vector<Segment> chords = segments();
  ASSERT_GT(chords.size(), 10U);
  for (const Segment& chord : chords) {
    const Point& end = chord.curve.end();
    EXPECT_NEAR(std::hypot(end[Axis::x] - 100, end[Axis::y] - 50), 5, 1e-9);
    EXPECT_EQ(end[Axis::z], 7);
  }
  EXPECT_NEAR(chords.back().curve.end()[Axis::x], 95, 1e-9);
  EXPECT_NEAR(chords.back().curve.end()[Axis::y], 50, 1e-9);
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
