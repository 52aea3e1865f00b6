#include "passo/cam/region.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

DrawnPoint at_mm(double x, double y) {
  return {to_nanometres(Mm(x)), to_nanometres(Mm(y))};
}
DrawnRing box_mm(double x0, double y0, double x1, double y1) {
  return rectangle({at_mm(x0, y0), at_mm(x1, y1)});
}
constexpr Nanometres one_mm{1'000'000};

TEST(Region, unites_subtracts_and_shares_squares_exactly) {
  const Region a = filled({box_mm(0, 0, 10, 10)});
  const Region b = filled({box_mm(5, 5, 15, 15)});
  EXPECT_EQ(area_mm2(united(a, b)), 175);
  EXPECT_EQ(area_mm2(united({a, b, filled({box_mm(20, 0, 21, 1)})})), 176);
  EXPECT_EQ(area_mm2(subtracted(a, b)), 75);
  EXPECT_EQ(area_mm2(common(a, b)), 25);
  EXPECT_TRUE(common(a, filled({box_mm(11, 0, 12, 1)})).empty());
}

TEST(Region, fills_rings_whichever_way_they_turn) {
  DrawnRing clockwise = box_mm(5, 5, 15, 15);
  std::ranges::reverse(clockwise);
  EXPECT_EQ(area_mm2(filled({box_mm(0, 0, 10, 10), clockwise})), 175);
  EXPECT_TRUE(filled({{at_mm(0, 0), at_mm(1, 1)}, {}}).empty());
}

TEST(Region, has_holes_clockwise_and_is_to_the_left_of_every_ring) {
  const Region frame = subtracted(filled({box_mm(0, 0, 10, 10)}), filled({box_mm(2, 2, 4, 4)}));
  ASSERT_EQ(frame.rings.size(), 2U);
  EXPECT_EQ(area_mm2(frame), 96);
  EXPECT_EQ(area_mm2(frame.rings[0]) + area_mm2(frame.rings[1]), 96);
  EXPECT_LT(std::min(area_mm2(frame.rings[0]), area_mm2(frame.rings[1])), 0);
}

TEST(Region, grows_by_round_corners_within_the_tolerance_and_never_too_far) {
  const Region square = filled({box_mm(0, 0, 10, 10)});
  const double exact = 100 + 40 + std::numbers::pi;
  for (const std::int64_t tolerance : {10'000, 1'000, 100}) {
    const double grown_to = area_mm2(grown(square, one_mm, {tolerance}));
    EXPECT_LE(grown_to, exact);
    // The chords of the corners, in all 2 pi mm long, lie at most the tolerance inside.
    EXPECT_GE(grown_to, exact - 2 * std::numbers::pi * static_cast<double>(tolerance) / nanometres_per_mm);
  }
  EXPECT_EQ(area_mm2(grown(square, {-1'000'000})), 64);
  EXPECT_TRUE(grown(square, {-5'000'001}).empty());
  EXPECT_EQ(area_mm2(grown(square, {})), 100);
}

