// An independent reference implementation of the surface and the cutters, written directly from their definitions, to
// check the program: slow, but without the code under test.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "passo/carve/height_grid.hpp"

namespace passo::test {

struct OracleCutter {
  const char* text;  // cutter description for parse_cutter()
  double radius;
  // Height of the shape above the tip, for distances up to the radius.
  double (*height)(double distance);
};

inline const std::vector<OracleCutter>& oracle_cutters() {
  static const std::vector<OracleCutter> all = {
      {"ball:3", 1.5, [](double r) { return 1.5 - std::sqrt(std::max(0.0, 2.25 - r * r)); }},
      {"flat:2.3", 1.15, [](double) { return 0.0; }},
      {"bull:3:0.5", 1.5,
       [](double r) { return r < 1 ? 0.0 : 0.5 - std::sqrt(std::max(0.0, 0.25 - (r - 1) * (r - 1))); }},
      {"vee:60:3", 1.5, [](double r) { return r * std::sqrt(3.0); }},
      {"vee:90:3:0.4", 1.5, [](double r) { return std::max(0.0, r - 0.2); }},
      {"taper:1:10:3", 1.5,
       [](double r) {
         const double angle = 10 * M_PI / 180;
         if (r <= 0.5 * std::cos(angle)) return 0.5 - std::sqrt(0.25 - r * r);
         return r / std::tan(angle) - (0.5 / std::sin(angle) - 0.5);
       }},
  };
  return all;
}

// Returns random heights with cliffs, plateaus and spikes.
inline HeightGrid random_surface(std::mt19937_64& random, std::size_t columns, std::size_t rows, Mm pitch_x,
                                 Mm pitch_y) {
  std::uniform_real_distribution<double> share(0, 1);
  HeightGrid grid{.columns = columns, .rows = rows, .pitch_x = pitch_x, .pitch_y = pitch_y};
  const double rough = share(random);
  double level = -2;
  for (std::size_t i = 0; i < columns * rows; ++i) {
    if (share(random) < rough) level = -4 * share(random);
    grid.heights.push_back(grid_height(Mm(share(random) < 0.03 ? 0 : level)));
  }
  return grid;
}

// Returns the height of the bilinear surface; the position must be inside.
inline double surface_at(const HeightGrid& grid, double x, double y) {
  const double column = std::clamp(x / grid.pitch_x.value(), 0.0, static_cast<double>(grid.columns - 1));
  const double row = std::clamp(y / grid.pitch_y.value(), 0.0, static_cast<double>(grid.rows - 1));
  const auto i = std::min(static_cast<std::size_t>(column), grid.columns - 2);
  const auto j = std::min(static_cast<std::size_t>(row), grid.rows - 2);
  const double s = column - static_cast<double>(i);
  const double t = row - static_cast<double>(j);
  return (1 - t) * ((1 - s) * grid.at(i, j) + s * grid.at(i + 1, j)) +
         t * ((1 - s) * grid.at(i, j + 1) + s * grid.at(i + 1, j + 1));
}

// Returns the lowest tip height at which the cutter cuts none of the surface points, of which each cell has `parts` in
// each direction.
inline double least_tip(const HeightGrid& grid, const OracleCutter& cutter, double x, double y, int parts) {
  double least = -1e9;
  const double dx = grid.pitch_x.value() / parts;
  const double dy = grid.pitch_y.value() / parts;
  const auto last_x = static_cast<double>((grid.columns - 1) * static_cast<std::size_t>(parts));
  const auto last_y = static_cast<double>((grid.rows - 1) * static_cast<std::size_t>(parts));
  for (double j = std::max(0.0, std::ceil((y - cutter.radius) / dy)); j <= std::min(last_y, (y + cutter.radius) / dy);
       ++j) {
    for (double i = std::max(0.0, std::ceil((x - cutter.radius) / dx)); i <= std::min(last_x, (x + cutter.radius) / dx);
         ++i) {
      const double away = std::hypot(i * dx - x, j * dy - y);
      if (away > cutter.radius) continue;
      least = std::max(least, surface_at(grid, i * dx, j * dy) - cutter.height(away));
    }
  }
  return least;
}

}  // namespace passo::test
