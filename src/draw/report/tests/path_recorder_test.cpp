#include "passo/report/path_recorder.hpp"

#include <numbers>
#include <random>

#include "kit/smooth_motion.hpp"
#include "motion.hpp"

namespace passo {
namespace {

using Kind = PathRecorder::Kind;

Point place_of(const PathRecorder& path, std::size_t index) {
  const PathRecorder::Vertex& vertex = path.vertices()[index];
  return path.base() + at(double{vertex.x}, double{vertex.y}, double{vertex.z});
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[Axis::x] - b[Axis::x], a[Axis::y] - b[Axis::y], a[Axis::z] - b[Axis::z]);
}

TEST(PathRecorder, keeps_rapids_and_feeds_as_one_polyline_with_their_speeds) {
  PathRecorder path;
  path.watch(rapid(at(0, 0, 5), at(10, 0, 5)), Point());
  path.watch(feed(at(10, 0, 5), at(10, 40, 5), 10, 100), Point());
  const auto& vertices = path.vertices();
  EXPECT_EQ(vertices.front().kind, Kind::jump);
  EXPECT_EQ(std::ranges::count(vertices, Kind::jump, &PathRecorder::Vertex::kind), 1);
  EXPECT_EQ(vertices[1].kind, Kind::rapid);
  EXPECT_EQ(vertices.back().kind, Kind::feed);
  EXPECT_LT(distance(place_of(path, vertices.size() - 1), at(10, 40, 5)), 1e-5);
  EXPECT_DOUBLE_EQ(path.fastest_feed().value(), 10);
  float fastest = 0;
  for (const auto& vertex : vertices) {
    if (vertex.kind == Kind::feed) fastest = std::max(fastest, vertex.speed);
  }
  EXPECT_FLOAT_EQ(fastest, 10);
}

TEST(PathRecorder, a_ramp_of_speed_is_seen_as_a_ramp) {
  PathRecorder path;
  path.watch(feed(at(0, 0), at(40, 0), 20, 20), Point());
  float last = 0;
  for (std::size_t i = 1; place_of(path, i)[Axis::x] < 9.99; ++i) {
    EXPECT_GT(path.vertices()[i].speed, last);
    EXPECT_LT(path.vertices()[i].speed - last, 1.5);
    last = path.vertices()[i].speed;
  }
  EXPECT_GT(last, 18);
}

TEST(PathRecorder, flattens_an_arc_so_finely_that_no_eye_sees_it) {
  PathRecorder path;
  path.watch(play(Curve::arc(at(8, 0), at(8, 0), Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi), 10, 100), Point());
  for (std::size_t i = 1; i < path.vertices().size(); ++i) {
    const Point middle = (place_of(path, i - 1) + place_of(path, i)) * 0.5;
    EXPECT_NEAR(distance(middle, Point()), 8, 8.0 / 1900);
  }
}

TEST(PathRecorder, flattens_cubics_in_parts_into_one_polyline_that_follows_them) {
  const std::vector<Curve> curves =
      test::spline_through({at(0, 0), at(10, 3), at(12, -5), at(12.1, -5.2), at(30, 0), at(31, 8)});
  double length = 0;
  for (const Curve& curve : curves) length += curve.length().value();
  test::PhaseChain chain;
  chain.change_speed(1, 1, 0.4);
  chain.change_speed(0, 1, 0.4);
  PathRecorder path;
  for (const MotionItem& item : test::moves_along(curves, chain.over(length, 20), 1.7)) path.watch(item, Point());

  EXPECT_EQ(std::ranges::count(path.vertices(), Kind::jump, &PathRecorder::Vertex::kind), 1);
  EXPECT_LT(distance(place_of(path, path.vertices().size() - 1), at(31, 8)), 1e-5);
  double farthest = 0;
  std::size_t near = 1;  // the polyline and the curves are walked together
  for (const Curve& curve : curves) {
    for (int i = 0; i <= 1000; ++i) {
      const Point point = curve.at(curve.length() * (i / 1000.0));
      double best = 1e9;
      for (std::size_t k = near; k < std::min(near + 4, path.vertices().size()); ++k) {
        const Point from = place_of(path, k - 1);
        const Point chord = place_of(path, k) - from;
        const Point way = point - from;
        const double along = way[Axis::x] * chord[Axis::x] + way[Axis::y] * chord[Axis::y];
        const double share = std::clamp(along / (distance(chord, Point()) * distance(chord, Point())), 0.0, 1.0);
        const double off = distance(way, chord * share);
        if (off >= best) continue;
        best = off;
        near = k;
      }
      farthest = std::max(farthest, best);
    }
  }
  EXPECT_LT(farthest, 0.01);
  EXPECT_LT(path.vertices().size(), 1000U);
}

TEST(PathRecorder, begins_anew_where_the_path_jumps) {
  PathRecorder path;
  path.watch(feed(at(0, 0), at(1, 0)), Point());
  path.watch(feed(at(5, 0), at(6, 0)), Point());
  EXPECT_EQ(std::ranges::count(path.vertices(), Kind::jump, &PathRecorder::Vertex::kind), 2);
}

TEST(PathRecorder, remembers_each_work_zero_once) {
  PathRecorder path;
  for (int i = 0; i < 20; ++i) {
    path.watch(feed(at(i, 0), at(i + 1, 0)), i % 2 == 0 ? at(1, 2) : at(3, 4));
  }
  EXPECT_EQ(path.origins(), (std::vector<Point>{at(1, 2), at(3, 4)}));
}

TEST(PathRecorder, is_empty_where_only_a_rotary_axis_turns) {
  Point turned;
  turned[Axis::a] = 90;
  PathRecorder path;
  path.watch(feed(Point(), turned), Point());
  path.watch(dwell(2), Point());
  EXPECT_TRUE(path.empty());
  EXPECT_TRUE(path.vertices().empty());
  EXPECT_GT(path.time(), Seconds(2));
}

// A million short lines along a curve that crosses itself.
Point on_knot(int i) {
  const double t = i * 2e-5;
  return at(60 * std::sin(3 * t), 40 * std::cos(2 * t + 0.3), 5 * std::sin(7 * t));
}

TEST(PathRecorder, a_million_lines_stay_in_bounds_near_the_path_and_keep_their_extents) {
  PathRecorder path;
  Box expected{on_knot(0), on_knot(0)};
  for (int i = 0; i < 1'000'000; ++i) {
    path.watch(cruise(on_knot(i), on_knot(i + 1), 20), Point());
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      expected.low[axis] = std::min(expected.low[axis], on_knot(i + 1)[axis]);
      expected.high[axis] = std::max(expected.high[axis], on_knot(i + 1)[axis]);
    }
  }
  EXPECT_LE(path.vertices().capacity() * sizeof(PathRecorder::Vertex), 4U << 20U);
  EXPECT_LE(path.vertices().size(), PathRecorder::most_vertices);
  EXPECT_EQ(path.extents().low, expected.low);
  EXPECT_EQ(path.extents().high, expected.high);

