// thinned: leaves out points of lines that are nearly straight. Private to cam/.
#pragma once

#include "passo/cam/region.hpp"

namespace passo {

// Removes the points that are at most `tolerance_nm` from the line between the remaining ones (Ramer, Douglas and
// Peucker, 1972). The first and the last point remain.
DrawnRing thinned(const DrawnRing& points, double tolerance_nm);

// The same for a closed line.
DrawnRing thinned_ring(const DrawnRing& ring, double tolerance_nm);

}  // namespace passo
