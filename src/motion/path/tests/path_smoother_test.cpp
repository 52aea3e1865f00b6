#include "passo/path/path_smoother.hpp"

#include "smoothing_kit.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using test::apart;
using test::Faults;
using test::faults_of;
using test::PathSmootherTest;
using test::Random;
using test::RandomPath;
using test::segments_of;
using test::smooth;
using test::xyz;

TEST_F(PathSmootherTest, a_corner_is_rounded_and_what_lies_beside_it_stays_a_line) {
  go(10, 0);
  go(10, 10);
  const std::vector<Segment> segments = smoothed();
  expect_good(path_);
  ASSERT_EQ(segments.size(), 12U);
  EXPECT_EQ(cubics(segments), 10U);
  EXPECT_EQ(segments.front().curve.shape(), Curve::Shape::line);
  EXPECT_EQ(segments.front().curve.start(), xyz(0, 0));
  EXPECT_EQ(segments.back().curve.end(), xyz(10, 10));
  EXPECT_EQ(stops(segments), 1U);
  EXPECT_EQ(segments.back().mode, PathMode::exact_stop);
}

TEST_F(PathSmootherTest, a_corner_is_rounded_by_nearly_all_of_the_tolerance) {
  go(10, 0);
  go(10, 10);
  double nearest = 1;
  for (const Segment& segment : smoothed()) {
    for (int i = 0; i <= 100; ++i) {
      nearest = std::min(nearest, apart(segment.curve.at(segment.curve.length() * (i / 100.0)), xyz(10, 0)));
    }
  }
  EXPECT_GT(nearest, 0.6 * tolerance_);  // the tolerance counts at equal s; the nearest place is nearer
  EXPECT_LE(nearest, tolerance_);
}

// Before the corner and after it, so that the corner can be passed faster. Where an axis goes back as fast as any axis
// moves, the swing would only be a way more for that axis.
TEST_F(PathSmootherTest, a_corner_swings_to_the_outer_side_unless_an_axis_goes_back) {
  go(10, 0);
  go(10, 10);
  double outside = 0;
  for (const Segment& segment : smoothed()) outside = std::max(outside, -segment.curve.extents().low[Axis::y]);
  EXPECT_GT(outside, 0.5 * tolerance_);
  EXPECT_LE(outside, tolerance_);
  double slowly = 0;
  for (const Segment& segment : segments_of(smooth(path_, Smoothness::slow_bending))) {
    slowly = std::max(slowly, -segment.curve.extents().low[Axis::y]);
  }
  EXPECT_GT(slowly, 0.5 * tolerance_);
  EXPECT_LE(slowly, tolerance_);

  path_.clear();
  position_ = Point();
  go(10, 10);
  go(20, 0);
  double above = 0;
  for (const Segment& segment : smoothed()) above = std::max(above, segment.curve.extents().high[Axis::y]);
  EXPECT_LT(above, 10);
}

// The corner is passed at the slow feed, where a swing would only be a way more.
TEST_F(PathSmootherTest, a_corner_to_a_slow_feed_does_not_swing) {
  go(10, 0);
  go(10, 10).speed = MmPerSecond(5);
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    for (const Segment& segment : segments_of(smooth(path_, smoothness))) {
      EXPECT_GT(segment.curve.extents().low[Axis::y], -0.2 * tolerance_);
      EXPECT_LT(segment.curve.extents().high[Axis::x], 10 + 0.2 * tolerance_);
    }
  }
}

