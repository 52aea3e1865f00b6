// find_tight_ways: the centre lines of holes, slots and necks that are exactly as wide as the cutter. Private to cam/.
//
// Such a gap leaves the cutter no room beside its centre line, so no loop at half the cutter's width from the walls
// exists. It is cut by a plunge or by one pass along its centre line. A gap counts as exactly as wide if the cutter
// cuts into each wall by at most half of `tight_cut_tolerance()`.
#pragma once

#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct TightWay {
  DrawnRing points = {};  // a single point is a plunge
  bool is_closed = false;
};

// `free`: what may be cut. `reach`: where the cutter centre goes anyway.
std::vector<TightWay> find_tight_ways(const Region& free, const Region& reach, Nanometres cutter);

// Returns the ways beside a part. `around`: the part grown by half of the cutter's width, and a little more.
std::vector<TightWay> find_tight_ways_beside(const Region& part, const Region& around, Nanometres cutter);

struct TightCut {
  Nanometres depth = {};
  Nanometres step = {};
  double ramp_degrees = 0;
};
// Returns the run along the way: there and back, downwards along a ramp. Holes are pecked.
MillRun tight_run(const TightWay& way, const TightCut& cut);

// Orders the ways by the shortest route.
std::vector<MillRun> tight_runs(const std::vector<TightWay>& ways, const TightCut& cut, DrawnPoint from,
                                DrawnPoint park);

}  // namespace passo
