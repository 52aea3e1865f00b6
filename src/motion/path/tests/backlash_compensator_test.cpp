#include "passo/path/backlash_compensator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "kit/list_source.hpp"
#include "kit/path_text.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

Point at(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

Segment line(const Point& from, const Point& to) {
  return {.curve = Curve::line(from, to), .speed = MmPerSecond(10)};
}

Segment circle() {
  return {.curve = Curve::arc(at(5, 0), at(5, 0), Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi),
          .speed = MmPerSecond(10)};
}

BacklashOptions xy_backlash(const Point& start) {
  BacklashOptions options{.start = start, .backlash = {}, .least = {}, .downs = {}};
  for (const Axis axis : {Axis::x, Axis::y}) {
    options.backlash[axis] = 0.15;
    options.least[axis] = 0.001;
  }
  return options;
}

std::vector<Segment> segments_of(std::vector<PathItem> path, const BacklashOptions& options) {
  test::ListSource<PathItem> source(std::move(path));
  BacklashCompensator taker(source, options);
  std::vector<Segment> all;
  for (PathItem item; taker.next(item);) {
    if (const auto* segment = std::get_if<Segment>(&item)) all.push_back(*segment);
  }
  return all;
}

// One letter for each segment: p: a piece of the path, x, y: an axis takes up its backlash; b: both do. A capital
// letter: for motion up.
std::string shape_of(const std::vector<Segment>& segments) {
  std::string shape;
  for (const Segment& one : segments) {
    const bool x = one.curve.start()[Axis::x] != one.curve.end()[Axis::x];
    const bool y = one.curve.start()[Axis::y] != one.curve.end()[Axis::y];
    if (!one.takes_up_backlash) {
      shape += 'p';
    } else if (x && y) {
      shape += 'b';
    } else if (x) {
      shape += one.downs.has(Axis::x) ? 'x' : 'X';
    } else {
      shape += one.downs.has(Axis::y) ? 'y' : 'Y';
    }
  }
  return shape;
}

TEST(BacklashCompensator, without_backlash_all_passes_unchanged) {
  const auto all = segments_of({line(at(0, 0), at(5, 0)), line(at(5, 0), at(0, 0)), circle()}, {});
  EXPECT_EQ(shape_of(all), "ppp");
  EXPECT_EQ(all[0].mode, PathMode::continuous);
}

TEST(BacklashCompensator, a_circle_rests_at_each_quadrant_and_nowhere_else) {
  const auto all = segments_of({circle()}, xy_backlash(at(5, 0)));
  EXPECT_EQ(shape_of(all), "xpypXpYp");
  EXPECT_NEAR(all[1].curve.end()[Axis::y], 5, 1e-9);
  EXPECT_EQ(all[1].mode, PathMode::exact_stop);
  EXPECT_EQ(all[2].curve.end(), all[1].curve.end()) << "the tool stands";
  EXPECT_NEAR(all[2].curve.start()[Axis::y], 5.15, 1e-9);
  EXPECT_EQ(all[3].curve.start(), all[1].curve.end());
  EXPECT_TRUE(all[3].downs.has(Axis::x) && all[3].downs.has(Axis::y));
  EXPECT_EQ(all.back().curve.end(), at(5, 0));
  EXPECT_TRUE(all.back().downs.empty());
}

TEST(BacklashCompensator, axes_that_turn_back_together_take_up_together_and_the_path_ends_with_all_up) {
  const auto all = segments_of({line(at(0, 0), at(3, 3)), line(at(3, 3), at(1, 1))}, xy_backlash({}));
  EXPECT_EQ(shape_of(all), "pbpb");
  EXPECT_TRUE(all[1].downs.has(Axis::x) && all[1].downs.has(Axis::y));
  EXPECT_TRUE(all[3].downs.empty());
  EXPECT_EQ(all[3].curve.end(), at(1, 1));
}

TEST(BacklashCompensator, an_axis_that_goes_back_by_a_hair_has_not_turned_back) {
  const auto all = segments_of(
      {line(at(0, 0), at(3, 0)), line(at(3, 0), at(2.9995, 1)), line(at(2.9995, 1), at(2.9985, 2))}, xy_backlash({}));
  EXPECT_EQ(shape_of(all), "ppxpX") << "but two hairs are too much";
}

TEST(BacklashCompensator, the_number_of_items_does_not_depend_on_where_the_backlash_was_if_items_are_counted) {
  for (const bool down : {false, true}) {
    BacklashOptions options = xy_backlash({});
    options.counts_items = true;
    if (down) options.downs.add(Axis::x);
    test::ListSource<PathItem> source({line(at(0, 0), at(-3, 0))});
    BacklashCompensator taker(source, options);
    int items = 0;
    for (PathItem item; taker.next(item);) ++items;
    EXPECT_EQ(items, 4) << "the start, down, the line, up";
  }
}

TEST(BacklashCompensator, after_a_probe_move_it_asks_where_the_machine_rests) {
  test::ListSource<PathItem> source(
      {line(at(0, 0), at(3, 0)), line(at(3, 0), at(-3, 0)), Action{.kind = Action::Kind::probe_end}});
  BacklashCompensator taker(source, xy_backlash({}));
  taker.ask_after_probe([] {
    BacklashAtRest rest{.downs = {}, .place = at(2, 0)};
    rest.downs.add(Axis::x);
    return rest;
  });
  PathItem item;
  while (taker.next(item) && std::holds_alternative<Segment>(item)) {
  }
  ASSERT_TRUE(taker.next(item));
  EXPECT_EQ(std::get<Segment>(item).curve.end(), at(2, 0)) << "the move had ended at a contact";
  EXPECT_FALSE(taker.next(item));
}

TEST(BacklashCompensator, the_backlash_is_taken_up_before_the_index_is_awaited) {
  test::ListSource<PathItem> source(
      {line(at(0, 0), at(3, 0)), Action{.kind = Action::Kind::await_index}, line(at(3, 0), at(-3, 0))});
  BacklashCompensator taker(source, xy_backlash({}));
  std::string order;
  for (PathItem item; taker.next(item);) {
    const auto* segment = std::get_if<Segment>(&item);
    order += segment == nullptr ? 'i' : segment->takes_up_backlash ? 'x' : 'p';
  }
  EXPECT_EQ(order, "pxipx");
}

BacklashOptions in_motion(const Point& start, Smoothness smoothness = Smoothness::least_bending) {
  BacklashOptions options = xy_backlash(start);
  options.in_motion.add(Axis::x);
  options.in_motion.add(Axis::y);
  options.smoothing_share = 0.7;
  options.smoothness = smoothness;
  return options;
}

Segment with_tolerance(Segment segment, double tolerance) {
  segment.tolerance = Mm(tolerance);
  return segment;
}

// A slide behind a screw with backlash, moved by a path of segments.
class Slides {
 public:
  explicit Slides(const BacklashOptions& options) : options_(options) {}

  void follow(const Segment& segment) {
    constexpr int looks = 50;
    const double length = segment.curve.length().value();
    for (int i = 0; i <= looks; ++i) {
      const Mm s(length * i / looks);
      const Point motors = motors_at(segment, segment.curve.at(s));
      if (!begun_) places_ = motors;
      if (i == 0 && begun_) gap = std::max(gap, distance(motors, motors_));
      begun_ = true;
      motors_ = motors;
      for (const Axis axis : {Axis::x, Axis::y}) {
        places_[axis] = std::clamp(places_[axis], motors[axis], motors[axis] + options_.backlash[axis]);
      }
      double& most = segment.lead ? off_in_motion : off_elsewhere;
      most = std::max(most, distance(places_, segment.tool_at(s)));
    }
  }

  double gap = 0;  // of the motors, between segments
  double off_in_motion = 0;
  double off_elsewhere = 0;

 private:
  static double distance(const Point& a, const Point& b) {
    return std::hypot(a[Axis::x] - b[Axis::x], a[Axis::y] - b[Axis::y]);
  }
  Point motors_at(const Segment& segment, Point place) const {
    for (const Axis axis : {Axis::x, Axis::y}) {
      if (segment.downs.has(axis)) place[axis] -= options_.backlash[axis];
    }
    return place;
  }

  BacklashOptions options_;
  Point motors_;
  Point places_;
  bool begun_ = false;
};

// The greatest jumps of the derivatives between the segments that are passed without a stop.
struct Jumps {
  double slope = 0;
  double bend = 0;
};
Jumps jumps_in(const std::vector<Segment>& segments) {
  Jumps jumps;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const Segment& before = segments[i - 1];
    if (before.mode == PathMode::exact_stop) continue;
    const Curve& one = before.curve;
    const Curve& other = segments[i].curve;
    for (const Axis axis : {Axis::x, Axis::y}) {
      const double slope = other.tangent(Mm(0))[axis] - one.tangent(one.length())[axis];
      const double bend = other.second_derivative(Mm(0))[axis] - one.second_derivative(one.length())[axis];
      jumps.slope = std::max(jumps.slope, std::abs(slope));
      jumps.bend = std::max(jumps.bend, std::abs(bend));
    }
  }
  return jumps;
}

