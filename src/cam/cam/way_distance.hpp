// pieces_far_from, pieces_near: the pieces of lines that keep a distance from edges, or are within it. Private to cam/.
//
// Each piece follows from the distances themselves, not from a region around the edges, so it is right where two such
// regions touch in a point on the line.
#pragma once

#include <vector>

#include "edge_grid.hpp"

namespace passo {

// `lines`: open. The ends of the pieces are rounded to 1 nm.
std::vector<DrawnRing> pieces_far_from(const EdgeGrid& edges, Nanometres distance, const std::vector<DrawnRing>& lines);
std::vector<DrawnRing> pieces_near(const EdgeGrid& edges, Nanometres distance, const std::vector<DrawnRing>& lines);
bool is_near(const EdgeGrid& edges, Nanometres distance, DrawnPoint from, DrawnPoint to);

}  // namespace passo
