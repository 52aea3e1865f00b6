// find_engagement: how much of its edge a cutter has in the stock, along its way in one layer. Private to cam/.
//
// The engagement is the angle of the cutter's circle that lies in stock: 180 degrees in a slot, 60 where a quarter of
// the diameter is cut from a straight side. It is found from the way alone: stock is what no earlier place of the
// cutter has covered. So it proves a plan, whatever the plan was made by.
#pragma once

#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"

namespace passo {

struct Engagement {
  double most_degrees = 0;
  DrawnPoint at = {};
};

// `entry`: what was cut before, which does not count. `runs`: in their order; between two of them the cutter is lifted.
Engagement find_engagement(const std::vector<MillRun>& entry, const std::vector<MillRun>& runs, Nanometres cutter,
                           const WorkProgress& progress = {});

}  // namespace passo
