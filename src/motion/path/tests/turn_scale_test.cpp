#include "../turn_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "path_test.hpp"

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

constexpr double degrees = 0.05;

Point at(double x, double y, double a, double b = 0) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::a] = a;
  point[Axis::b] = b;
  return point;
}

Segment line(const Point& from, const Point& to, double tolerance = 0.01) {
  return {.curve = Curve::line(from, to),
          .speed = MmPerSecond(100),
          .tolerance = Mm(tolerance),
          .merge = Mm(tolerance / 20),
          .turn_tolerance = degrees};
}

std::vector<Segment> smoothed(const std::vector<Segment>& path) {
  std::vector<PathItem> items(path.begin(), path.end());
  test::ListSource<PathItem> source(items);
  PathSmoother smoother(source);
  std::vector<Segment> found;
  for (const PathItem& item : test::drain(smoother)) found.push_back(std::get<Segment>(item));
  return found;
}

// The largest distance of the smoothed path from the programmed lines, each point to the nearest one, in millimetres
// and degrees that weigh `degree` millimetres.
double deviation(const std::vector<Segment>& programmed, const std::vector<Segment>& path, double degree) {
  const auto weighted = [&](Point point) {
    for (const Axis axis : {Axis::a, Axis::b, Axis::c}) point[axis] *= degree;
    return point;
  };
  double most = 0;
  for (const Segment& segment : path) {
    for (int i = 0; i <= 20; ++i) {
      const Point place = weighted(segment.curve.at(segment.curve.length() * (i / 20.0)));
      double least = std::numeric_limits<double>::infinity();
      for (const Segment& own : programmed) {
        const Point start = weighted(own.curve.start());
        const Point way = weighted(own.curve.end()) - start;
        const double share = std::clamp(dot(place - start, way) / dot(way, way), 0.0, 1.0);
        least = std::min(least, distance(place, start + way * share));
      }
      most = std::max(most, least);
    }
  }
  return most;
}

int rests(const std::vector<Segment>& path) {
  return static_cast<int>(
      std::ranges::count_if(path, [](const Segment& segment) { return segment.mode == PathMode::exact_stop; }));
}

TEST(TurnScale, a_unit_is_a_sum_of_two_powers_of_two) {
  for (const auto& [ratio, unit] : {std::pair(5.0, 5.0),
                                    {0.05 / 0.02, 2.5},
                                    {0.05 / 0.01, 5.0},
                                    {1.0, 1.0},
                                    {0.9, 0.75},
                                    {1.99, 1.5},
                                    {7.99, 6.0},
                                    {0.05 / 0.1, 0.5},
                                    {1000.0, 768.0}}) {
    EXPECT_EQ(largest_turn_unit(ratio), unit) << ratio;
  }
  test::Random random;
  for (int i = 0; i < 100'000; ++i) {
    const double unit = largest_turn_unit(std::exp(random.between(-8, 8)));
    const double any = random.between(-1, 1) * std::exp(random.between(-20, 12));
    const double value = with_52_bits(any);
    ASSERT_NEAR(value, any, 3e-16 * std::abs(any));
    ASSERT_EQ(value / unit * unit, value);
  }
}

// Where one turning axis passes a corner with another, the tolerance of the path in millimetres means nothing.
TEST(TurnScale, a_path_that_only_turns_is_rounded_within_degrees) {
  for (const double tolerance : {0.01, 0.03, 0.2}) {
    const std::vector<Segment> path = {line(at(0, 0, 0), at(0, 0, 20), tolerance),
                                       line(at(0, 0, 20), at(0, 0, 20, 20), tolerance)};
    const std::vector<Segment> round = smoothed(path);
    const double most = deviation(path, round, 1);
    EXPECT_LE(most, degrees * 1.0001);
    EXPECT_GE(most, degrees * 0.6) << tolerance;
    EXPECT_EQ(rests(round), 1);
    EXPECT_EQ(round.front().speed, MmPerSecond(100));
    EXPECT_NEAR(length_of(round.front().curve.tangent(Mm(0))), 1, 1e-12);
    EXPECT_EQ(round.back().curve.end(), path.back().curve.end());
  }
}

