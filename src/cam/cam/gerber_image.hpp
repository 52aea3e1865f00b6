// GerberImage: what a Gerber file has drawn, in the order of drawing: dark objects add, clear objects take away. An
// aperture block and a step-and-repeat block are images too. Private to cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gerber_shapes.hpp"
#include "region_budget.hpp"

#include "passo/cam/gerber.hpp"

namespace passo {

// How an aperture is placed: mirrored, then turned, then scaled, then moved.
struct GerberPlacement {
  DrawnPoint at = {};
  bool mirrors_x = false;  // X becomes -X
  bool mirrors_y = false;
  double radians = 0;
  double scale = 1;

  bool only_moves() const { return !mirrors_x && !mirrors_y && radians == 0 && scale == 1; }
  DrawnPoint placed(DrawnPoint point) const;
  DrawnRing placed(const DrawnRing& ring) const;  // counterclockwise stays counterclockwise
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
  std::vector<DrawnPath> strokes;
  std::size_t points = 0;  // of all, with some for each object's own memory

  void add(Region object, bool is_dark);
  // What add(image, ...) needs room for.
  std::size_t points_of_copy() const { return points + 4; }
  void add(const GerberImage& image, const GerberPlacement& placement, bool is_dark);
};

// What is dark in the end. Empty: the budget does not allow it.
std::optional<Region> composed(GerberImage image, RegionBudget& budget);

}  // namespace passo
