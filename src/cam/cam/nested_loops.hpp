// Loops by how deep they lie in one another. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct NestedLoop {
  Region inside = {};      // what it fills
  std::size_t around = 0;  // how many loops lie around it
};

std::vector<NestedLoop> nest(const std::vector<std::vector<PathPoint>>& loops, Nanometres tolerance);

// What the loops of this depth fill.
Region filled_at(const std::vector<NestedLoop>& loops, std::size_t around);
std::size_t deepest_of(const std::vector<NestedLoop>& loops);
// Inside the outermost loops; a loop in a loop is an opening, a loop in an opening is filled again.
Region filled_in_turn(const std::vector<NestedLoop>& loops);

// Of a region what is wider than twice `least` somewhere, and a little of its corners less.
Region notable_part(const Region& region, Nanometres least);

}  // namespace passo
