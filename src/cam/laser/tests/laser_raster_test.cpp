// Pictures by lines. The oracle reads the program with beam_reader.hpp, and accumulates what reaches each cell.
#include "passo/laser/laser_raster.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "beam_reader.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/laser/burned_picture.hpp"

namespace passo {
namespace {

using test::BeamMove;
using test::BeamProgram;

LevelPicture picture_of(std::size_t columns, std::size_t rows, const auto& level) {
  LevelPicture picture{columns, rows, {}, "16 bit grey"};
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) picture.levels.push_back(static_cast<std::uint16_t>(level(x, y)));
  }
  return picture;
}

std::string program_of(const BeamCells& cells, const RasterMoves& moves, LaserProgramOptions options = {}) {
  LaserProgram program(std::move(options));
  burn_raster(program, cells, moves);
  return program.finish();
}

// S times mm in each cell of a grid from `origin`, by cutting each move at the edges of the cells.
std::vector<double> energy_in(const BeamProgram& program, const RasterMoves& moves, std::size_t columns,
                              std::size_t rows) {
  const double pitch = to_mm(moves.line).value();
  const double x0 = to_mm(moves.origin.x).value();
  const double y0 = to_mm(moves.origin.y).value();
  std::vector<double> energy(columns * rows);
  for (const BeamMove& move : program.moves) {
    if (move.s == 0) continue;
    const bool is_upright = move.x0 == move.x;
    EXPECT_TRUE(is_upright || move.y0 == move.y) << "a slanted line";
    const double from =
        is_upright ? (std::min(move.y0, move.y) - y0) / pitch : (std::min(move.x0, move.x) - x0) / pitch;
    const double to = is_upright ? (std::max(move.y0, move.y) - y0) / pitch : (std::max(move.x0, move.x) - x0) / pitch;
    const double across = is_upright ? (move.x - x0) / pitch : (move.y - y0) / pitch;
    EXPECT_NEAR(across - std::floor(across), 0.5, 1e-3) << "not along the middle of the cells";
    for (auto k = static_cast<std::size_t>(from + 1e-6); static_cast<double>(k) < to - 1e-6; ++k) {
      const double length = std::min(to, static_cast<double>(k + 1)) - std::max(from, static_cast<double>(k));
      const auto line = static_cast<std::size_t>(across);
      const std::size_t column = is_upright ? line : k;
      const std::size_t row = is_upright ? k : line;
      if (column >= columns || row >= rows) {
        ADD_FAILURE() << "burns beside the picture";
        return energy;
      }
      energy[row * columns + column] += move.s * length * pitch;
    }
  }
  return energy;
}

// Each burned move lies in a sequence at one feed, along one line, that begins and ends `overscan` mm away with the
// beam off.
void expect_full_speed(const BeamProgram& program, double overscan) {
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    if (program.moves[i].s == 0) continue;
    for (const int step : {-1, 1}) {
      double way = 0;
      for (std::size_t k = i + static_cast<std::size_t>(step); k < program.moves.size();
           k += static_cast<std::size_t>(step)) {
        const BeamMove& move = program.moves[k];
        const double cross = (program.moves[i].x - program.moves[i].x0) * (move.y - move.y0) -
                             (program.moves[i].y - program.moves[i].y0) * (move.x - move.x0);
        if (move.motion == 0 || move.f != program.moves[i].f || std::abs(cross) > 1e-9) break;
        way += std::hypot(move.x - move.x0, move.y - move.y0);
      }
      ASSERT_GE(way, overscan - 1e-6) << "move " << i << (step < 0 ? " begins" : " ends") << " too slowly";
    }
  }
}

