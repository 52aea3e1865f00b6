// plan_v_carve: carves areas with a V-bit, so that its flanks follow the outlines of the areas.
//
// The cutter centre follows the medial axis: the points that are equally far from two or more edges. It goes so deep
// that its flanks touch both edges; wide strokes are therefore deep, narrow ones shallow, and corners are sharp.
// Branches into almost straight corners (chords of curves) are omitted.
//
// If an area is wider than the cutter or the maximum depth allows, its middle becomes a flat floor: the cutter goes
// around it once at full depth, and `floor` is the remaining area, for an end mill. Strokes narrower than the cutter's
// tip are reported as `unreached`.
//
// The cutter stays down where possible: from the end of a branch it returns along the groove that it has just carved,
// unless a lift is quicker. Lines and arcs replace the points of the axis; an arc may be a helix.
//
// With a `step` the cutter works in layers, each deeper by `step`, along the points that are deeper than the previous
// layer. Every point is finally cut at its exact depth.
//
// `start` is for the plug of an inlay: its outlines lie at that depth, so that it fits into a pocket carved along the
// same outlines at the surface. A cutter too narrow for that depth is an error "engrave.narrow-cutter".
//
// Source: the Voronoi diagram of segments by S. Fortune's sweep, Boost.Polygon.
#pragma once

#include <string>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct VCarveOptions {
  double angle_degrees = 60;     // included angle
  Nanometres tip{};              // tip width
  Nanometres widest{6'000'000};  // cutter diameter
  Nanometres deepest{};          // maximum depth below `start`, negative; 0: limited by the cutter's width
  Nanometres step{};             // depth per layer, above 0; 0: a single layer
  Nanometres start{};            // depth of the outlines below the surface, 0 or negative; the walls continue above
  Nanometres tolerance{2'000};   // tolerance of curves, in depth and in XY
  Nanometres fit{4'000};         // how far lines and arcs may leave the curves, across their walls
  Nanometres longest_return{20'000'000};  // length of a return in a groove that takes as long as a lift
  std::string words = {};                 // tool name for the operator
  DrawnPoint park = {};
};

struct VCarvePlan {
  MillPlan mill = {};
  Nanometres deepest = {};  // the maximum depth reached, negative
  std::size_t layers = 1;
  Region floor = {};  // the remaining area that is too wide for the cutter, at the depth `floor_z`
  Nanometres floor_z = {};
  Region unreached = {};  // strokes narrower than the tip
};

// Reports errors "engrave.…" in `diagnostics`.
VCarvePlan plan_v_carve(const Region& area, const VCarveOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress = {});

// Returns runs with which the tip of the V-bit mills away the material that a flat cutter left on a floor: loops
// within the floor, `apart` from each other, at the depth `z`. Where loops are close together, the cutter stays down
// between them. `steps`: the depth of a layer; 0: a single layer. At most 20,000 loops per layer; returns nothing if
// there would be more.
std::vector<MillRun> clean_floor(const Region& left, Nanometres z, Nanometres apart, Nanometres step);

}  // namespace passo