// From a stop the path may go in any direction, so it swings wide before the first corner. A slow feed has no use for
// the swing: it would only be longer.
TEST_F(PathSmootherTest, short_legs_leave_a_stop_toward_the_outer_side) {
  const auto stairs = [&](double feed) {
    path_.clear();
    position_ = Point();
    for (int i = 0; i < 12; ++i) {
      const double along = (i / 2 + 1) * 6 * tolerance_;
      (i % 2 == 0 ? go(along, position_[Axis::y]) : go(position_[Axis::x], along)).speed = MmPerSecond(feed);
    }
  };
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    stairs(1000);
    const std::vector<PathItem> fast = smooth(path_, smoothness);
    const Faults faults = faults_of(path_, fast);
    EXPECT_LE(faults.excess, 0) << faults.where;
    EXPECT_EQ(faults.gaps, 0U);
    EXPECT_LT(faults.tangent_jump, 1e-9);
    const std::vector<Segment> segments = segments_of(fast);
    EXPECT_LT(segments.front().curve.tangent(Mm(0))[Axis::y], -0.05);
    EXPECT_LT(segments.back().curve.tangent(segments.back().curve.length())[Axis::x], -0.05);
    EXPECT_EQ(segments.front().curve.start(), xyz(0, 0));
    EXPECT_EQ(segments.back().curve.end(), position_);

    stairs(5);
    const std::vector<Segment> slow = segments_of(smooth(path_, smoothness));
    EXPECT_NEAR(slow.front().curve.tangent(Mm(0))[Axis::y], 0, 1e-9);
  }
}

TEST_F(PathSmootherTest, a_line_in_pieces_is_one_line) {
  constexpr int pieces = 700;
  for (int i = 1; i <= pieces; ++i) go(12.0 * i / pieces, 9.0 * i / pieces);
  const std::vector<Segment> segments = smoothed();
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].curve.length(), Mm(15));
  EXPECT_EQ(segments[0].source.line, 1U);
}

TEST_F(PathSmootherTest, corners_between_lines_in_pieces_are_those_between_whole_lines) {
  go(12, 0);
  go(12, 9);
  const std::vector<Segment> whole = smoothed();
  path_.clear();
  position_ = Point();
  for (int i = 1; i <= 64; ++i) go(12.0 * i / 64, 0);
  for (int i = 1; i <= 64; ++i) go(12, 9.0 * i / 64);
  const std::vector<Segment> pieces = smoothed();
  ASSERT_EQ(pieces.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(pieces[i].curve.start(), whole[i].curve.start());
    EXPECT_EQ(pieces[i].curve.end(), whole[i].curve.end());
  }
}

TEST_F(PathSmootherTest, lines_merge_within_the_merge_tolerance_only) {
  const auto count_with = [&](double sideways) {
    path_.clear();
    position_ = Point();
    for (int i = 1; i <= 50; ++i) go(i, i % 2 == 0 ? sideways : 0);
    return smoothed().size();
  };
  EXPECT_EQ(count_with(0.0004), 1U);
  EXPECT_EQ(cubics(smoothed()), 0U);
  EXPECT_GT(count_with(0.015), 20U);
}

// A corner under a wide tolerance does not reach over the joint of two lines in one direction, whose own is narrow.
TEST_F(PathSmootherTest, a_corner_keeps_to_the_narrow_tolerance_of_the_lines_after_it) {
  tolerance_ = 0.2471;
  go(-3.5393, -0.9461);
  go(-3.6113, -0.9461);
  tolerance_ = 0.0162;
  go(-3.6113, -1.1475);
  go(-3.6113, -1.6551);
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending})
    expect_good(path_, smoothness);
}

TEST_F(PathSmootherTest, lines_of_different_feed_or_kind_do_not_merge) {
  go(10, 0);
  go(20, 0).speed = MmPerSecond(80);
  go(30, 0).rapid = true;
  const std::vector<Segment> segments = smoothed();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(cubics(segments), 0U);
  EXPECT_EQ(stops(segments), 1U);
}

TEST_F(PathSmootherTest, a_reversal_stops_at_its_point) {
  go(0, 0, 5);
  go(10, 0, 5);
  go(10, 0, -3);
  go(10, 0, 5);
  const std::vector<Segment> segments = smoothed();
  expect_good(path_);
  EXPECT_EQ(stops(segments), 2U);
  EXPECT_TRUE(std::ranges::any_of(segments, [](const Segment& segment) {
    return segment.mode == PathMode::exact_stop && segment.curve.end() == xyz(10, 0, -3);
  }));
}

