// cells_of: the power of each cell of a picture.
#include <algorithm>
#include <array>
#include <cmath>

#include "passo/laser/laser_raster.hpp"

namespace passo {
namespace {

constexpr double white = 65'535;
constexpr double least_darkness = 0.5 / white;

// The mean of pixels in each of `count` equal parts of a row, with the shares of those that lie in two of them.
class RowMeans {
 public:
  RowMeans(const LevelPicture& picture, std::size_t count) : picture_(picture), means_(count) {}

  const std::vector<double>& of(std::size_t row) {
    if (row == row_) return means_;
    row_ = row;
    const std::uint16_t* const levels = &picture_.levels[row * picture_.columns];
    const double wide = static_cast<double>(picture_.columns) / static_cast<double>(means_.size());
    for (std::size_t i = 0; i < means_.size(); ++i) {
      const double from = static_cast<double>(i) * wide;
      const double to = std::min(from + wide, static_cast<double>(picture_.columns));
      double sum = 0;
      for (auto x = static_cast<std::size_t>(from); x < picture_.columns && static_cast<double>(x) < to; ++x) {
        const double begin = std::max(from, static_cast<double>(x));
        const double end = std::min(to, static_cast<double>(x + 1));
        sum += (end - begin) * levels[x];
      }
      means_[i] = sum / (to - from);
    }
    return means_;
  }

 private:
  const LevelPicture& picture_;
  std::vector<double> means_;
  std::size_t row_ = static_cast<std::size_t>(-1);
};

// Brightness from 0 to 1, rows from the bottom to the top.
std::vector<double> brightness_of(const LevelPicture& picture, std::size_t columns, std::size_t rows) {
  std::vector<double> all(columns * rows);
  RowMeans means(picture, columns);
  const double tall = static_cast<double>(picture.rows) / static_cast<double>(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const double from = static_cast<double>(row) * tall;
    const double to = std::min(from + tall, static_cast<double>(picture.rows));
    double* const sums = &all[(rows - 1 - row) * columns];
    for (auto y = static_cast<std::size_t>(from); y < picture.rows && static_cast<double>(y) < to; ++y) {
      const double share = std::min(to, static_cast<double>(y + 1)) - std::max(from, static_cast<double>(y));
      const std::vector<double>& line = means.of(y);
      for (std::size_t i = 0; i < columns; ++i) sums[i] += share / (to - from) * line[i] / white;
    }
  }
  return all;
}

void turn(std::vector<double>& values, std::size_t columns, std::size_t rows, const ToneOptions& options) {
  const auto row_at = [&](std::size_t row) { return values.begin() + static_cast<std::ptrdiff_t>(row * columns); };
  for (std::size_t row = 0; options.mirror_x && row < rows; ++row) std::reverse(row_at(row), row_at(row + 1));
  for (std::size_t row = 0; options.mirror_y && row < rows / 2; ++row) {
    std::swap_ranges(row_at(row), row_at(row + 1), row_at(rows - 1 - row));
  }
}

// Bayer's matrix, by doubling: 4 M + (0 2 / 3 1).
int bayer(std::size_t x, std::size_t y) {
  constexpr std::array<std::array<int, 2>, 2> smallest{{{0, 2}, {3, 1}}};
  int value = 0;
  for (unsigned bit = 0; bit < 3; ++bit) {
    value = 4 * value + smallest[y >> bit & 1U][x >> bit & 1U];
  }
  return value;
}

// Darkness to 0 or 1, there and back from line to line.
void diffuse(std::vector<double>& darkness, std::size_t columns, std::size_t rows) {
  for (std::size_t row = 0; row < rows; ++row) {
    const std::ptrdiff_t step = row % 2 == 0 ? 1 : -1;
    const auto wide = static_cast<std::ptrdiff_t>(columns);
    for (std::ptrdiff_t i = 0; i < wide; ++i) {
      const std::ptrdiff_t x = step > 0 ? i : wide - 1 - i;
      double& here = darkness[row * columns + static_cast<std::size_t>(x)];
      const double dot = here >= 0.5 ? 1 : 0;
      const double error = here - dot;
      here = dot;
      const auto add = [&](std::ptrdiff_t to, std::size_t line, double share) {
        if (to < 0 || to >= wide || line >= rows) return;
        darkness[line * columns + static_cast<std::size_t>(to)] += error * share / 16;
      };
      add(x + step, row, 7);
      add(x - step, row + 1, 3);
      add(x, row + 1, 5);
      add(x + step, row + 1, 1);
    }
  }
}

}  // namespace

CellCount count_cells(const LevelPicture& picture, Mm width, Mm line) {
  const double wide = width / line;
  const double tall = wide * static_cast<double>(picture.rows) / static_cast<double>(picture.columns);
  return {std::max(1.0, std::round(wide)), std::max(1.0, std::round(tall))};
}

BeamCells cells_of(const LevelPicture& picture, std::size_t columns, std::size_t rows, const ToneOptions& options) {
  std::vector<double> tones = brightness_of(picture, columns, rows);
  turn(tones, columns, rows, options);
  const double threshold = options.threshold / 100;
  for (double& tone : tones) {
    const double brightness = options.invert ? 1 - tone : tone;
    if (options.mode == ToneMode::threshold) {
      tone = brightness < threshold ? 1 : 0;
    } else {
      // What rounding leaves of white is white.
      const double darkness = std::min(1 - brightness, 1.0);
      tone = darkness < least_darkness ? 0 : std::pow(darkness, options.gamma);
    }
  }
  if (options.mode == ToneMode::dither) diffuse(tones, columns, rows);
  if (options.mode == ToneMode::ordered) {
    constexpr double levels = 64;
    for (std::size_t i = 0; i < tones.size(); ++i) {
      tones[i] = tones[i] > (bayer(i % columns, i / columns) + 0.5) / levels ? 1 : 0;
    }
  }
  BeamCells cells{columns, rows, std::vector<std::uint32_t>(tones.size())};
  const double span = options.most_percent - options.least_percent;
  for (std::size_t i = 0; i < tones.size(); ++i) {
    if (tones[i] > 0) cells.s[i] = s_of(options.least_percent + span * tones[i], options.most_s);
  }
  return cells;
}

}  // namespace passo
