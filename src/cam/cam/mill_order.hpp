// order_ways: loops and open ways become runs of the cutter: in which order, from where, and where it need not lift.
// Private to cam/.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "arc_fit.hpp"

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

// Of a cutter at depth. A closed way may begin at any of its points; the last point leads back to the first. An open
// way begins at its first, or if it may be turned, at its first or its last.
struct CutterWay {
  DrawnRing points = {};
  bool is_closed = true;
  bool may_be_turned = false;
};

struct WayOrder {
  DrawnPoint park = {};
  Nanometres z = {};
  std::uint64_t route_steps = 0;
  ArcFit arcs = {};
  // Whether the cutter may go straight from one place to the other in the ground.
  std::function<bool(DrawnPoint, DrawnPoint)> may_link = {};
};

std::vector<MillRun> order_ways(const std::vector<CutterWay>& ways, const WayOrder& order,
                                const WorkProgress& progress = {});

}  // namespace passo