TEST_F(PathSmootherTest, actions_and_exact_stops_are_rests_and_the_path_is_met_there) {
  go(10, 0);
  path_.emplace_back(Action{.kind = Action::Kind::dwell, .dwell = Seconds(1)});
  go(10, 10).mode = PathMode::exact_stop;
  go(20, 10);
  const std::vector<PathItem> items = smooth(path_);
  ASSERT_EQ(items.size(), 4U);
  EXPECT_TRUE(std::holds_alternative<Action>(items[1]));
  const std::vector<Segment> segments = segments_of(items);
  EXPECT_EQ(stops(segments), 3U);
  EXPECT_EQ(cubics(segments), 0U);
  EXPECT_EQ(segments[0].curve.end(), xyz(10, 0));
  EXPECT_EQ(segments[1].curve.end(), xyz(10, 10));
}

TEST_F(PathSmootherTest, without_a_tolerance_every_corner_is_a_rest) {
  tolerance_ = 0;
  go(10, 0);
  go(10, 10);
  go(20, 10);
  const std::vector<Segment> segments = smoothed();
  EXPECT_EQ(segments.size(), 3U);
  EXPECT_EQ(stops(segments), 3U);
}

TEST_F(PathSmootherTest, an_exact_path_stops_at_corners_and_smooths_what_programs_round) {
  tolerance_ = 0;
  go(10, 0).mode = PathMode::exact_path;
  go(20, 0.05).mode = PathMode::exact_path;  // 5 mrad
  go(20, 10).mode = PathMode::exact_path;
  const std::vector<Segment> segments = smoothed();
  EXPECT_EQ(stops(segments), 2U);
  EXPECT_GT(cubics(segments), 0U);
  for (const Segment& segment : segments) {
    if (segment.curve.shape() != Curve::Shape::cubic) continue;
    for (int i = 0; i <= 20; ++i) {
      const Point place = segment.curve.at(segment.curve.length() * (i / 20.0));
      EXPECT_LE(std::abs(place[Axis::y] - std::max(0.0, (place[Axis::x] - 10) * 0.005)), 0.001);
    }
  }
}

TEST_F(PathSmootherTest, arcs_that_begin_along_the_path_but_for_rounding_are_passed_without_a_stop) {
  go(10, 0);
  arc(10, 4, 10.0003, 2.0002, 3.14159);
  go(0, 4);
  arc(0, 0, 0, 2, 3.14159);
  go(5, 0);
  expect_good(path_);
  EXPECT_EQ(stops(smoothed()), 1U);
}

TEST_F(PathSmootherTest, a_full_circle_and_a_helix_stay_arcs) {
  go(5, 0);
  arc(5, 0, 0, 0, 6.283185307179586);
  add(Curve::arc(position_, xyz(5, 0, -3), Axis::x, Axis::y, 0, 0, 6 * 3.14159265358979));
  expect_good(path_);
  double swept = 0;
  for (const Segment& segment : smoothed()) {
    if (segment.curve.shape() == Curve::Shape::arc) swept += segment.curve.arc_data().sweep;
  }
  EXPECT_GT(swept, 0.95 * 8 * 3.14159265358979);
}

TEST_F(PathSmootherTest, rotary_axes_move_along) {
  Point end = xyz(10, 0);
  end[Axis::a] = 90;
  add(Curve::line(position_, end));
  end[Axis::y] = 10;
  end[Axis::c] = -30;
  add(Curve::line(position_, end));
  end[Axis::b] = 45;  // only this axis turns
  add(Curve::line(position_, end));
  expect_good(path_);
  EXPECT_EQ(smoothed().back().curve.end(), end);
  EXPECT_EQ(stops(smoothed()), 1U);
}

TEST_F(PathSmootherTest, a_span_goes_no_faster_than_any_of_the_path_beside_it) {
  go(10, 0).speed = MmPerSecond(10);
  go(20, 1).rapid = true;
  go(30, 0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Segment& segment : smoothed()) {
    const bool on_the_first = segment.curve.end()[Axis::x] < 9.999;
    const bool on_the_second = segment.curve.start()[Axis::x] > 9.9 && segment.curve.end()[Axis::x] < 20.1;
    EXPECT_LE(segment.speed, MmPerSecond(on_the_first ? 10 : on_the_second ? infinity : 50));
    EXPECT_TRUE(!segment.rapid || on_the_second);
  }
}