  // Vertices are points of the path, in the order of the path, and never far apart along it. So the test walks along
  // both together.
  int i = 0;
  double worst = 0;
  for (std::size_t vertex = 1; vertex < path.vertices().size(); ++vertex) {
    ASSERT_NE(path.vertices()[vertex].kind, Kind::jump);
    const Point from = place_of(path, vertex - 1);
    const Point to = place_of(path, vertex);
    while (i < 1'000'000 && distance(on_knot(i), to) > 1e-4) {
      const Point arm = on_knot(i) - from;
      const Point piece = to - from;
      double dot = 0;
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) dot += arm[axis] * piece[axis];
      const double share = std::clamp(dot / std::pow(distance(from, to), 2), 0.0, 1.0);
      worst = std::max(worst, distance(on_knot(i), from + piece * share));
      ++i;
    }
  }
  EXPECT_LT(worst, 0.2);  // a pixel at an extent of 145 mm
}

TEST(PathRecorder, what_cannot_be_joined_is_thinned_evenly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-50, 50);
  PathRecorder path;
  Point last;
  constexpr int moves = 600'000;
  for (int i = 0; i < moves; ++i) {
    // X grows slowly from the start to the end.
    const Point next = at(100.0 * i / moves + anywhere(random) / 10, anywhere(random), anywhere(random));
    path.watch(cruise(last, next, 10, i % 2 != 0), Point());
    last = next;
  }
  EXPECT_LE(path.vertices().size(), PathRecorder::most_vertices);
  EXPECT_GT(path.vertices().size(), PathRecorder::most_vertices / 4);
  std::array<double, 10> tenths{};  // the share of the path that is drawn in each tenth of X
  for (std::size_t i = 1; i < path.vertices().size(); ++i) {
    if (path.vertices()[i].kind == Kind::jump) continue;
    const double x = place_of(path, i)[Axis::x];
    if (x < 0 || x >= 100) continue;
    tenths[static_cast<std::size_t>(x / 10)] += distance(place_of(path, i - 1), place_of(path, i));
  }
  const auto [least, most] = std::ranges::minmax(tenths);
  EXPECT_GT(least * 1.5, most);
}

}  // namespace
}  // namespace passo