int stops_in(const std::vector<Segment>& segments) {
  return static_cast<int>(std::ranges::count_if(segments, &Segment::takes_up_backlash));
}

TEST(BacklashInMotion, a_circle_with_a_tolerance_does_not_rest_at_its_quadrants) {
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    const BacklashOptions options = in_motion(at(5, 0), smoothness);
    const auto all = segments_of({with_tolerance(circle(), 0.01 * options.smoothing_share)}, options);
    EXPECT_EQ(stops_in(all), 1) << "X begins in the other direction";
    EXPECT_TRUE(all[0].takes_up_backlash);
    Slides slides(options);
    for (const Segment& one : all) slides.follow(one);
    EXPECT_LE(slides.gap, 1e-9);
    EXPECT_LE(slides.off_in_motion, 0.01);
    EXPECT_GT(slides.off_in_motion, 0.005) << "the tolerance is used";
    EXPECT_LE(slides.off_elsewhere, 1e-9) << "the motor is at its flank again";
    EXPECT_EQ(all.back().curve.end(), at(5, 0));
    EXPECT_TRUE(all.back().downs.empty());
    const Jumps jumps = jumps_in(all);
    EXPECT_LE(jumps.slope, 1e-9);
    if (smoothness == Smoothness::slow_bending) {
      EXPECT_LE(jumps.bend, 1e-3 / 5) << "of the curvature of the circle";
    }
  }
}

