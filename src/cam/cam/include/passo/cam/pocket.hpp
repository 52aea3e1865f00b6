// plan_pocket: clears the ground of a region by loops that lie one around the other.
//
// The cutter begins in the middle of each pocket and works outwards, so the last loop is the wall's. It goes down along
// a ramp, which on a small loop is a helix. From loop to loop it stays down where the straight way keeps clear of the
// walls. Where sharp corners leave ground between two loops, that ground is cut on its own. The loops are arcs where
// the walls are.
//
// With `most_engagement` no more than that angle of the cutter's edge is in the stock at any time, but while it goes
// down: discs along the middle of the ground, whose rims are followed, clear it (constant engagement). Ground in which
// the cutter would be in a slot stays, and is `unreached` like the rest. Where the angle is not kept, no program is
// made: "pocket.engagement".
//
// What the cutter cannot reach, in inner corners and between narrow walls, is told as `unreached`: nothing is dropped
// in silence. A part of the region that the cutter does not fit into at all is a warning "pocket.narrow".
#pragma once

#include <cstddef>
#include <string>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct PocketOptions {
  Nanometres cutter{3'000'000};  // diameter
  std::string words = {};        // for the operator
  Nanometres depth{-3'000'000};  // below the face, negative
  Nanometres step{1'000'000};    // how deep a layer is, at most
  double step_over = 0.4;        // from loop to loop, as a share of the cutter's diameter; above 0, at most 1
  double ramp_degrees = 5;       // how steep the cutter goes down along its way; 0: straight down
  double most_engagement = 0;    // degrees, 30 to 150; 0: loops at `step_over`, with any engagement
  bool climb = true;             // with a spindle that turns clockwise; else conventional
  DrawnPoint park = {};
};

struct PocketPlan {
  MillPlan mill = {};
  std::size_t pockets = 0;
  std::size_t loops = 0;  // of one layer; of constant engagement: discs
  double engagement = 0;  // degrees, the most of a layer, where it was asked for; found from the ways alone
  Region unreached = {};
  double unreached_mm2 = 0;
  double lost_mm2 = 0;  // of what stays, by a sweep of the cutter
};

// Errors "pocket.…" are in `diagnostics`.
PocketPlan plan_pocket(const Region& area, const PocketOptions& options, Diagnostics& diagnostics,
                       const WorkProgress& progress = {});

}  // namespace passo
