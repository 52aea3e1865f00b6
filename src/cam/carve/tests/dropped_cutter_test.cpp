#include "passo/carve/dropped_cutter.hpp"

#include <algorithm>
#include <random>

#include "gouge_oracle.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using namespace test;

Cutter parsed(const OracleCutter& cutter) {
  return *parse_cutter(cutter.text);
}

TEST(CutterTable, has_no_patch_above_the_cutter) {
  for (const OracleCutter& cutter : oracle_cutters()) {
    const double px = 0.17;
    const double py = 0.23;
    const CutterTable table(parsed(cutter), Mm(px), Mm(py));
    for (double y = 0; y < cutter.radius; y += 0.0113) {
      for (double x = 0; std::hypot(x, y) < cutter.radius; x += 0.0113) {
        const auto i = static_cast<std::size_t>(x / px);
        const auto j = static_cast<std::size_t>(y / py);
        const double s = x / px - static_cast<double>(i);
        const double t = y / py - static_cast<double>(j);
        const double patch = (1 - t) * ((1 - s) * table.at(i, j) + s * table.at(i + 1, j)) +
                             t * ((1 - s) * table.at(i, j + 1) + s * table.at(i + 1, j + 1));
        ASSERT_LE(patch, cutter.height(std::hypot(x, y)) + 1e-9) << cutter.text << " at " << x << ", " << y;
      }
    }
  }
}

TEST(DroppedCutter, cuts_nothing_of_a_random_surface_at_any_place_between_nodes) {
  std::mt19937_64 random(seed());
  std::uniform_real_distribution<double> share(0, 1);
  for (const OracleCutter& cutter : oracle_cutters()) {
    for (int surface = 0; surface < 4; ++surface) {
      const HeightGrid grid = random_surface(random, 9 + 5 * static_cast<std::size_t>(surface), 11,
                                             Mm(0.1 + 0.4 * share(random)), Mm(0.1 + 0.4 * share(random)));
      const TipMap tips = drop_everywhere(DroppedCutter(grid, parsed(cutter), -4), 3, 2, 1);
      for (int trial = 0; trial < 60; ++trial) {
        const double column = -3 + (static_cast<double>(grid.columns) + 4.999) * share(random);
        const double row = -2 + (static_cast<double>(grid.rows) + 2.999) * share(random);
        const auto i = static_cast<std::ptrdiff_t>(std::floor(column));
        const auto j = static_cast<std::ptrdiff_t>(std::floor(row));
        const double s = column - static_cast<double>(i);
        const double t = row - static_cast<double>(j);
        const double tip = (1 - t) * ((1 - s) * tips.at(i, j) + s * tips.at(i + 1, j)) +
                           t * ((1 - s) * tips.at(i, j + 1) + s * tips.at(i + 1, j + 1));
        ASSERT_GE(tip, least_tip(grid, cutter, column * grid.pitch_x.value(), row * grid.pitch_y.value(), 9) - 1e-5)
            << cutter.text << ", surface " << surface << " at " << column << ", " << row;
      }
    }
  }
}

// Too high by no more than the cutter's shape bends within a cell.
TEST(DroppedCutter, comes_close_to_a_smooth_surface) {
  HeightGrid grid{.columns = 60, .rows = 50, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x)
      grid.heights.push_back(grid_height(Mm(-2 + 0.5 * std::sin(x * 0.1) * std::cos(y * 0.12))));
  }
  for (const OracleCutter& cutter : oracle_cutters()) {
    const bool is_round = cutter.text[0] == 'b' && cutter.text[1] == 'a';
    if (!is_round && cutter.text[0] != 'f') continue;
    const TipMap tips = drop_everywhere(DroppedCutter(grid, parsed(cutter), -4), 0, 0, 1);
    // A flat end is bounded by its rim, which the table takes for up to a cell wider.
    const double most = is_round ? 3 * 0.01 / 4 / 1.5 : 0.1 * 1.5;
    for (std::ptrdiff_t j = 16; j < 34; j += 5) {
      for (std::ptrdiff_t i = 16; i < 44; i += 5) {
        const double exact = least_tip(grid, cutter, static_cast<double>(i) * 0.1, static_cast<double>(j) * 0.1, 6);
        EXPECT_LT(tips.at(i, j), exact + most) << cutter.text;
      }
    }
  }
}

