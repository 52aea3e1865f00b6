// Loops with their nesting depth. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct NestedLoop {
  Region inside = {};      // the area inside the loop
  std::size_t around = 0;  // number of loops around it
};

std::vector<NestedLoop> nest(const std::vector<std::vector<PathPoint>>& loops, Nanometres tolerance);

// Returns the area inside the loops of this depth.
Region filled_at(const std::vector<NestedLoop>& loops, std::size_t around);
std::size_t deepest_of(const std::vector<NestedLoop>& loops);
// Returns the area inside the outermost loops; a loop within a loop is an opening, a loop within an opening is filled
// again.
Region filled_in_turn(const std::vector<NestedLoop>& loops);

// Returns the parts of a region that are somewhere wider than twice `least`, with slightly cut corners.
Region notable_part(const Region& region, Nanometres least);

}  // namespace passo
