#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "passo/levelling/height_map.hpp"
#include "passo/levelling/levelled_move.hpp"
#include "passo/levelling/map_figures.hpp"

namespace passo {
namespace {

HeightMap plane(double base, double along_x, double along_y) {
  std::vector<double> heights;
  for (const double y : {0.0, 20.0, 30.0}) {
    for (const double x : {0.0, 10.0, 40.0}) heights.push_back(base + along_x * x + along_y * y);
  }
  return HeightMap({0, 10, 40}, {0, 20, 30}, std::move(heights));
}

HeightMap random_map(std::mt19937& random, double roughness) {
  std::uniform_real_distribution<double> gap(1, 9);
  std::normal_distribution<double> height(0, roughness);
  const auto lines = [&] {
    std::vector<double> all{-10 + gap(random)};
    for (std::size_t i = 1 + random() % 6; i > 0; --i) all.push_back(all.back() + gap(random));
    return all;
  };
  std::vector<double> columns = lines();
  std::vector<double> rows = lines();
  std::vector<double> heights;
  for (std::size_t i = 0; i < columns.size() * rows.size(); ++i) heights.push_back(height(random));
  return HeightMap(std::move(columns), std::move(rows), std::move(heights));
}

TEST(HeightMap, is_bilinear_on_the_grid_and_level_beside_it) {
  const HeightMap map({0, 10}, {0, 10}, {0, 1, 2, 7});
  EXPECT_EQ(map.height(0, 0), 0);
  EXPECT_EQ(map.height(10, 0), 1);
  EXPECT_EQ(map.height(0, 10), 2);
  EXPECT_DOUBLE_EQ(map.height(10, 10), 7);
  EXPECT_DOUBLE_EQ(map.height(5, 5), 2.5);
  EXPECT_DOUBLE_EQ(map.height(15, 5), 4);
  EXPECT_DOUBLE_EQ(map.height(5, -3), 0.5);
  EXPECT_DOUBLE_EQ(map.height(99, 99), 7);
  EXPECT_EQ(map.lowest(), 0);
  EXPECT_EQ(map.highest(), 7);
  EXPECT_EQ(map.distance_beside(5, 5), 0);
  EXPECT_DOUBLE_EQ(map.distance_beside(13, 14), 5);
  EXPECT_DOUBLE_EQ(map.lowered_by(2).height(5, 5), 0.5);
}

TEST(HeightMap, its_file_is_read_as_the_same_map) {
  const HeightMap map = plane(-1, 0.01, 0.002);
  Diagnostics diagnostics;
  const auto read = read_height_map("it", text_of(map), diagnostics);
  ASSERT_TRUE(read);
  EXPECT_FALSE(diagnostics.any_error());
  EXPECT_EQ(read->columns(), map.columns());
  EXPECT_EQ(read->rows(), map.rows());
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) EXPECT_NEAR(read->at(column, row), map.at(column, row), 5e-5);
  }
}

TEST(HeightMap, its_figures_find_the_plane) {
  const MapFigures figures = figures_of(plane(0.5, 0.01, -0.02));
  EXPECT_NEAR(figures.rise_x, 0.01, 1e-12);
  EXPECT_NEAR(figures.rise_y, -0.02, 1e-12);
  EXPECT_NEAR(figures.farthest_off_plane, 0, 1e-12);
  EXPECT_NEAR(figures.lowest, -0.1, 1e-12);
  EXPECT_NEAR(figures.highest, 0.9, 1e-12);
  EXPECT_EQ(describe(HeightMap({0, 10}, {0, 10}, {0, 1, 0, 1})),
            "2 x 2 points, X0.000 to 10.000, Y0.000 to 10.000\n"
            "heights 0.000 to 1.000 mm, mean 0.500\n"
            "slope 10.000 mm per 100 mm in X, 0.000 mm per 100 mm in Y; at most 0.000 mm from that plane\n"
            "  ..@@  Y10\n"
            "  ..@@  Y0\n");
}