// Rings in a board of so many corners are grown apart. Here each hole of a plate, with an island in it, is grown alone
// for comparison: some islands grow onto the plate, some holes close, some break through to the plate's edge.
TEST(Region, grows_rings_in_rings_as_if_each_were_alone) {
  const DrawnRing plate = box_mm(0, 0, 100, 100);
  const auto disc = [](double x, double y, double radius, bool is_hole) {
    DrawnRing ring;
    constexpr int corners = 90;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners * (is_hole ? -1 : 1);
      ring.push_back(at_mm(x + radius * std::cos(angle), y + radius * std::sin(angle)));
    }
    return ring;
  };
  for (const std::int64_t distance : {150'000, -150'000, -400'000}) {
    Region all{{plate}};
    const double whole = area_mm2(grown({{plate}}, {distance}, {1'000}));
    double expected = whole;
    for (int row = 0; row < 12; ++row) {
      for (int column = 0; column < 12; ++column) {
        const double x = 3.2 + 8 * column;
        const double y = 3.3 + 8 * row;
        const double radius = 0.1 + 0.02 * (12 * row + column);
        std::vector<DrawnRing> one = {disc(x, y, radius, true)};
        if (column % 3 != 0) one.push_back(disc(x + 0.3 * radius, y, 0.4 * radius, false));
        Region alone{{plate}};
        for (const DrawnRing& ring : one) {
          alone.rings.push_back(ring);
          all.rings.push_back(ring);
        }
        expected += area_mm2(grown(alone, {distance}, {1'000})) - whole;
      }
    }
    EXPECT_NEAR(area_mm2(grown(all, {distance}, {1'000})), expected, 1e-3);
  }
}

// Discs in rows and columns, which overlap in different ways, with so many corners that the work is done in strips.
Region many_discs(double radius_mm) {
  std::vector<DrawnRing> middles;
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 8; ++k) middles.push_back({at_mm(i + 0.1 * (k % 3), k + 0.07 * (i % 5))});
  }
  return swept(middles, to_nanometres(Mm(radius_mm)), {500});
}

TEST(Region, is_the_same_in_strips) {
  const Region discs = many_discs(0.6);
  const Region others = grown(many_discs(0.45), {100'000}, {500});
  const Region both = common(discs, others);
  EXPECT_NEAR(area_mm2(united(discs, others)), area_mm2(discs) + area_mm2(others) - area_mm2(both), 1e-5);
  EXPECT_NEAR(area_mm2(subtracted(discs, others)), area_mm2(discs) - area_mm2(both), 1e-5);
  const Region larger = grown(discs, {50'000}, {500});
  EXPECT_NEAR(area_mm2(common(larger, discs)), area_mm2(discs), 1e-5);
  EXPECT_EQ(parts_of(discs).size(), 1U);

  // Beside what is combined in a place on its own.
  for (int i = 0; i < 40; i += 3) {
    const Region window = filled({box_mm(i - 0.4, 1.2, i + 0.9, 3.1)});
    Region near;
    for (const Region* one : {&discs, &larger}) near = united(near, common(*one, window));
    EXPECT_NEAR(area_mm2(near), area_mm2(common(larger, window)), 1e-5) << i;
  }
}

// Cells of a hatched area, each on its own, on seams and between them.
TEST(Region, holes_on_seams_stay_whole) {
  std::vector<DrawnRing> bars;
  for (int i = 0; i <= 60; ++i) {
    bars.push_back(box_mm(0, i, 60.2, i + 0.2));
    bars.push_back(box_mm(i, 0, i + 0.2, 60.2));
  }
  const Region hatch = filled(bars);
  EXPECT_EQ(hatch.rings.size(), 3'601U);
  EXPECT_NEAR(area_mm2(hatch), 60.2 * 60.2 - 3'600 * 0.8 * 0.8, 1e-6);
  const Region narrow = grown(hatch, {-50'000});
  EXPECT_EQ(narrow.rings.size(), 3'601U);
  const Region cut = subtracted(hatch, filled({box_mm(-1, 30.1, 61, 30.15)}));
  EXPECT_NEAR(area_mm2(cut), area_mm2(hatch) - 60.2 * 0.05, 1e-6);
  EXPECT_EQ(parts_of(cut).size(), 2U);
}

TEST(Region, grows_holes_inwards) {
  const Region frame = subtracted(filled({box_mm(0, 0, 10, 10)}), filled({box_mm(2, 2, 8, 8)}));
  EXPECT_NEAR(area_mm2(grown(frame, one_mm)), 140 + std::numbers::pi - 16, 0.01);
  EXPECT_NEAR(area_mm2(grown(frame, {3'000'001})), 100 + 120 + 9 * std::numbers::pi, 0.03);
}

TEST(Region, a_cutters_way_sweeps_a_rounded_strip) {
  const double strip = area_mm2(swept({{at_mm(0, 0), at_mm(10, 0)}}, one_mm));
  EXPECT_LE(strip, 20 + std::numbers::pi);
  EXPECT_GE(strip, 20 + std::numbers::pi - 0.01);
  EXPECT_NEAR(area_mm2(swept({{at_mm(3, 3)}}, one_mm)), std::numbers::pi, 0.01);
  EXPECT_NEAR(area_mm2(swept({{at_mm(0, 0), at_mm(10, 0), at_mm(0, 0)}}, one_mm)), strip, 1e-4);
  EXPECT_TRUE(swept({{at_mm(0, 0), at_mm(10, 0)}}, {}).empty());
}

TEST(Region, keeps_the_pieces_of_ways_that_lie_in_it) {
  const Region frame = subtracted(filled({box_mm(0, 0, 10, 10)}), filled({box_mm(4, 0, 6, 10)}));
  const std::vector<DrawnRing> pieces = ways_within({{at_mm(-5, 5), at_mm(15, 5)}}, frame);
  ASSERT_EQ(pieces.size(), 2U);
  for (const DrawnRing& piece : pieces) EXPECT_EQ(distance_nm(piece.front(), piece.back()), 4e6);
}

TEST(Region, parts_are_an_outer_ring_and_its_holes) {
  const Region frame = subtracted(filled({box_mm(0, 0, 10, 10)}), filled({box_mm(2, 2, 8, 8)}));
  const std::vector<Region> parts = parts_of(united(frame, filled({box_mm(4, 4, 6, 6)})));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(area_mm2(parts[0]), 4);
  EXPECT_EQ(area_mm2(parts[1]), 64);
}

TEST(Region, knows_its_bounds_and_what_is_in_it) {
  const Region frame = subtracted(filled({box_mm(-1, -2, 10, 10)}), filled({box_mm(2, 2, 8, 8)}));
  ASSERT_TRUE(bounds(frame));
  EXPECT_EQ(bounds(frame)->least, at_mm(-1, -2));
  EXPECT_EQ(bounds(frame)->most, at_mm(10, 10));
  EXPECT_FALSE(bounds(Region{}));
  EXPECT_TRUE(contains(frame, at_mm(1, 1)));
  EXPECT_TRUE(contains(frame, at_mm(2, 5)));  // on the rim
  EXPECT_TRUE(contains(frame, at_mm(-1, -2)));
  EXPECT_FALSE(contains(frame, at_mm(5, 5)));
  EXPECT_FALSE(contains(frame, at_mm(11, 5)));
}

TEST(Region, keeps_far_places_within_its_bounds) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  const DrawnRing vast = rectangle({{{-most}, {-most}}, {{most}, {most}}});
  const Region region = united(filled({vast}), filled({box_mm(0, 0, 1, 1)}));
  ASSERT_TRUE(bounds(region));
  EXPECT_EQ(bounds(region)->most.x, farthest_of_region);
  EXPECT_EQ(area_mm2(region), 4e5 * 4e5);
  EXPECT_EQ(bounds(grown(region, {most}))->most.x, farthest_of_region);
}

}  // namespace
}  // namespace passo