TEST(LaserRaster, gives_each_cell_its_power_at_full_speed) {
  const std::uint64_t seed = test::seed();
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    std::mt19937_64 random(seed + trial);
    const auto draw = [&](std::size_t least, std::size_t most) { return least + random() % (most - least + 1); };
    const std::size_t columns = draw(1, 40);
    const std::size_t rows = draw(1, 30);
    const std::size_t fine = draw(1, 3);  // pixels per cell and side
    const bool has_gaps = draw(0, 1) == 1;
    std::vector<bool> is_blank(columns * rows);
    for (std::size_t i = 0; i < is_blank.size(); ++i) is_blank[i] = has_gaps && (i / 9) % 3 != 0;
    const LevelPicture picture =
        picture_of(columns * fine, rows * fine, [&](std::size_t x, std::size_t y) -> std::size_t {
          return is_blank[y / fine * columns + x / fine] ? 65'535 : draw(0, 65'535);
        });
    ToneOptions tones;
    tones.most_s = static_cast<std::uint32_t>(draw(10, 2000));
    tones.most_percent = static_cast<double>(draw(20, 100));
    tones.least_percent = static_cast<double>(draw(0, 20));
    tones.gamma = 0.5 + static_cast<double>(draw(0, 20)) / 10;
    tones.invert = draw(0, 3) == 0;
    tones.mirror_x = draw(0, 1) == 1;
    tones.mirror_y = draw(0, 1) == 1;
    RasterMoves moves;
    moves.origin = {{static_cast<std::int64_t>(draw(0, 50)) * 1'000'000}, {-7'000'000}};
    moves.line = {static_cast<std::int64_t>(draw(50, 900)) * 1000};
    moves.is_along_y = draw(0, 1) == 1;
    moves.is_one_way = draw(0, 1) == 1;
    moves.feed = {static_cast<std::int64_t>(draw(100, 9000)) * 1'000'000};
    const double acceleration = static_cast<double>(draw(100, 3000));
    moves.overscan = overscan_for(moves.feed, MmPerSecond2(acceleration));

    const BeamProgram program = test::read_beam(program_of(cells_of(picture, columns, rows, tones), moves));
    ASSERT_TRUE(program.faults.empty()) << program.faults.front() << ", trial " << trial;
    const std::vector<double> energy = energy_in(program, moves, columns, rows);
    const double pitch = to_mm(moves.line).value();
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t x = tones.mirror_x ? columns - 1 - column : column;
        const std::size_t y = tones.mirror_y ? row : rows - 1 - row;  // in the picture, downwards
        double sum = 0;
        for (std::size_t j = 0; j < fine; ++j) {
          for (std::size_t i = 0; i < fine; ++i) sum += picture.levels[(y * fine + j) * columns * fine + x * fine + i];
        }
        const double brightness = sum / static_cast<double>(fine * fine) / 65'535;
        const double dark = tones.invert ? brightness : 1 - brightness;
        const double power = dark <= 1e-12 ? 0
                                           : tones.least_percent + (tones.most_percent - tones.least_percent) *
                                                                       std::pow(dark, tones.gamma);
        const double burned = energy[row * columns + column] / pitch;
        ASSERT_NEAR(burned, power / 100 * tones.most_s, 0.5 + 1e-3) << column << ", " << row << ", trial " << trial;
      }
    }
    const double speed = to_mm(moves.feed).value() / 60;
    expect_full_speed(program, speed * speed / 2 / acceleration);
  }
}

