// groups_apart: which rings cannot meet, so that each group can be combined or grown on its own. The time of a sweep
// over a group is its corners times the edges beside them: many small sweeps are faster than one, and need less memory.
// Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// The indices of boxes that hang together, in rising order; groups in the order of their first. Boxes of two groups are
// more than `reach` apart. Boxes so many that telling them apart takes long are one group.
std::vector<std::vector<std::size_t>> groups_apart(const std::vector<DrawnBox>& boxes, Nanometres reach);

}  // namespace passo
