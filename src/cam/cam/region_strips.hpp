// Strips: divides work on large regions into vertical strips. Private to cam/.
//
// The time of a sweep over edges is proportional to the corners times the edges next to each. In strips, both are
// fewer. The work of a strip gets the rings up to some distance beyond it. Its results are cut off at the seams and
// joined there: equal edges in opposite directions on a seam cancel out, and the rest is linked to rings.
#pragma once

#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

struct RegionStrip {
  Nanometres low = {};  // the first and the last strip have no end
  Nanometres high = {};
};

// Returns strips with about `corners` corners each, at least `narrowest` wide. One strip: dividing is not worthwhile.
std::vector<RegionStrip> strips_of(const std::vector<DrawnRing>& rings, std::size_t corners, Nanometres narrowest);

class StripCutter {
 public:
  explicit StripCutter(std::vector<DrawnRing> rings);

  // Returns the parts of the rings between the ends of a strip. Edges of outlines and of holes along an end cancel out.
  std::vector<DrawnRing> within(const RegionStrip& strip) const;

 private:
  std::vector<DrawnRing> rings_;
  std::vector<DrawnBox> boxes_;
};

// Joins the rings that were cut off at the ends of neighbouring strips.
std::vector<DrawnRing> joined_at_seams(std::vector<DrawnRing> rings, const std::vector<RegionStrip>& strips);

}  // namespace passo
