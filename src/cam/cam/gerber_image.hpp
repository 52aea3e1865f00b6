// GerberImage: the objects of a Gerber file in drawing order: dark objects add, clear objects remove. An aperture block
// and a step-and-repeat block are images, too. Private to cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gerber_shapes.hpp"
#include "region_budget.hpp"

#include "passo/cam/gerber.hpp"

namespace passo {

// The placement of an aperture: mirrored first, then rotated, scaled and translated.
struct GerberPlacement {
  DrawnPoint at = {};
  bool mirrors_x = false;  // X becomes -X
  bool mirrors_y = false;
  double radians = 0;
  double scale = 1;

  bool only_moves() const { return !mirrors_x && !mirrors_y && radians == 0 && scale == 1; }
  DrawnPoint placed(DrawnPoint point) const;
  DrawnRing placed(const DrawnRing& ring) const;  // counterclockwise rings stay counterclockwise
  Region placed(const Region& region) const;
};

struct GerberImage {
  // Consecutive objects of one polarity.
  struct Run {
    bool is_dark = true;
    std::vector<Region> objects;
  };
  std::vector<Run> runs;
  std::vector<GerberPad> pads;
  std::vector<GerberPad> named;  // a place on each stroke and contour with a net
  std::vector<DrawnPath> strokes;
  std::size_t points = 0;  // total number of points, plus an allowance for each object's own memory

  void add(Region object, bool is_dark);
  // The number of points for which add(image, ...) needs room.
  std::size_t points_of_copy() const { return points + 4; }
  void add(const GerberImage& image, const GerberPlacement& placement, bool is_dark);
};

// Returns the resulting dark region. Empty if the budget does not suffice.
std::optional<Region> composed(GerberImage image, RegionBudget& budget);

}  // namespace passo
