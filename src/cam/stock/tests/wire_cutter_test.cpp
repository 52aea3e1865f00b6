// Foam that a hot wire cuts: cell by cell against distances that are found by trying, its pieces, its surface, and a
// target.
#include "passo/stock/wire_cutter.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/stock/foam_comparison.hpp"
#include "passo/stock/foam_skin.hpp"

namespace passo {
namespace {

struct FaceSpot {
  double x = 0;
  double y = 0;
};

Point ends_at(FaceSpot left, FaceSpot right) {
  Point point;
  point[Axis::x] = left.x;
  point[Axis::y] = left.y;
  point[Axis::u] = right.x;
  point[Axis::v] = right.y;
  return point;
}

FoamBlock foam_of(const StockBlock& block, double cell, std::size_t slices) {
  return *FoamBlock::create(block, Mm(cell), slices);
}

using Kerf = std::function<double(double speed, double time)>;

WireCutterOptions four_axes(double span, Kerf kerf, unsigned threads = 1) {
  return {.has_four_axes = true, .span = span, .kerf = std::move(kerf), .threads = threads};
}
double one_mm(double /*speed*/, double /*time*/) {
  return 1;
}

// Cuts around two squares, whose middles are at 15 15: one at the left face, one at the right.
FoamBlock pyramid(double left, double right, const Kerf& kerf, std::vector<WireCut>& cuts, double cell = 0.1) {
  const std::size_t slices = FoamBlock::needed_slices(std::abs(right - left) * std::numbers::sqrt2 / 2, Mm(cell), 1);
  FoamBlock foam = foam_of({{0, 0, 0}, {30, 30, 40}}, cell, slices);
  WireCutter cutter(foam, four_axes(40, kerf), [&](const WireCut& cut) { cuts.push_back(cut); });
  const auto corner = [&](int i) {
    const double sx = i == 0 || i == 3 ? -0.5 : 0.5;
    const double sy = i < 2 ? -0.5 : 0.5;
    return ends_at({15 + sx * left, 15 + sy * left}, {15 + sx * right, 15 + sy * right});
  };
  Point here = ends_at({-2, 15 - left / 2}, {-2, 15 - right / 2});
  for (const int i : {0, 1, 2, 3, 0}) {
    const Point next = corner(i);
    cutter.cut(Curve::line(here, next), {}, {.line = cuts.empty() ? 1U : 2U, .time = Seconds(10)});
    here = next;
  }
  cutter.finish();
  return foam;
}

TEST(WireCutter, finds_the_distance_from_all_that_was_melted) {
  std::mt19937_64 random(test::seed());
  std::uniform_real_distribution<double> place(-4, 24);
  FoamBlock foam = foam_of({{0, 0, 10}, {20, 15, 50}}, 0.5, 5);
  WireCutter cutter(foam, four_axes(60, [](double speed, double) { return 2 / (1 + speed); }), {});
  struct WireWay {
    Point from;
    Point to;
    double time;
  };
  std::vector<WireWay> ways;
  Point here = ends_at({place(random), place(random)}, {place(random), place(random)});
  for (int i = 0; i < 12; ++i) {
    const Point next = i == 5 ? here : ends_at({place(random), place(random)}, {place(random), place(random)});
    ways.push_back({here, next, 3.0 + i});
    cutter.cut(Curve::line(here, next), {}, {.time = Seconds(ways.back().time)});
    here = next;
  }
  cutter.finish();
  for (std::size_t slice = 0; slice < foam.slices(); ++slice) {
    const double share = foam.z_of(slice) / 60;
    const auto at = [&](const Point& ends) {
      return Vector3{ends[Axis::x] * (1 - share) + ends[Axis::u] * share,
                     ends[Axis::y] * (1 - share) + ends[Axis::v] * share, 0};
    };
    for (std::size_t row = 0; row < foam.rows(); ++row) {
      for (std::size_t column = 0; column < foam.columns(); ++column) {
        double expected = double{foam.farthest()};
        for (const WireWay& way : ways) {
          const double kerf = 2 / (1 + length(at(way.to) - at(way.from)) / way.time);
          const Vector3 cell{foam.x_of(column), foam.y_of(row), 0};
          expected = std::min(expected, length(nearest_of(at(way.from), at(way.to), cell) - cell) - kerf / 2);
        }
        ASSERT_NEAR(foam.clearance(row, slice)[column], expected, 1e-5) << column << ", " << row << ", " << slice;
      }
    }
  }
}

TEST(WireCutter, of_two_axes_melts_a_slot_as_wide_as_its_kerf) {
  FoamBlock foam = foam_of({{0, 0, 0}, {20, 10, 50}}, 0.1, 2);
  double melted = 0;
  WireCutter cutter(foam, {.kerf = one_mm}, [&](const WireCut& cut) { melted += cut.volume; });
  cutter.cut(Curve::line(ends_at({-5, 4}, {}), ends_at({25, 4}, {})), {}, {.time = Seconds(10)});
  cutter.finish();
  EXPECT_NEAR(melted, 20 * 1 * 50, 20 * 0.1 * 50);
  EXPECT_NEAR(foam.volume(), 20 * 9 * 50, 20 * 0.002 * 50);
  const FoamPieces pieces = pieces_of(foam);
  ASSERT_EQ(pieces.pieces.size(), 2U);
  EXPECT_NEAR(pieces.volume(0, foam), 20 * 5.5 * 50, 20 * 0.1 * 50);
  EXPECT_NEAR(pieces.volume(1, foam), 20 * 3.5 * 50, 20 * 0.1 * 50);
  EXPECT_TRUE(pieces.pieces[0].at_side);
}

TEST(WireCutter, of_four_axes_cuts_what_lies_between_two_profiles) {
  std::vector<WireCut> cuts;
  const FoamBlock foam = pyramid(8, 20, one_mm, cuts);
  const FoamPieces pieces = pieces_of(foam);
  ASSERT_EQ(pieces.pieces.size(), 2U);
  // The wire takes half of its kerf off each side.
  EXPECT_NEAR(pieces.volume(1, foam), (7 * 7 + 7 * 19 + 19 * 19) * 40 / 3.0, 60);
  EXPECT_FALSE(pieces.pieces[1].at_side);
}

TEST(WireCutter, melts_more_where_the_wire_is_slower) {
  std::vector<WireCut> cuts;
  // 0.8 and 2 mm/s at the two faces.
  const FoamBlock foam = pyramid(
      8, 20, [](double speed, double) { return 1 / speed; }, cuts);
  EXPECT_NEAR(cuts[1].most_kerf, 1 / 0.8, 1e-9);
  EXPECT_NEAR(cuts[1].least_kerf, 1 / 2.0, 1e-9);
  // Across the middle of the lower side, which lies at Y 11 on the left and at Y 5 on the right.
  EXPECT_NEAR(foam.clearance(120, 0)[150], 12.05 - 11 - 0.625, 1e-5 + 0.4);
  EXPECT_NEAR(foam.clearance(112, 0)[150], std::min(double{foam.farthest()}, 11.25 - 11 - 0.625), 1e-5);
  EXPECT_NEAR(foam.clearance(52, foam.slices() - 1)[150], 5.25 - 5 - 0.25, 1e-5);
}

TEST(WireCutter, gives_the_same_bytes_for_any_number_of_threads) {
  const auto cut = [&](unsigned threads) {
    std::mt19937_64 random(test::seed());
    std::uniform_real_distribution<double> place(-4, 34);
    FoamBlock foam = foam_of({{0, 0, 0}, {30, 30, 40}}, 0.2, 7);
    double volume = 0;
    WireCutter cutter(foam, four_axes(40, one_mm, threads), [&](const WireCut& done) { volume += done.volume; });
    Point here = ends_at({0, 0}, {0, 0});
    for (int i = 0; i < 40; ++i) {
      const Point next = ends_at({place(random), place(random)}, {place(random), place(random)});
      cutter.cut(Curve::line(here, next), {}, {.rapid = i % 9 == 0, .time = Seconds(i % 4)});
      here = next;
    }
    cutter.finish();
    std::vector<float> cells(foam.clearance(0, 0), foam.clearance(0, 0) + 7 * foam.rows() * foam.columns());
    cells.push_back(static_cast<float>(volume));
    return cells;
  };
  const std::vector<float> one = cut(1);
  EXPECT_EQ(one, cut(2));
  EXPECT_EQ(one, cut(5));
}

// A slot that leans goes no farther between two slices than it is wide: else foam would hang together through it.
TEST(FoamPieces, fall_apart_where_the_wire_leans) {
  std::vector<WireCut> cuts;
  const FoamBlock foam = pyramid(
      2, 26, [](double, double) { return 0.5; }, cuts, 0.5);
  EXPECT_EQ(pieces_of(foam).pieces.size(), 2U);
}

TEST(FoamSkin, is_closed_and_holds_the_foam) {
  std::vector<WireCut> cuts;
  const FoamBlock foam = pyramid(8, 20, one_mm, cuts, 0.5);
  for (const std::size_t step : {1U, 2U}) {  // of two, the slot is a cell wide: the body is closed, but coarse
    std::map<std::array<double, 6>, int> edges;
    double volume = 0;
    foam_skin(foam, step, [&](const SkinTriangle& triangle) {
      const auto& [a, b, c] = triangle.corners;
      volume += dot(a, cross(b, c)) / 6;
      for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}}) {
        const bool is_forward = std::tie(from.x, from.y, from.z) < std::tie(to.x, to.y, to.z);
        const Vector3& low = is_forward ? from : to;
        const Vector3& high = is_forward ? to : from;
        edges[{low.x, low.y, low.z, high.x, high.y, high.z}] += is_forward ? 1 : -1;
      }
    });
    std::size_t open = 0;
    for (const auto& [edge, times] : edges) open += times != 0 ? 1 : 0;
    EXPECT_EQ(open, 0U) << "of " << edges.size();
    EXPECT_NEAR(volume, foam.volume(), foam.volume() * (step == 1 ? 0.001 : 0.03)) << step;
  }
}

