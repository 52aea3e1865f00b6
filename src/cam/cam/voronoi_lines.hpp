// voronoi_lines: computes the lines midway between islands of copper. Private to cam/.
#pragma once

#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// Returns the points that are equally far from two islands and no nearer to a third: the boundaries of the islands'
// Voronoi cells. Lines end where three cells meet, or beyond the box; their chords are within 2 um. `islands`: one or
// more parts each. Nothing if the box is wider than 1 m.
std::optional<std::vector<DrawnRing>> voronoi_lines(const std::vector<Region>& islands, const DrawnBox& box);

}  // namespace passo