// Circles, ellipses of cubics and waves, with random backlash and tolerance.
TEST(BacklashInMotion, the_tool_stays_within_the_tolerance_on_random_curves) {
  int in_motion_taken = 0;
  for (int number = 1; number <= 300; ++number) {
    SCOPED_TRACE(number);
    std::mt19937_64 random(static_cast<std::uint64_t>(number));
    const auto between = [&](double low, double high) {
      return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
    };
    const double tolerance = between(1e-3, 0.1);
    const Smoothness smoothness = number % 2 == 0 ? Smoothness::least_bending : Smoothness::slow_bending;
    BacklashOptions options = in_motion({}, smoothness);
    options.backlash[Axis::x] = between(1e-3, 0.5);
    options.backlash[Axis::y] = between(1e-3, 0.5);
    for (double& least : options.least.values) least = 1e-4;
    std::vector<PathItem> path;
    Point place;
    Point slope = at(0.6, 0.8);
    for (int i = 0; i < 12; ++i) {  // a smooth path of cubics
      const double angle = std::uniform_real_distribution<double>(-1.5, 1.5)(random);
      const Point next_slope = at(slope[Axis::x] * std::cos(angle) - slope[Axis::y] * std::sin(angle),
                                  slope[Axis::x] * std::sin(angle) + slope[Axis::y] * std::cos(angle));
      const double length = between(0.05, 20);
      const Point end = place + (slope + next_slope) * (length / 2);
      Segment piece{.curve = Curve::cubic(place, slope, end, next_slope, Mm(length)), .speed = MmPerSecond(10)};
      path.emplace_back(with_tolerance(piece, tolerance * options.smoothing_share));
      place = end;
      slope = next_slope;
    }
    const auto all = segments_of(path, options);
    Slides slides(options);
    for (const Segment& one : all) slides.follow(one);
    EXPECT_LE(slides.gap, 1e-9);
    EXPECT_LE(slides.off_in_motion, tolerance * (1 - options.smoothing_share) + 2e-4);
    EXPECT_LE(slides.off_elsewhere, 4e-4);
    EXPECT_LE(jumps_in(all).slope, 1e-6);
    EXPECT_EQ(all.back().curve.end(), place);
    in_motion_taken +=
        static_cast<int>(std::ranges::count_if(all, [](const Segment& one) { return one.lead.has_value(); }));
  }
  EXPECT_GT(in_motion_taken, 1000);
}

TEST(BacklashInMotion, without_a_tolerance_and_at_an_exact_stop_the_tool_rests) {
  EXPECT_EQ(stops_in(segments_of({circle()}, in_motion(at(5, 0)))), 4);
  Segment half = with_tolerance(circle(), 0.01);
  half.curve = half.curve.part(Mm(0), half.curve.length() / 4);
  half.mode = PathMode::exact_stop;  // at the top, where Y reverses
  Segment rest = with_tolerance(circle(), 0.01);
  rest.curve = rest.curve.part(rest.curve.length() / 4, rest.curve.length());
  EXPECT_EQ(stops_in(segments_of({half, rest}, in_motion(at(5, 0)))), 2);
}

TEST(BacklashInMotion, a_segment_that_is_begun_in_its_middle_has_the_same_lead) {
  const auto all = segments_of({with_tolerance(circle(), 0.01)}, in_motion(at(5, 0)));
  const auto found = std::ranges::find_if(all, [](const Segment& one) { return one.lead.has_value(); });
  ASSERT_NE(found, all.end());
  Segment rest = *found;
  const Mm third = rest.curve.length() / 3;
  rest.drop_before(third);
  for (const Mm s : {Mm(0), rest.curve.length() / 2, rest.curve.length()}) {
    for (const Axis axis : {Axis::x, Axis::y}) {
      EXPECT_NEAR(rest.tool_at(s)[axis], found->tool_at(third + s)[axis], 1e-12);
      EXPECT_NEAR(rest.tool_curve().at(s)[axis], rest.tool_at(s)[axis], 1e-12);
    }
  }
}

}  // namespace
}  // namespace passo