TEST(LaserRaster, leaves_white_unburned_and_black_at_full_power_at_any_size) {
  for (const std::uint32_t level : {0U, 65'535U}) {
    const LevelPicture plain = picture_of(7, 5, [&](auto, auto) { return level; });
    for (std::size_t columns = 1; columns < 40; ++columns) {
      const BeamCells cells = cells_of(plain, columns, 40 - columns, {.gamma = 0.4, .least_percent = 10});
      EXPECT_EQ(std::ranges::count(cells.s, level == 0 ? 800U : 0U), std::ssize(cells.s)) << columns;
    }
  }
}

TEST(LaserRaster, keeps_the_mean_tone_with_dots_of_full_power) {
  for (const ToneMode mode : {ToneMode::dither, ToneMode::ordered}) {
    for (const int percent : {0, 3, 10, 25, 50, 75, 90, 100}) {
      const LevelPicture grey = picture_of(64, 64, [&](auto, auto) { return 65'535 * percent / 100; });
      const BeamCells cells = cells_of(grey, 64, 64, {.mode = mode, .most_percent = 50, .most_s = 255});
      std::size_t dots = 0;
      for (const std::uint32_t s : cells.s) {
        ASSERT_TRUE(s == 0 || s == 128) << s;
        dots += s > 0 ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(dots) / 4096, 1 - percent / 100.0, 0.01) << percent << " % white";
    }
  }
}

TEST(LaserRaster, dithers_a_gradient_everywhere) {
  const LevelPicture gradient = picture_of(160, 80, [](std::size_t x, auto) { return 65'535 * x / 159; });
  const BeamCells cells = cells_of(gradient, 160, 80, {.mode = ToneMode::dither, .most_percent = 100});
  for (std::size_t block = 0; block < 10; ++block) {
    double dots = 0;
    for (std::size_t y = 0; y < 80; ++y) {
      for (std::size_t x = 0; x < 16; ++x) dots += cells.s[y * 160 + block * 16 + x] > 0 ? 1 : 0;
    }
    const double middle = (static_cast<double>(block) * 16 + 7.5) / 159;
    EXPECT_NEAR(dots / (16 * 80), 1 - middle, 0.03) << "block " << block;
  }
}

TEST(LaserRaster, burns_what_is_darker_than_the_threshold) {
  const LevelPicture steps = picture_of(10, 2, [](std::size_t x, auto) { return 6553 * x; });
  const BeamCells cells = cells_of(steps, 10, 2, {.mode = ToneMode::threshold, .threshold = 35, .most_percent = 100});
  for (std::size_t x = 0; x < 10; ++x) EXPECT_EQ(cells.s[x], x < 4 ? 1000U : 0U) << x;
}

TEST(LaserRaster, crosses_long_gaps_by_rapids_and_merges_equal_cells) {
  const LevelPicture two_bars = picture_of(400, 2, [](std::size_t x, auto) { return x < 50 || x >= 350 ? 0 : 65'535; });
  RasterMoves moves;
  moves.feed = {3'000'000'000};
  moves.overscan = overscan_for(moves.feed, MmPerSecond2(1000));
  EXPECT_EQ(moves.overscan, (Nanometres{1'250'000}));
  const std::string text = program_of(cells_of(two_bars, 400, 2, {.most_percent = 100}), moves);
  const BeamProgram program = test::read_beam(text);
  EXPECT_TRUE(program.faults.empty()) << program.faults.front();
  const auto burns = std::ranges::count_if(program.moves, [](const BeamMove& move) { return move.s > 0; });
  EXPECT_EQ(burns, 4) << "one move for each bar of each line";
  const auto jumps = std::ranges::count_if(program.moves, [](const BeamMove& move) {
    return move.motion == 0 && move.y0 == move.y && std::abs(move.x - move.x0) == 27.5;
  });
  EXPECT_EQ(jumps, 2) << text;
  // A gap that is no longer than the overscan needs is crossed at the feed.
  moves.overscan = {14'000'000};
  const BeamProgram slow = test::read_beam(program_of(cells_of(two_bars, 400, 2, {}), moves));
  EXPECT_EQ(std::ranges::count(slow.moves, 0, &BeamMove::motion), 3) << "two lines, and the way back";
}

TEST(LaserRaster, draws_what_is_burned) {
  const LevelPicture left_half = picture_of(60, 40, [](std::size_t x, auto) { return x < 30 ? 0 : 65'535; });
  const std::string text = program_of(cells_of(left_half, 60, 40, {}), {.overscan = {2'000'000}});
  Diagnostics findings;
  const std::string bytes = draw_burned(text, {.spot = Mm(0.1)});
  const LevelPicture drawn = read_level_picture("burned.png", bytes, PixelLevel::luminance, findings);
  ASSERT_FALSE(findings.any_error());
  // 3 x 3.9 mm, from the first line to the last, with a margin of a thirtieth of 3.9 mm; 20 pixels to the millimetre.
  ASSERT_EQ(drawn.columns, 66U);
  ASSERT_EQ(drawn.rows, 84U);
  EXPECT_LT(drawn.levels[43 * drawn.columns + 33], 65'535 / 5) << "not burned";
  EXPECT_GT(drawn.levels.front(), 65'535 / 2) << "the margin is burned";
  EXPECT_EQ(draw_burned(program_of({2, 2, std::vector<std::uint32_t>(4)}, {}), {}), "");
}

}  // namespace
}  // namespace passo
