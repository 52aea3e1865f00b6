// find_helix: where a cutter can go down along a helix. Private to cam/.
#pragma once

#include <optional>

#include "closed_toolpath.hpp"

#include "passo/cam/region.hpp"

namespace passo {

// The circle that the cutter centre follows downwards.
struct Helix {
  DrawnPoint centre = {};
  double radius = 0;  // nm
};

// Returns the widest helix in `ground`, a single part of the area of the cutter centre: 80 % of the cutter's diameter
// wide, or as wide as there is room; nothing if 50 % do not fit. `margin_nm`: how far it may leave `ground`.
std::optional<Helix> find_helix(const Region& ground, double margin_nm, Nanometres cutter);

// Returns the circle, beginning at its point nearest to `towards`.
ClosedToolpath track_of(const Helix& helix, DrawnPoint towards, bool climb);

}  // namespace passo