TEST_F(PathSmootherTest, a_slow_line_slows_no_other) {
  go(5, 0);
  go(5.2, 0.02).speed = MmPerSecond(1);
  go(10, 0);
  double slow = 0;
  for (const Segment& segment : smoothed()) {
    if (segment.speed > MmPerSecond(1)) continue;
    slow += segment.curve.length().value();
    EXPECT_GT(segment.curve.start()[Axis::x], 5 - 1e-3);
    EXPECT_LT(segment.curve.end()[Axis::x], 5.2 + 1e-3);
  }
  EXPECT_NEAR(slow, std::hypot(0.2, 0.02), 1e-3);
  expect_good(path_);
}

TEST_F(PathSmootherTest, dust_is_smoothed_over) {
  for (int i = 1; i <= 3000; ++i) go(1e-6 * i, 1e-6 * (i % 3));
  go(5, 0);
  go(5, 5);
  expect_good(path_);
  EXPECT_EQ(stops(smoothed()), 1U);
}

TEST_F(PathSmootherTest, dense_programs_get_fewer_pieces_than_they_have_and_no_stops) {
  for (int i = 1; i <= 20'000; ++i) {
    const double s = 0.01 * i;
    go(s, std::round(1000 * 3 * std::sin(s)) / 1000);
  }
  expect_good(path_);
  const std::vector<Segment> segments = smoothed();
  EXPECT_LT(segments.size(), 8000U);
  EXPECT_EQ(stops(segments), 1U);
}

// The rounding of the chords' ends bends the path up to a hundred times as much as the circle does.
TEST_F(PathSmootherTest, a_circle_of_rounded_chords_bends_as_the_circle_does) {
  constexpr double radius = 25;
  constexpr double circumference = 2 * 3.14159265358979 * radius;
  for (const double grid : {0.001, 0.00254, 0.005}) {
    for (const double chord : {0.02, 0.05}) {
      for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
        path_.clear();
        position_ = xyz(radius, 0);
        for (double s = chord; s <= circumference; s += chord) {
          const Point end = xyz(std::round(radius * std::cos(s / radius) / grid) * grid,
                                std::round(radius * std::sin(s / radius) / grid) * grid);
          if (end != position_) go(end[Axis::x], end[Axis::y]);
        }
        expect_good(path_, smoothness);
        const std::vector<Segment> segments = segments_of(smooth(path_, smoothness));
        EXPECT_LT(segments.size(), 150U);
        double most = 0;
        double s = 0;
        for (const Segment& segment : segments) {
          s += segment.curve.length().value();
          // Near its rests the path is slow, whatever its bend.
          if (s > 5 && s < circumference - 5) most = std::max(most, segment.curve.curvature());
        }
        EXPECT_LT(most, 1.15 / radius) << grid << " " << chord;
      }
    }
  }
}

// Beside a corner the chords stay, so that all of the tube is the corner's.
TEST_F(PathSmootherTest, a_corner_beside_rounded_chords_is_rounded_like_one_between_lines) {
  const auto nearest_to_the_corner = [&] {
    double nearest = 1;
    for (const Segment& segment : smoothed()) {
      for (int i = 0; i <= 100; ++i) {
        nearest = std::min(nearest, apart(segment.curve.at(segment.curve.length() * (i / 100.0)), xyz(10, 0)));
      }
    }
    return nearest;
  };
  go(10, 0);
  go(10, 10);
  const double between_lines = nearest_to_the_corner();
  path_.clear();
  position_ = Point();
  for (int i = 1; i <= 200; ++i) go(0.05 * i, i % 3 == 0 ? 0 : 0.001);
  for (int i = 1; i <= 200; ++i) go(i % 3 == 0 ? 10 : 10.001, 0.05 * i);
  expect_good(path_);
  EXPECT_NEAR(nearest_to_the_corner(), between_lines, 0.2 * between_lines);
}

