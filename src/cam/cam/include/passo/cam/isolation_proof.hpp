// prove_isolation: what the cutters of a plan do to a layer, found without the plan's own geometry.
//
// Every run is swept by a disc of the cutter's width, and by as much more as the written program and the chords of the
// sweep may be off: 1.7 um to each side, where a plan leaves 3. What the discs reach is milled, the rest of the board's
// face is copper. The proof compares that with the layer.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct IsolationProof {
  double copper_mm2 = 0;  // of the layer
  double lost_mm2 = 0;    // copper of the layer that is milled away
  double milled_mm2 = 0;
  std::size_t islands = 0;  // of the layer
  std::size_t joined = 0;   // islands that are still joined to another one
  std::size_t groups = 0;   // pieces of copper in which the joined ones hang together
};

// `board`: what is beyond it joins no islands, as it is cut off. Empty: copper goes on without end.
IsolationProof prove_isolation(const Region& copper, const MillPlan& plan, const Region& board = {},
                               const WorkProgress& progress = {});

}  // namespace passo
