#include "passo/nesting/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

DrawnPoint at_mm(double x, double y) {
  return {to_nanometres(Mm(x)), to_nanometres(Mm(y))};
}

DrawnRing box_ring(double width, double height) {
  return {at_mm(0, 0), at_mm(width, 0), at_mm(width, height), at_mm(0, height)};
}

DrawnRing l_ring(double arm, double width) {
  return {at_mm(0, 0), at_mm(arm, 0), at_mm(arm, width), at_mm(width, width), at_mm(width, arm), at_mm(0, arm)};
}

DrawnRing disc_ring(double radius, double x, double y) {
  DrawnRing ring;
  for (int i = 0; i < 90; ++i) {
    const double angle = i * std::numbers::pi / 45;
    ring.push_back(at_mm(x + radius * std::cos(angle), y + radius * std::sin(angle)));
  }
  return ring;
}

// Around a point, with a random radius at each angle: many corners, to the left and to the right.
DrawnRing star_ring(std::mt19937_64& random, double radius, int corners) {
  DrawnRing ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double at = radius * (0.3 + 0.7 * static_cast<double>(random() % 1000) / 1000);
    ring.push_back(at_mm(at * std::cos(angle), at * std::sin(angle)));
  }
  return ring;
}

double x_of(const DrawnPoint& point) {
  return to_mm(point.x).value();
}
double y_of(const DrawnPoint& point) {
  return to_mm(point.y).value();
}

double distance_to_segment(const DrawnPoint& p, const DrawnPoint& a, const DrawnPoint& b) {
  const double dx = x_of(b) - x_of(a);
  const double dy = y_of(b) - y_of(a);
  const double length2 = dx * dx + dy * dy;
  const double share =
      length2 > 0 ? std::clamp(((x_of(p) - x_of(a)) * dx + (y_of(p) - y_of(a)) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x_of(p) - x_of(a) - share * dx, y_of(p) - y_of(a) - share * dy);
}

bool is_inside(const DrawnRing& ring, const DrawnPoint& p) {
  bool inside = false;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    const DrawnPoint& a = ring[i];
    const DrawnPoint& b = ring[last];
    if ((y_of(a) > y_of(p)) == (y_of(b) > y_of(p))) continue;
    if (x_of(p) < x_of(a) + (x_of(b) - x_of(a)) * (y_of(p) - y_of(a)) / (y_of(b) - y_of(a))) inside = !inside;
  }
  return inside;
}

