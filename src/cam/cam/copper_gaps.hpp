// find_gaps: finds islands of copper that are close to each other. Private to cam/.
#pragma once

#include <functional>
#include <vector>

#include "passo/cam/isolation.hpp"

namespace passo {

// Returns one gap for each pair of islands that are closer than `narrowest` and belong to the same group; the narrowest
// gap first. `group`: a number for each island. `is_milled`: tells which places do not count.
std::vector<CopperGap> find_gaps(const std::vector<Region>& islands, const std::vector<std::size_t>& group,
                                 Nanometres narrowest, const std::function<bool(DrawnPoint)>& is_milled = {});

// Returns the pieces of `ground` that touch two or more islands. `reach`: the maximum distance at which a piece counts
// as touching.
Region between_islands(const Region& ground, const std::vector<Region>& islands, Nanometres reach);

}  // namespace passo