TEST_F(PathSmootherTest, slow_bending_keeps_to_the_tube_of_a_rough_path) {
  for (int i = 1; i <= 2000; ++i) {
    const double s = 0.2 * i;
    go(s, std::round(50 * 3 * std::sin(0.3 * s)) / 50);
  }
  expect_good(path_, Smoothness::slow_bending);
}

// Around a right angle p advances as the machine does: slower at the corner, and so evenly that the second derivative
// changes little.
TEST_F(PathSmootherTest, slow_bending_goes_slowly_around_a_corner) {
  go(10, 0);
  go(10, 10);
  expect_good(path_, Smoothness::slow_bending);
  double slowest = 1;
  double change = 0;
  double quickest_change = 0;
  for (const Smoothness smoothness : {Smoothness::least_bending, Smoothness::slow_bending}) {
    slowest = 1;
    quickest_change = change;
    change = 0;
    for (const Segment& segment : segments_of(smooth(path_, smoothness))) {
      slowest = std::min(slowest, test::euclid(segment.curve.tangent(Mm(0))));
      change = std::max(change, test::euclid(segment.curve.third_derivative(Mm(0))));
    }
  }
  EXPECT_LT(slowest, 0.5);
  EXPECT_LT(change, quickest_change);
}

// A path that is cut off far ahead comes out the same, to the bit, up to shortly before the cut.
TEST_F(PathSmootherTest, what_comes_out_depends_on_nothing_far_ahead) {
  for (int i = 1; i <= 3000; ++i) go(0.3 * i, std::round(10000 * std::sin(0.2 * i)) / 10000);
  const std::vector<Segment> all = smoothed();
  path_.resize(2000);
  const std::vector<Segment> part = smoothed();
  ASSERT_GT(part.size(), 1000U);
  for (std::size_t i = 0; i < part.size() - 400; ++i) {
    ASSERT_EQ(part[i].curve.end(), all[i].curve.end()) << i;
    ASSERT_EQ(part[i].curve.tangent(Mm(0)), all[i].curve.tangent(Mm(0))) << i;
  }
}

class CountingSource final : public Source<PathItem> {
 public:
  [[nodiscard]] bool next(PathItem& item) override {
    if (given == 300'000) return false;
    const double x = 0.1 * static_cast<double>(++given);
    const Point end = xyz(x, std::sin(x));
    item = Segment{.curve = Curve::line(position_, end), .speed = MmPerSecond(10), .tolerance = Mm(0.01)};
    position_ = end;
    return true;
  }
  std::size_t given = 0;

 private:
  Point position_;
};

TEST_F(PathSmootherTest, reads_only_so_far_ahead) {
  CountingSource source;
  PathSmoother smoother(source);
  double reached = 0;
  for (PathItem item; smoother.next(item);) {
    const double ahead = 0.1 * static_cast<double>(source.given) - reached;
    ASSERT_LT(ahead, 0.1 * 128 * 3);
    reached = std::get<Segment>(item).curve.end()[Axis::x];
  }
  EXPECT_NEAR(reached, 30'000, 1e-6);
}

// PASSO_RUNS: how many paths of 150 moves.
TEST_F(PathSmootherTest, random_paths_stay_in_the_tube_without_a_gap_or_a_bend) {
  const char* const given = std::getenv("PASSO_RUNS");
  const int runs = given != nullptr ? std::atoi(given) : 100;
  Random random;
  std::size_t rests = 0;
  std::size_t stopped = 0;
  for (int round = 0; round < runs && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    RandomPath drawn(random);
    drawn.rotary = round % 3 == 0;
    drawn.merge_share = round % 2 == 0 ? 0.05 : 0;
    const std::vector<PathItem> path = drawn.draw(150);
    const Smoothness smoothness = round % 5 < 2 ? Smoothness::slow_bending : Smoothness::least_bending;
    expect_good(path, smoothness);
    rests += test::rests_of(test::by_length(path)).size();
    stopped += stops(segments_of(smooth(path, smoothness)));
  }
  // The last resort is rare.
  EXPECT_LE(stopped, rests + rests / 20);
}

}  // namespace
}  // namespace passo