TEST(DroppedCutter, is_exact_over_a_flat_and_where_a_peak_stands) {
  HeightGrid grid{.columns = 41, .rows = 41, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  grid.heights.assign(41 * 41, grid_height(Mm(-3)));
  for (const OracleCutter& cutter : oracle_cutters()) {
    grid.heights[20 * 41 + 20] = grid_height(Mm(-3));
    const TipMap flat = drop_everywhere(DroppedCutter(grid, parsed(cutter), -3), 0, 0, 1);
    const double bend = 0.0004;  // what the table allows for rounding, of the steepest cutter
    for (const float height : flat.heights) EXPECT_NEAR(height, -3, bend) << cutter.text;
    grid.heights[20 * 41 + 20] = 0;
    const TipMap peak = drop_everywhere(DroppedCutter(grid, parsed(cutter), -3), 0, 0, 1);
    // The place of the work does not depend on the cutter: its highest tip is above the peak.
    EXPECT_NEAR(peak.at(20, 20), 0, bend) << cutter.text;
    for (std::ptrdiff_t i = 0; i < 41; ++i) {
      EXPECT_LE(peak.at(i, 20), peak.at(20, 20)) << cutter.text;
      EXPECT_EQ(peak.at(i, 20), peak.at(40 - i, 20)) << cutter.text;
      EXPECT_EQ(peak.at(i, 20), peak.at(20, i)) << cutter.text;
    }
  }
}

// Blocks that cannot touch are skipped, and wide rows are computed in chunks: the plain sum over the table says the
// same.
TEST(DroppedCutter, skips_nothing_that_counts) {
  std::mt19937_64 random(seed());
  for (const Mm pitch : {Mm(0.02), Mm(0.05), Mm(0.3)}) {
    const HeightGrid grid = random_surface(random, 131, 37, pitch, pitch);
    for (const OracleCutter& cutter : oracle_cutters()) {
      const DroppedCutter dropped(grid, parsed(cutter), -4);
      const CutterTable& table = dropped.table();
      DroppedCutter::Scratch scratch;
      std::vector<float> row(150);
      for (const std::ptrdiff_t y : {-3, 0, 17, 36, 40}) {
        dropped.heights(y, -7, row, scratch);
        for (std::size_t i = 0; i < row.size(); i += 7) {
          const std::ptrdiff_t x = static_cast<std::ptrdiff_t>(i) - 7;
          float plain = -4;
          for (std::ptrdiff_t v = 0; v < 37; ++v) {
            for (std::ptrdiff_t u = 0; u < 131; ++u) {
              const auto away_x = static_cast<std::size_t>(std::abs(u - x));
              const auto away_y = static_cast<std::size_t>(std::abs(v - y));
              if (away_x > table.reach_x() || away_y > table.reach_y()) continue;
              plain = std::max(
                  plain, grid.at(static_cast<std::size_t>(u), static_cast<std::size_t>(v)) - table.at(away_x, away_y));
            }
          }
          ASSERT_EQ(row[i], plain) << cutter.text << " at " << x << ", " << y;
        }
      }
    }
  }
}

// The same as on a grid that was made larger by hand.
TEST(DroppedCutter, a_surface_that_goes_on_is_one_with_wider_edges) {
  std::mt19937_64 random(seed());
  const HeightGrid grid = random_surface(random, 37, 9, Mm(0.3), Mm(0.4));
  constexpr std::ptrdiff_t wide = 60;
  HeightGrid wider = grid.with_rim(wide, wide, 0);
  const auto node = [&](std::ptrdiff_t column, std::ptrdiff_t row) -> float& {
    return wider
        .heights[static_cast<std::size_t>(row + wide) * wider.columns + static_cast<std::size_t>(column + wide)];
  };
  const auto falls_on = [](float edge, float inside) { return std::max(-4.0F, std::min(edge, 2 * edge - inside)); };
  for (std::ptrdiff_t k = 1; k <= wide; ++k) {
    for (std::ptrdiff_t column = 0; column < 37; ++column) {
      node(column, -k) = falls_on(node(column, 0), node(column, std::min<std::ptrdiff_t>(k, 8)));
      node(column, 8 + k) = falls_on(node(column, 8), node(column, std::max<std::ptrdiff_t>(8 - k, 0)));
    }
  }
  for (std::ptrdiff_t row = -wide; row < 9 + wide; ++row) {
    for (std::ptrdiff_t k = 1; k <= wide; ++k) {
      node(-k, row) = falls_on(node(0, row), node(std::min<std::ptrdiff_t>(k, 36), row));
      node(36 + k, row) = falls_on(node(36, row), node(std::max<std::ptrdiff_t>(36 - k, 0), row));
    }
  }
  for (const OracleCutter& cutter : oracle_cutters()) {
    const DroppedCutter dropped(grid, parsed(cutter), -4, CutterTable::Kind::below, BesideGrid::goes_on);
    const TipMap goes_on = drop_everywhere(dropped, 50, 50, 1);
    const TipMap made = drop_everywhere(DroppedCutter(wider, parsed(cutter), -4), 0, 0, 1);
    for (std::ptrdiff_t y = -50; y < 59; ++y) {
      for (std::ptrdiff_t x = -50; x < 87; ++x) {
        ASSERT_EQ(goes_on.at(x, y), made.at(x + wide, y + wide)) << cutter.text << " at " << x << ", " << y;
      }
    }
  }
}

TEST(DroppedCutter, is_the_same_for_any_number_of_threads) {
  std::mt19937_64 random(seed());
  const HeightGrid grid = random_surface(random, 70, 60, Mm(0.1), Mm(0.1));
  const DroppedCutter cutter(grid, Cutter::ball(Mm(3)), -4);
  EXPECT_EQ(drop_everywhere(cutter, 5, 5, 1).heights, drop_everywhere(cutter, 5, 5, 7).heights);
}

}  // namespace
}  // namespace passo
