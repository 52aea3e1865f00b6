#include "passo/levelling/map_figures.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::string_view shades = ".:-=+*#%@";
constexpr double bend_smallest = 1e-9;  // mm: below it a map is level

template <class Visit>
void for_each_point(const HeightMap& map, const Visit& visit) {
  for (std::size_t row = 0; row < map.rows().size(); ++row) {
    for (std::size_t column = 0; column < map.columns().size(); ++column)
      visit(map.columns()[column], map.rows()[row], map.at(column, row));
  }
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

// On a grid X and Y are independent of one another, so each rise is found alone.
MapFigures figures_of(const HeightMap& map) {
  const double middle_x = mean_of(map.columns());
  const double middle_y = mean_of(map.rows());
  MapFigures figures{.lowest = map.lowest(), .highest = map.highest()};
  double xx = 0;
  double yy = 0;
  double xz = 0;
  double yz = 0;
  double sum = 0;
  for_each_point(map, [&](double x, double y, double z) {
    xx += (x - middle_x) * (x - middle_x);
    yy += (y - middle_y) * (y - middle_y);
    xz += (x - middle_x) * z;
    yz += (y - middle_y) * z;
    sum += z;
  });
  figures.mean = sum / static_cast<double>(map.columns().size() * map.rows().size());
  figures.rise_x = xz / xx;
  figures.rise_y = yz / yy;
  for_each_point(map, [&](double x, double y, double z) {
    const double plane = figures.mean + figures.rise_x * (x - middle_x) + figures.rise_y * (y - middle_y);
    figures.farthest_off_plane = std::max(figures.farthest_off_plane, std::abs(z - plane));
  });
  return figures;
}

std::string describe(const HeightMap& map) {
  const MapFigures figures = figures_of(map);
  std::string words =
      fmt::format("{} x {} places, X{:.3f} to {:.3f}, Y{:.3f} to {:.3f}\n", map.columns().size(), map.rows().size(),
                  map.columns().front(), map.columns().back(), map.rows().front(), map.rows().back());
  words += fmt::format("heights {:.3f} to {:.3f} mm, mean {:.3f}\n", figures.lowest, figures.highest, figures.mean);
  words +=
      fmt::format("rises by {:.3f} mm over 100 mm of X, {:.3f} over 100 mm of Y; {:.3f} mm at most off that plane\n",
                  100 * figures.rise_x, 100 * figures.rise_y, figures.farthest_off_plane);
  const double span = std::max(figures.highest - figures.lowest, bend_smallest);
  for (std::size_t row = map.rows().size(); row-- > 0;) {
    words += "  ";
    for (std::size_t column = 0; column < map.columns().size(); ++column) {
      const double share = (map.at(column, row) - figures.lowest) / span;
      const auto shade = static_cast<std::size_t>(share * static_cast<double>(shades.size()));
      words += std::string(2, shades[std::min(shade, shades.size() - 1)]);
    }
    words += fmt::format("  Y{:g}\n", map.rows()[row]);
  }
  return words;
}

}  // namespace passo
