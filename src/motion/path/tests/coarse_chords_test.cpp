// Chords on grids near the tolerance, short arcs and tiny circles, smoothed.
#include <functional>

#include "../chord_fitter.hpp"
#include "smoothing_kit.hpp"

namespace passo {
namespace {

using test::apart;
using test::PathSmootherTest;
using test::segments_of;
using test::smooth;
using test::xyz;

class CoarseChords : public PathSmootherTest {};

// A curve that is sampled at equal distances of its parameter from 0 to 1, by chords whose ends are rounded.
std::vector<Point> rounded(const std::function<Point(double)>& curve, int chords, double grid) {
  std::vector<Point> places;
  for (int i = 0; i <= chords; ++i) {
    Point place = curve(static_cast<double>(i) / chords);
    for (double& value : place.values) value = std::round(value / grid) * grid;
    if (places.empty() || place != places.back()) places.push_back(place);
  }
  return places;
}

// Ends of chords are off by up to 0.85 of the tolerance. Stairs of the grid turn by right angles, some chords have no
// length, and neighbours are off by the same where the curve runs along an axis.
TEST_F(CoarseChords, chords_whose_rounding_nears_the_tolerance_bend_as_the_curve_does) {
  constexpr double turn = 2 * 3.14159265358979;
  struct Case {
    const char* name;
    std::function<Point(double)> curve;
    double length;
    double grid;
    double most;  // of its curvature
  };
  const std::vector<Case> cases = {
      {"circle", [](double t) { return xyz(19 * std::cos(turn * t), 19 * std::sin(turn * t)); }, 119, 0.008, 1.0 / 19},
      {"circle on a coarse grid", [](double t) { return xyz(19 * std::cos(turn * t), 19 * std::sin(turn * t)); }, 119,
       0.012, 1.0 / 19},
      {"ellipse", [](double t) { return xyz(20 * std::cos(turn * t), 7 * std::sin(turn * t)); }, 90, 0.008, 20.0 / 49},
      {"helix",
       [](double t) {
         Point place = xyz(8 * std::cos(2 * turn * t), 8 * std::sin(2 * turn * t), 5 * t);
         place[Axis::a] = 30 * t;
         return place;
       },
       101, 0.008, 1.0 / 8},
  };
  for (const Case& one : cases) {
    for (const double chord : {0.01, 0.02, 0.05}) {
      for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
        path_.clear();
        const std::vector<Point> places = rounded(one.curve, static_cast<int>(one.length / chord), one.grid);
        for (std::size_t i = 1; i < places.size(); ++i) add(Curve::line(places[i - 1], places[i]));
        expect_good(path_, smoothness);
        double most = 0;
        double s = 0;
        for (const Segment& segment : segments_of(smooth(path_, smoothness))) {
          s += segment.curve.length().value();
          if (s > 5 && s < one.length - 5) most = std::max(most, segment.curve.curvature());
        }
        EXPECT_LT(most, 1.5 * one.most) << one.name << " " << chord;
      }
    }
  }
}

// A turn of a radian in two chords is too much for a cubic through the least number of chords, but not for a shorter
// one. A chord that stayed would have a corner at each end.
TEST_F(CoarseChords, where_a_curve_bends_much_its_chords_are_fitted_too) {
  constexpr double turn = 2 * 3.14159265358979;
  const auto wave = [](double t) {
    const double radius = 20 + 2 * std::cos(30 * turn * t);
    return xyz(radius * std::cos(turn * t), radius * std::sin(turn * t));
  };
  // At equal distances: the wave's length is 283 mm.
  std::vector<Point> places = {wave(0)};
  for (double t = 0; t < 1; t += 1e-5) {
    if (apart(wave(t), places.back()) >= 0.05) places.push_back(wave(t));
  }
  for (Point& place : places) {
    for (double& value : place.values) value = std::round(value * 1000) / 1000;
  }
  for (std::size_t i = 1; i < places.size(); ++i) add(Curve::line(places[i - 1], places[i]));
  expect_good(path_, Smoothness::slow_bending);
  test::ListSource<PathItem> source(path_);
  ChordFitter fitter(source);
  PathItem item;
  double deviation = 0;
  double s = 0;
  while (fitter.next(item, deviation)) {
    const Curve& curve = std::get<Segment>(item).curve;
    s += curve.length().value();
    const bool is_inside = s > 1 && s < 280;
    EXPECT_TRUE(!is_inside || curve.shape() == Curve::Shape::cubic) << s;
  }
}

// An arc that was rounded to 0.001 mm begins in a direction that is wrong by up to 0.02.
TEST_F(CoarseChords, short_arcs_bend_as_the_curve_that_they_make_up) {
  constexpr double radius = 25;
  constexpr double step = 0.05;
  const auto round = [](double value) { return std::round(value * 1000) / 1000; };
  position_ = xyz(radius, 0);
  for (double s = step; s < 100; s += step) {
    const double x = round(radius * std::cos(s / radius));
    const double y = round(radius * std::sin(s / radius));
    const double center_x = position_[Axis::x] + round(-radius * std::cos((s - step) / radius));
    const double center_y = position_[Axis::y] + round(-radius * std::sin((s - step) / radius));
    const double sweep = std::atan2(y - center_y, x - center_x) -
                         std::atan2(position_[Axis::y] - center_y, position_[Axis::x] - center_x);
    arc(x, y, center_x, center_y, std::remainder(sweep, 2 * 3.14159265358979));
  }
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    expect_good(path_, smoothness);
    double most = 0;
    double s = 0;
    for (const Segment& segment : segments_of(smooth(path_, smoothness))) {
      s += segment.curve.length().value();
      if (s > 5 && s < 95) most = std::max(most, segment.curve.curvature());
    }
    EXPECT_LT(most, 1.15 / radius);
  }
}