TEST(LevelledMove, a_straight_move_over_a_plane_is_not_divided) {
  const auto pieces = level_line(plane(0.5, 0.01, -0.02), {1, 2, -1}, {39, 28, -2}, 0.001);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].end.x, 39);
  EXPECT_EQ(pieces[0].end.y, 28);
  EXPECT_NEAR(pieces[0].end.z, -2 + 0.5 + 0.39 - 0.56, 1e-12);
  EXPECT_EQ(pieces[0].part, 1);
}

TEST(LevelledMove, a_move_straight_down_is_one_piece) {
  const auto pieces = level_line(plane(0.5, 0.01, 0), {10, 5, 2}, {10, 5, -3}, 0.001);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(pieces[0].end.z, -3 + 0.6, 1e-12);
}

TEST(LevelledMove, is_divided_at_a_fold_and_where_it_leaves_the_map) {
  const HeightMap fold({0, 10, 20}, {0, 10}, {0, 1, 0, 0, 1, 0});
  const auto pieces = level_line(fold, {-10, 5, 0}, {30, 5, 0}, 0.01);
  ASSERT_EQ(pieces.size(), 4U);
  EXPECT_NEAR(pieces[0].end.x, 0, 0.2);
  EXPECT_NEAR(pieces[1].end.x, 10, 0.2);
  EXPECT_NEAR(pieces[2].end.x, 20, 0.2);
  EXPECT_EQ(pieces[3].end.x, 30);
}

// Any move over any map keeps the tolerance at each of many places, and its pieces are not needlessly many.
TEST(LevelledMove, random_moves_keep_the_tolerance_everywhere) {
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> place(-25, 60);
  std::uniform_real_distribution<double> angle(-13, 13);
  constexpr int samples = 20;
  for (int trial = 0; trial < 400; ++trial) {
    const HeightMap map = random_map(random, trial % 2 == 0 ? 0.2 : 5);
    const double tolerance = trial % 3 == 0 ? 0.1 : 0.003;
    const LevelPoint from{place(random), place(random), place(random)};
    LevelPoint to{place(random), place(random), place(random)};
    const bool is_arc = trial % 4 != 0;
    const double center_x = place(random);
    const double center_y = place(random);
    const double radius = std::hypot(from.x - center_x, from.y - center_y);
    const double start = std::atan2(from.y - center_y, from.x - center_x);
    const double sweep = angle(random);
    if (is_arc) {
      to.x = center_x + radius * std::cos(start + sweep);
      to.y = center_y + radius * std::sin(start + sweep);
    }
    const auto pieces =
        is_arc ? level_arc(map, from, to, center_x, center_y, sweep, tolerance) : level_line(map, from, to, tolerance);
    double part = 0;
    double z = from.z + map.height(from.x, from.y);
    double worst = 0;
    for (const LevelledPiece& piece : pieces) {
      ASSERT_GT(piece.part, part);
      for (int i = 1; i <= samples; ++i) {
        const double share = static_cast<double>(i) / samples;
        const double at = part + (piece.part - part) * share;
        const double x = is_arc ? center_x + radius * std::cos(start + sweep * at) : from.x + (to.x - from.x) * at;
        const double y = is_arc ? center_y + radius * std::sin(start + sweep * at) : from.y + (to.y - from.y) * at;
        const double meant = from.z + (to.z - from.z) * at + map.height(x, y);
        worst = std::max(worst, std::abs(z + (piece.end.z - z) * share - meant));
        if (i < samples) continue;
        ASSERT_NEAR(piece.end.x, x, 1e-9);
        ASSERT_NEAR(piece.end.y, y, 1e-9);
      }
      part = piece.part;
      z = piece.end.z;
    }
    ASSERT_EQ(part, 1);
    EXPECT_LE(worst, tolerance * (1 + 1e-9)) << "trial " << trial;
    EXPECT_EQ(pieces.back().end.x, to.x);
    EXPECT_EQ(pieces.back().end.y, to.y);
  }
}

TEST(LevelledMove, an_arc_over_a_level_map_is_one_arc) {
  const auto pieces = level_arc(plane(0.3, 0, 0), {10, 0, 0}, {10, 0, -4}, 5, 0, 4 * std::numbers::pi, 0.001);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(pieces[0].end.z, -3.7, 1e-12);
}

}  // namespace
}  // namespace passo