// A body between two squares, closed.
std::vector<BodyTriangle> pyramid_body(double left, double right) {
  const auto corner = [&](int i, double size, double z) {
    const double sx = i == 0 || i == 3 ? -0.5 : 0.5;
    const double sy = i < 2 ? -0.5 : 0.5;
    return Vector3{15 + sx * size, 15 + sy * size, z};
  };
  std::vector<BodyTriangle> body;
  for (int i = 0; i < 4; ++i) {
    const int k = (i + 1) % 4;
    body.push_back({corner(i, left, 0), corner(k, left, 0), corner(k, right, 40)});
    body.push_back({corner(i, left, 0), corner(k, right, 40), corner(i, right, 40)});
  }
  body.push_back({corner(0, left, 0), corner(2, left, 0), corner(1, left, 0)});
  body.push_back({corner(0, left, 0), corner(3, left, 0), corner(2, left, 0)});
  body.push_back({corner(0, right, 40), corner(1, right, 40), corner(2, right, 40)});
  body.push_back({corner(0, right, 40), corner(2, right, 40), corner(3, right, 40)});
  return body;
}

TEST(FoamComparison, tells_what_is_left_and_what_is_melted_out) {
  std::vector<WireCut> cuts;
  const FoamBlock foam = pyramid(8, 20, one_mm, cuts, 0.2);
  const FoamPieces pieces = pieces_of(foam);
  const FoamDifference same = compare_foam(foam, pieces, pyramid_body(7, 19), Mm(0.02));
  EXPECT_EQ(same.sides.left.cells, 0U);
  EXPECT_EQ(same.sides.gouge.cells, 0U);

  const FoamDifference larger = compare_foam(foam, pieces, pyramid_body(7.8, 19.8), Mm(0.02));
  EXPECT_EQ(larger.sides.left.cells, 0U);
  EXPECT_NEAR(larger.sides.gouge.largest, 0.4, 0.06);
  EXPECT_NEAR(larger.sides.gouge.volume, (7.8 * 7.8 + 7.8 * 19.8 + 19.8 * 19.8 - 49 - 7 * 19 - 361) * 40 / 3, 150);

  const FoamDifference smaller = compare_foam(foam, pieces, pyramid_body(6, 18), Mm(0.02));
  EXPECT_EQ(smaller.sides.gouge.cells, 0U);
  EXPECT_NEAR(smaller.sides.left.largest, std::sqrt(0.5), 0.12);  // at its corners
}

}  // namespace
}  // namespace passo