TEST(TurnScale, random_paths_stay_within_both_tolerances_and_end_exactly) {
  test::Random random;
  for (int run = 0; run < 150; ++run) {
    const double tolerance = std::exp(random.between(std::log(0.002), std::log(0.3)));
    std::vector<Segment> path;
    Point from = at(1, 2, with_52_bits(random.between(-300, 300)));
    for (int i = 0; i < 8; ++i) {
      Point to = from;
      for (const Axis axis : {Axis::x, Axis::y, Axis::a, Axis::b}) {
        if (random.chance(0.6)) to[axis] = with_52_bits(to[axis] + random.between(-5, 5));
      }
      if (counted_length(to - from) < 0.01) continue;
      path.push_back(line(from, to, tolerance));
      from = to;
    }
    if (path.empty()) continue;
    const std::vector<Segment> round = smoothed(path);
    EXPECT_LE(deviation(path, round, tolerance / degrees), tolerance * 1.0001);
    EXPECT_EQ(round.front().curve.start(), path.front().curve.start());
    EXPECT_EQ(round.back().curve.end(), path.back().curve.end());
    for (std::size_t i = 1; i < round.size(); ++i) EXPECT_EQ(round[i].curve.start(), round[i - 1].curve.end());
    if (testing::Test::HasFailure()) break;
  }
}

// A new unit needs a rest, but only where something turns, and only once.
TEST(TurnScale, another_tolerance_costs_one_rest_at_most) {
  const auto zigzag = [](double turn) {
    std::vector<Segment> path;
    for (int i = 0; i < 12; ++i) {
      path.push_back(line(at(i, i % 2, turn * i), at(i + 1, (i + 1) % 2, turn * (i + 1)), i < 6 ? 0.01 : 0.1));
    }
    return path;
  };
  // Wide for a while, then narrow again before the axis turns.
  std::vector<Segment> mixed = zigzag(0);
  mixed.push_back(line(at(12, 0, 0), at(13, 1, 0), 0.01));
  mixed.push_back(line(at(13, 1, 0), at(14, 0, 10), 0.01));
  EXPECT_EQ(rests(smoothed(mixed)), 2);
  EXPECT_EQ(rests(smoothed(zigzag(0))), 1);
  EXPECT_EQ(rests(smoothed(zigzag(1))), 2);
}

// A circle on a cylinder, in chords of X and A. With the surface it is a circle as any other.
TEST(TurnScale, chords_on_a_surface_become_a_curve_again) {
  const double radius = 20;
  const double scale = radius * std::numbers::pi / 180;
  SurfaceScale surface;
  surface[Axis::a] = scale;
  std::vector<Segment> path;
  const auto place = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / 400;
    return at(5 * std::sin(angle), 0, 5 * std::cos(angle) / scale);
  };
  for (int i = 0; i < 400; ++i) {
    Segment chord = line(place(i), place(i + 1));
    chord.curve = Curve::line(place(i), place(i + 1), surface);
    chord.surface = surface;
    path.push_back(chord);
  }
  const std::vector<Segment> round = smoothed(path);
  EXPECT_LT(round.size(), 120);
  EXPECT_EQ(rests(round), 1);
  double length = 0;
  for (const Segment& segment : round) {
    const double s = segment.curve.length().value();
    length += s;
    for (const double share : {0.1, 0.5, 0.9}) {
      const Point slope = segment.curve.tangent(Mm(s * share));
      const double speed = segment.speed.value() * length_in(slope, CountedGroup::xyz, surface);
      EXPECT_NEAR(speed, 100, 1);
    }
  }
  EXPECT_NEAR(length, 10 * std::numbers::pi, 0.1);
}

}  // namespace
}  // namespace passo
