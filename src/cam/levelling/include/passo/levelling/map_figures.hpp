// MapFigures: a height map in numbers and as a picture of letters, for people.
#pragma once

#include <string>

#include "passo/levelling/height_map.hpp"

namespace passo {

// Lengths in mm.
struct MapFigures {
  double lowest = 0;
  double highest = 0;
  double mean = 0;
  // The plane that is nearest to all points, by least squares: how far it rises, mm a mm.
  double rise_x = 0;
  double rise_y = 0;
  double farthest_off_plane = 0;  // of all points
};

MapFigures figures_of(const HeightMap& map);
// The figures in words, and the map seen from above: a row of the grid a line, the farthest row first. '.' is low, '@'
// high.
std::string describe(const HeightMap& map);

}  // namespace passo
