// part_narrow_gaps: finds toolpaths through gaps between islands that are narrower than the cutter. The cutter runs
// midway and takes a little copper from both sides. Private to cam/.
//
// Copper gives at most `loss` on each side. A trace keeps at least `least_trace` of its width, or all of it if it is
// narrower. Wide copper, such as a pad, gives first: a trace gives only where that does not suffice.
#pragma once

#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

struct NarrowGapRules {
  Nanometres away = {};   // distance of the toolpath from the copper that stays
  Nanometres reach = {};  // a place that is farther from all copper is milled by other toolpaths
  Nanometres loss = {};
  Nanometres least_trace = {};
};

struct NarrowGapWays {
  std::vector<DrawnRing> ways = {};  // open
  std::vector<Region> kept = {};     // of each island, what the toolpaths leave
};

// `islands`: those beside narrow gaps, a single part each. `others`: copper from which the toolpaths keep away.
// `within`: where the middle of the cutter may be; empty: anywhere. Nothing if the islands spread over more than 1 m.
std::optional<NarrowGapWays> part_narrow_gaps(const std::vector<Region>& islands, const std::vector<Region>& others,
                                              const Region& within, const NarrowGapRules& rules);

}  // namespace passo