bool do_cross(const DrawnPoint& a, const DrawnPoint& b, const DrawnPoint& c, const DrawnPoint& d) {
  const auto side = [](const DrawnPoint& p, const DrawnPoint& q, const DrawnPoint& r) {
    return (x_of(q) - x_of(p)) * (y_of(r) - y_of(p)) - (y_of(q) - y_of(p)) * (x_of(r) - x_of(p));
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

constexpr double tolerance_mm = 0.001;

// The distance of two rings; negative if they overlap.
double distance_of(const DrawnRing& a, const DrawnRing& b) {
  double least = 1e300;
  for (std::size_t i = 0, before_i = a.size() - 1; i < a.size(); before_i = i++) {
    for (std::size_t j = 0, before_j = b.size() - 1; j < b.size(); before_j = j++) {
      if (do_cross(a[before_i], a[i], b[before_j], b[j])) return -1;
      least =
          std::min({least, distance_to_segment(a[i], b[before_j], b[j]), distance_to_segment(b[j], a[before_i], a[i])});
    }
  }
  if (least > tolerance_mm && (is_inside(a, b.front()) || is_inside(b, a.front()))) return -1;
  return least;
}

// All copies lie on their sheets, apart from one another and from obstacles. Returns their number.
std::size_t expect_apart(const std::vector<NestShape>& shapes, const NestOptions& options, const Nest& nest) {
  std::size_t count = 0;
  std::vector<std::size_t> of_shape(shapes.size());
  for (const NestSheet& sheet : nest.sheets) {
    std::vector<std::vector<DrawnRing>> copies;
    for (const NestPlacement& placement : sheet.placements) {
      copies.emplace_back();
      ++of_shape[placement.shape];
      for (const DrawnRing& ring : shapes[placement.shape].outlines) copies.back().push_back(placed(ring, placement));
    }
    const double margin = to_mm(options.margin).value();
    const double gap = to_mm(options.gap).value();
    for (std::size_t i = 0; i < copies.size(); ++i) {
      for (const DrawnRing& ring : copies[i]) {
        for (const DrawnPoint& point : ring) {
          EXPECT_GE(x_of(point), margin - tolerance_mm);
          EXPECT_GE(y_of(point), margin - tolerance_mm);
          EXPECT_LE(x_of(point), x_of(options.sheet) - margin + tolerance_mm);
          EXPECT_LE(y_of(point), y_of(options.sheet) - margin + tolerance_mm);
          EXPECT_LE(point.x, sheet.used);
        }
        for (const DrawnBox& box : options.obstacles) EXPECT_GE(distance_of(ring, rectangle(box)), gap - tolerance_mm);
        for (std::size_t j = 0; j < i; ++j) {
          for (const DrawnRing& other : copies[j]) EXPECT_GE(distance_of(ring, other), gap - tolerance_mm);
        }
      }
    }
    count += copies.size();
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) EXPECT_EQ(of_shape[i], shapes[i].quantity);
  return count;
}

TEST(Nesting, rectangles_that_fit_exactly_leave_no_place) {
  const std::vector<NestShape> shapes = {{.name = "box", .outlines = {box_ring(99.99, 49.99)}, .quantity = 16}};
  const NestOptions options{.sheet = at_mm(399.99, 199.99), .gap = to_nanometres(Mm(0.01))};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  EXPECT_EQ(expect_apart(shapes, options, *nest), 16);
  EXPECT_EQ(nest->sheets.size(), 1);
  EXPECT_NEAR(nest->density(), 1, 1e-3);
}

TEST(Nesting, gap_and_margin_are_kept_exactly) {
  // 4 boxes of 90 and 3 gaps of 10 between margins of 5.
  const std::vector<NestShape> shapes = {{.name = "box", .outlines = {box_ring(90, 40)}, .quantity = 8}};
  const NestOptions options{
      .sheet = at_mm(400, 100), .gap = to_nanometres(Mm(10)), .margin = to_nanometres(Mm(5)), .rotations = 1};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  EXPECT_EQ(expect_apart(shapes, options, *nest), 8);
  EXPECT_EQ(nest->sheets.size(), 1);
  EXPECT_NEAR(x_of({nest->sheets.front().used, {}}), 395, tolerance_mm);
}

TEST(Nesting, two_l_shapes_interlock) {
  // Each is 20 x 20 less 12 x 12; two of them, turned, need 20 x 28.
  const std::vector<NestShape> shapes = {{.name = "L", .outlines = {l_ring(20, 8)}, .quantity = 2}};
  const NestOptions options{.sheet = at_mm(100, 20), .gap = to_nanometres(Mm(0.01))};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  expect_apart(shapes, options, *nest);
  EXPECT_LE(x_of({nest->sheets.front().used, {}}), 28.011);
}

TEST(Nesting, what_does_not_fit_on_one_sheet_goes_on_the_next) {
  const std::vector<NestShape> shapes = {{.name = "disc", .outlines = {disc_ring(30, 500, -200)}, .quantity = 9}};
  const NestOptions options{.sheet = at_mm(130, 130), .gap = to_nanometres(Mm(4)), .margin = to_nanometres(Mm(2))};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  EXPECT_EQ(expect_apart(shapes, options, *nest), 9);
  EXPECT_EQ(nest->sheets.size(), 3);
}

// The rules that put a disc between two others need a second sheet.
TEST(Nesting, discs_lie_in_rows_and_columns_where_only_so_all_of_them_fit) {
  for (const double spare : {0.1, 4.0, 10.0}) {
    const double side = 3 * 30 + 2 * 4 + 2 * 5 + spare;
    const std::vector<NestShape> shapes = {{.name = "disc", .outlines = {disc_ring(15, 0, 0)}, .quantity = 9}};
    const NestOptions options{
        .sheet = at_mm(side, side), .gap = to_nanometres(Mm(4)), .margin = to_nanometres(Mm(5)), .rounds = 20};
    const auto nest = nest_on_sheets(shapes, options, {});
    ASSERT_TRUE(nest.has_value());
    EXPECT_EQ(expect_apart(shapes, options, *nest), 9U);
    EXPECT_EQ(nest->sheets.size(), 1U) << spare;
  }
}

// A circle drawn twice, with chords of two lengths: the corners of both, so it is not convex. After a quarter turn its
// edges are parallel to those before.
TEST(Nesting, shapes_with_parallel_edges_keep_their_distance) {
  for (const auto& [first, second] : {std::pair(100, 149), std::pair(60, 44), std::pair(100, 100), std::pair(4, 4)}) {
    std::vector<double> angles;
    for (int i = 0; i < first; ++i) angles.push_back(2 * std::numbers::pi * i / first);
    for (int i = 0; first != second && i < second; ++i) angles.push_back(2 * std::numbers::pi * i / second);
    std::ranges::sort(angles);
    angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < 1e-6; }),
                 angles.end());
    DrawnRing ring;
    for (const double angle : angles) {
      // Every second corner lies a little inside.
      const double radius = first == second || ring.size() % 2 == 0 ? 20 : 19.99;
      ring.push_back(at_mm(radius * std::cos(angle), radius * std::sin(angle)));
    }
    const std::vector<NestShape> shapes = {{.name = "disc", .outlines = {ring}, .quantity = 6}};
    const NestOptions options{
        .sheet = at_mm(150, 110), .gap = to_nanometres(Mm(7)), .margin = to_nanometres(Mm(7)), .rounds = 60};
    const auto nest = nest_on_sheets(shapes, options, {});
    ASSERT_TRUE(nest.has_value());
    EXPECT_EQ(expect_apart(shapes, options, *nest), 6) << first << " and " << second;
    EXPECT_LT(nest->density(), 0.85);
  }
}

