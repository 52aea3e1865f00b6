// find_gaps: finds islands of copper that are close to each other. Private to cam/.
#pragma once

#include <vector>

#include "passo/cam/isolation.hpp"

namespace passo {

// Returns one gap for each pair of islands that are closer than `narrowest` and lie in the same region of `groups`; the
// narrowest gap first.
std::vector<CopperGap> find_gaps(const std::vector<Region>& islands, const std::vector<Region>& groups,
                                 Nanometres narrowest);

// Returns the pieces of `ground` that touch two or more islands. `reach`: the maximum distance at which a piece counts
// as touching.
Region between_islands(const Region& ground, const std::vector<Region>& islands, Nanometres reach);

}  // namespace passo
