// plan_pocket: clears a region with concentric loops.
//
// The cutter begins in the middle of each pocket and works outwards; the last loop follows the wall. It descends along
// a helix of 50 to 80 % of its diameter, or along the first loop where there is no room. Between loops it stays down if
// the straight link keeps clear of the walls. Material that sharp corners leave between two loops is cut separately.
// The loops have arcs where the walls do.
//
// With `most_engagement` the radial engagement never exceeds that angle, except during the descent: the region is
// cleared along the rims of discs, which follow its medial axis (constant engagement). Areas in which the cutter would
// cut a slot are left and counted as `unreached`. If the engagement limit cannot be kept, the plan fails with
// "pocket.engagement".
//
// Necks, holes and slots exactly as wide as the cutter are cut along their centre line, but only if the engagement is
// not limited.
//
// With an allowance, walls and floor keep some stock. With `finishes` it is removed: from the floor by the loops once
// more, from each wall in one lap at full depth with arcs as lead-in and lead-out. A pocket whose walls leave no room
// for this is cut without an allowance, and counted as `unfinished`.
//
// Areas that the cutter cannot reach, in inner corners and between narrow walls, are reported as `unreached`: nothing
// is omitted silently. A part of the region that the cutter does not fit into at all causes a warning "pocket.narrow".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct PocketOptions {
  Nanometres cutter{3'000'000};     // cutter diameter
  std::string words = {};           // tool name for the operator
  Nanometres depth{-3'000'000};     // final depth below the surface, negative
  Nanometres step{1'000'000};       // maximum depth per layer
  double step_over = 0.4;           // stepover as a fraction of the cutter diameter; above 0, at most 1
  double ramp_degrees = 5;          // ramp angle of the descent along the toolpath; 0: straight down
  double most_engagement = 0;       // degrees, 30 to 150; 0: loops at `step_over`, with unlimited engagement
  Nanometres allowance{};           // stock that roughing leaves on walls
  Nanometres floor_allowance{};     // stock that roughing leaves on the floor; less than the depth
  bool finishes = false;            // cuts the allowances
  std::uint32_t spring_passes = 0;  // additional laps along a finished wall
  Nanometres lead{};                // radius of the arcs into and out of finished walls, where there is room
  bool climb = true;                // climb milling, for a clockwise spindle; otherwise conventional
  DrawnPoint park = {};
};

struct PocketPlan {
  MillPlan mill = {};
  std::size_t pockets = 0;
  std::size_t loops = 0;       // number per layer; with constant engagement: number of discs
  std::size_t finished = 0;    // number of walls with a finishing pass
  std::size_t unfinished = 0;  // number of pockets that are cut without an allowance
  std::size_t tight = 0;       // number of cuts exactly as wide as the cutter
  double engagement = 0;  // maximum engagement in a layer, degrees, if a limit was set; computed from the toolpaths
                          // alone
  Region unreached = {};  // without a remaining allowance
  double unreached_mm2 = 0;
  double lost_mm2 = 0;  // area lost from the part, according to a sweep of the cutter
};

// Reports errors "pocket.…" in `diagnostics`.
PocketPlan plan_pocket(const Region& area, const PocketOptions& options, Diagnostics& diagnostics,
                       const WorkProgress& progress = {});

}  // namespace passo