TEST(Nesting, clamps_stay_free) {
  const std::vector<NestShape> shapes = {{.name = "L", .outlines = {l_ring(40, 15)}, .quantity = 12}};
  const NestOptions options{.sheet = at_mm(300, 200),
                            .gap = to_nanometres(Mm(5)),
                            .margin = to_nanometres(Mm(5)),
                            .obstacles = {{at_mm(-20, 60), at_mm(30, 90)}, {at_mm(60, 170), at_mm(100, 240)}}};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  EXPECT_EQ(expect_apart(shapes, options, *nest), 12);
}

TEST(Nesting, a_shape_larger_than_the_sheet_is_named_with_sizes) {
  const std::vector<NestShape> shapes = {{.name = "small", .outlines = {box_ring(20, 20)}},
                                         {.name = "beam", .outlines = {box_ring(250, 30)}}};
  const NestOptions options{.sheet = at_mm(200, 100), .margin = to_nanometres(Mm(5))};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_FALSE(nest.has_value());
  EXPECT_EQ(nest.error().shape, 1);
  EXPECT_EQ(nest.error().message,
            "'beam' of 250 x 30 mm does not fit on a sheet of 200 x 100 mm with a margin of 5 mm");
}

TEST(Nesting, grain_permits_half_turns_only) {
  const std::vector<NestShape> shapes = {{.name = "slat", .outlines = {box_ring(90, 10)}, .quantity = 5}};
  const NestOptions options{.sheet = at_mm(100, 100), .rotations = 2};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value());
  for (const NestPlacement& placement : nest->sheets.front().placements) {
    EXPECT_TRUE(placement.degrees == 0 || placement.degrees == 180);
  }
}

// Corners beyond a bound are omitted, and the shape is grown instead.
TEST(Nesting, shapes_of_very_many_corners_keep_their_distance) {
  std::mt19937_64 random(test::seed());
  const std::vector<NestShape> shapes = {{.name = "burr", .outlines = {star_ring(random, 20, 1000)}, .quantity = 3}};
  const NestOptions options{.sheet = at_mm(260, 200), .gap = to_nanometres(Mm(1)), .rotations = 2, .rounds = 4};
  const auto nest = nest_on_sheets(shapes, options, {});
  ASSERT_TRUE(nest.has_value()) << nest.error().message;
  EXPECT_EQ(expect_apart(shapes, options, *nest), 3);
}

TEST(Nesting, random_shapes_keep_their_distance) {
  std::mt19937_64 random(test::seed());
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<NestShape> shapes;
    for (int i = 0; i < 3; ++i) {
      shapes.push_back({.name = "star",
                        .outlines = {star_ring(random, 20 + 10 * i, 5 + static_cast<int>(random() % 12))},
                        .quantity = 4});
    }
    const NestOptions options{.sheet = at_mm(260, 200),
                              .gap = to_nanometres(Mm(0.01 + trial)),
                              .margin = to_nanometres(Mm(3)),
                              .rotations = trial % 2 == 0 ? 4U : 7U,
                              .rounds = 12};
    const auto nest = nest_on_sheets(shapes, options, {});
    ASSERT_TRUE(nest.has_value()) << nest.error().message;
    EXPECT_EQ(expect_apart(shapes, options, *nest), 12);
    const auto again = nest_on_sheets(shapes, options, {});
    ASSERT_TRUE(again.has_value());
    ASSERT_EQ(nest->sheets.size(), again->sheets.size());
    for (std::size_t i = 0; i < nest->sheets.size(); ++i) {
      const auto& a = nest->sheets[i].placements;
      const auto& b = again->sheets[i].placements;
      EXPECT_TRUE(std::ranges::equal(a, b, [](const NestPlacement& p, const NestPlacement& q) {
        return p.shape == q.shape && p.degrees == q.degrees && p.offset == q.offset;
      }));
    }
  }
}

}  // namespace
}  // namespace passo