// A wave in arcs of 0.2 mm that are rounded to 0.001 mm: each begins in the wave's direction, and bends a little more
// or less than the next one.
TEST_F(CoarseChords, a_row_of_short_arcs_is_fitted_like_chords) {
  const auto place = [](double x) { return xyz(std::round(x * 1000) / 1000, std::round(std::sin(x) * 1000) / 1000); };
  constexpr double step = 0.2;
  position_ = place(0);
  for (double x = step; x < 20; x += step) {
    const Point end = place(x);
    const double slope = std::cos(x - step);
    const Point way = end - position_;
    const double beside = way[Axis::y] - slope * way[Axis::x];
    const double square = way[Axis::x] * way[Axis::x] + way[Axis::y] * way[Axis::y];
    const double to_center = square / (2 * beside);  // times the normal (-slope, 1)
    const double center_x = position_[Axis::x] - slope * to_center;
    const double center_y = position_[Axis::y] + to_center;
    const double sweep = std::atan2(end[Axis::y] - center_y, end[Axis::x] - center_x) -
                         std::atan2(position_[Axis::y] - center_y, position_[Axis::x] - center_x);
    arc(end[Axis::x], end[Axis::y], center_x, center_y, std::remainder(sweep, 2 * 3.14159265358979));
  }
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    expect_good(path_, smoothness);
    double s = 0;
    double most = 0;
    for (const Segment& segment : segments_of(smooth(path_, smoothness))) {
      s += segment.curve.length().value();
      if (s < 1 || s > 23) continue;
      EXPECT_EQ(segment.curve.shape(), Curve::Shape::cubic) << s;
      most = std::max(most, segment.curve.curvature());
    }
    EXPECT_LT(most, 1.1);  // that of the wave is at most 1
  }
}

// Pieces of one circle need no fit.
TEST_F(CoarseChords, short_arcs_of_a_circle_stay_arcs) {
  constexpr double quarter = 3.14159265358979 / 2;
  position_ = xyz(0.5, 0);
  for (int turn = 0; turn < 3; ++turn) {
    arc(0, 0.5, 0, 0, quarter);
    arc(-0.5, 0, 0, 0, quarter);
    arc(0, -0.5, 0, 0, quarter);
    arc(0.5, 0, 0, 0, quarter);
  }
  for (const Segment& segment : smoothed()) EXPECT_EQ(segment.curve.shape(), Curve::Shape::arc);
}

// As CAM programs write where they drill with G2.
TEST_F(CoarseChords, circles_of_a_fraction_of_the_tolerance_are_passed_as_a_line) {
  constexpr double turn = 2 * 3.14159265358979;
  for (const double radius : {0.0003, 0.001, 0.0015}) {
    path_.clear();
    position_ = xyz(4 + radius, 0, 1);
    for (int i = 1; i <= 8; ++i) {
      add(Curve::arc(position_, xyz(4 + radius, 0, 1 - 0.5 * i), Axis::x, Axis::y, 4, 0, -turn));
    }
    expect_good(path_);
    const std::vector<Segment> segments = smoothed();
    ASSERT_EQ(segments.size(), 1U) << radius;
    EXPECT_EQ(segments[0].curve.shape(), Curve::Shape::line);
  }
  // One that could be seen stays what it is.
  path_.clear();
  position_ = xyz(4.02, 0, 1);
  add(Curve::arc(position_, xyz(4.02, 0, 0.5), Axis::x, Axis::y, 4, 0, -turn));
  EXPECT_EQ(smoothed()[0].curve.shape(), Curve::Shape::arc);
}

// A corner of 60 degrees is no rounding, however coarse that is.
TEST_F(CoarseChords, a_corner_between_coarsely_rounded_chords_stays_a_corner) {
  constexpr double grid = 0.008;
  const auto corner = [](double t) {
    return t < 0.5 ? xyz(10 * t, 0) : xyz(5 + 5 * (t - 0.5), 8.6602540378 * (t - 0.5));
  };
  const std::vector<Point> places = rounded(corner, 500, grid);
  for (std::size_t i = 1; i < places.size(); ++i) add(Curve::line(places[i - 1], places[i]));
  expect_good(path_);
  double nearest = 1;
  for (const Segment& segment : smoothed()) {
    for (int i = 0; i <= 100; ++i) {
      nearest = std::min(nearest, apart(segment.curve.at(segment.curve.length() * (i / 100.0)), xyz(5, 0)));
    }
  }
  EXPECT_GT(nearest, 0.5 * tolerance_);
  EXPECT_EQ(stops(smoothed()), 1U);
}

}  // namespace
}  // namespace passo
