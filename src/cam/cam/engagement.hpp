// find_engagement: determines the radial engagement of a cutter along its toolpath in one layer. Private to cam/.
//
// The engagement is the angle of the cutter's circumference that is in the stock: 180 degrees in a slot, 60 if a
// quarter of the diameter is cut from a straight side. It is computed from the toolpath alone: stock is everything that
// no earlier cutter position has covered. The result therefore verifies a plan independently of the algorithm that
// produced the plan.
#pragma once

#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"

namespace passo {

struct Engagement {
  double most_degrees = 0;
  DrawnPoint at = {};
};

// `entry`: the toolpath that was cut before and is not evaluated. `runs`: in cutting order; the cutter is lifted
// between them.
Engagement find_engagement(const std::vector<MillRun>& entry, const std::vector<MillRun>& runs, Nanometres cutter,
                           const WorkProgress& progress = {});

}  // namespace passo
