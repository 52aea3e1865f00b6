// find_gaps: islands of copper that are near to each other. Private to cam/.
#pragma once

#include <vector>

#include "passo/cam/isolation.hpp"

namespace passo {

// One gap for each two islands that are nearer to each other than `narrowest` and in the same one of `groups`, from
// narrow to wide.
std::vector<CopperGap> find_gaps(const std::vector<Region>& islands, const std::vector<Region>& groups,
                                 Nanometres narrowest);

// Those pieces of the ground that touch two islands or more. `reach`: how far a piece may be from what it touches.
Region between_islands(const Region& ground, const std::vector<Region>& islands, Nanometres reach);

}  // namespace passo
