// MapFigures: the statistics of a height map, and a text picture of it.
#pragma once

#include <string>

#include "passo/levelling/height_map.hpp"

namespace passo {

// Lengths in mm.
struct MapFigures {
  double lowest = 0;
  double highest = 0;
  double mean = 0;
  // The best-fit plane of all points (least squares): its slope, mm per mm.
  double rise_x = 0;
  double rise_y = 0;
  double farthest_off_plane = 0;  // maximum over all points
};

MapFigures figures_of(const HeightMap& map);
// Returns the statistics as text, and the map seen from above: one text line per grid row, the farthest row first. '.'
// is low, '@' high.
std::string describe(const HeightMap& map);

}  // namespace passo
