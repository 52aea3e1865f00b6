// voronoi_lines: the lines midway between islands of copper. Private to cam/.
#pragma once

#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// The places that are equally far from two islands, and no nearer to a third: the borders of the islands' Voronoi
// cells. Lines end where three meet, and at least as far away as the box; their chords are within 2 um. `islands`: a
// part each. Nothing: the box is wider than 1 m.
std::optional<std::vector<DrawnRing>> voronoi_lines(const std::vector<Region>& islands, const DrawnBox& box);

}  // namespace passo
