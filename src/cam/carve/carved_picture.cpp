// draw_carved: the view of a carved surface from above.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "passo/carve/level_picture.hpp"
#include "passo/carve/relief_program.hpp"

namespace passo {
namespace {

// Light wood, in the light and in the shade.
constexpr std::array<double, 3> lit{250, 226, 186};
constexpr std::array<double, 3> shaded{62, 40, 24};

}  // namespace

std::string draw_carved(const CarvedSurface& carved, Mm pitch_x, Mm pitch_y, std::size_t most_side) {
  if (carved.columns < 2 || carved.rows < 2) return {};
  const double px = pitch_x.value();
  const double py = pitch_y.value();
  const double wide = px * static_cast<double>(carved.columns - 1);
  const double tall = py * static_cast<double>(carved.rows - 1);
  // A pixel for each node of the finer pitch, or fewer.
  const double pixel =
      std::max({std::min(px, py), wide / static_cast<double>(most_side), tall / static_cast<double>(most_side)});
  const auto columns = static_cast<std::size_t>(wide / pixel) + 1;
  const auto rows = static_cast<std::size_t>(tall / pixel) + 1;
  const auto last_x = static_cast<std::ptrdiff_t>(carved.columns) - 1;
  const auto last_y = static_cast<std::ptrdiff_t>(carved.rows) - 1;
  const auto height = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
    return static_cast<double>(
        carved.heights[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(y, 0, last_y)) * carved.columns +
                       static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(x, 0, last_x))]);
  };
  const auto brightness = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
    const double slope_x = (height(x + 1, y) - height(x - 1, y)) / (2 * px);
    const double slope_y = (height(x, y + 1) - height(x, y - 1)) / (2 * py);
    // Light from the upper left, 45 degrees high.
    const double light =
        (0.5 * slope_x - 0.5 * slope_y + 0.7071) / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
    return std::clamp(light, 0.0, 1.0);
  };
  const auto nodes_x = static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(pixel / px - 0.01)));
  const auto nodes_y = static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(pixel / py - 0.01)));
  std::vector<std::uint8_t> colours;
  colours.reserve(columns * rows * 3);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto y = static_cast<std::ptrdiff_t>((tall - static_cast<double>(row) * pixel) / py);
    for (std::size_t column = 0; column < columns; ++column) {
      const auto x = static_cast<std::ptrdiff_t>(static_cast<double>(column) * pixel / px);
      double sum = 0;
      for (std::ptrdiff_t j = 0; j < nodes_y; ++j) {
        for (std::ptrdiff_t i = 0; i < nodes_x; ++i) sum += brightness(x + i, y - j);
      }
      const double light = sum / static_cast<double>(nodes_x * nodes_y);
      for (std::size_t i = 0; i < 3; ++i) {
        colours.push_back(static_cast<std::uint8_t>(std::lround(shaded[i] + (lit[i] - shaded[i]) * light)));
      }
    }
  }
  return write_colour_picture(columns, rows, colours);
}

}  // namespace passo
