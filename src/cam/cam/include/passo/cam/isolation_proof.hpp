// prove_isolation: verifies an isolation plan independently of the plan's own geometry.
//
// Every run is swept by a disc of the cutter width plus the maximum error of the written program and of the sweep's
// chords: 1.7 um on each side, where a plan leaves 3. The swept area is milled; the rest of the board's surface is
// copper. The proof compares this copper with the layer.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct IsolationProof {
  double copper_mm2 = 0;    // copper area of the layer
  double lost_mm2 = 0;      // copper of the layer that is milled away
  Nanometres deepest = {};  // the farthest that the cutter comes into the copper, up to 1 mm
  double damage_mm2 = 0;    // of the copper that must stay, what is milled away
  double milled_mm2 = 0;
  std::size_t islands = 0;               // number of islands of the layer
  std::size_t joined = 0;                // number of islands that are still connected to another one
  std::size_t groups = 0;                // number of connected pieces formed by the joined islands
  std::vector<std::size_t> pieces = {};  // for each island, in the order of parts_of(copper): the connected piece of
                                         // which it is a part; islands outside the board have numbers of their own
  std::vector<std::size_t> broken = {};  // islands that are milled apart
};

// `board`: material outside it connects no islands, since it is cut off. Empty: the copper extends without limit.
// `kept`: what must stay of each island; empty: all of it.
IsolationProof prove_isolation(const Region& copper, const MillPlan& plan, const Region& board = {},
                               const WorkProgress& progress = {}, const std::vector<Region>& kept = {});

}  // namespace passo
