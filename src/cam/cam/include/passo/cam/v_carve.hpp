// plan_v_carve: carves areas with a V-shaped cutter, so that its edges run along the lines of the areas.
//
// The cutter's middle goes along the medial axis: the places that are equally far from two or more lines. There it is
// as deep as its flanks touch both, so wide strokes are deep, narrow ones shallow, and corners come out sharp. Branches
// towards corners that are hardly any (chords of curves) are left out.
//
// Where an area is wider than the cutter, or deeper than allowed, its middle is a flat floor: the cutter goes around it
// once at the full depth, and `floor` tells what stays inside, for a flat cutter. Strokes that are narrower than the
// cutter's tip are told as `unreached`.
//
// With a `step` the cutter goes in layers: so much deeper each time, along the places that are deeper than the layer
// before. Every place is at last cut at its exact depth.
//
// The plug of an inlay is carved around: its lines lie at `start`, so it fits into a pocket that was carved along the
// same lines at the face. A cutter that is too narrow to be that deep is an error "engrave.narrow-cutter".
//
// Source: the Voronoi diagram of segments by S. Fortune's sweep, Boost.Polygon.
#pragma once

#include <string>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct VCarveOptions {
  double angle_degrees = 60;     // between the cutter's flanks
  Nanometres tip{};              // width of its tip
  Nanometres widest{6'000'000};  // its diameter
  Nanometres deepest{};          // below `start`, negative; 0: as the cutter's width allows
  Nanometres step{};             // of a layer, above 0; 0: all at once
  Nanometres start{};            // where the lines lie, below the face, 0 or negative: above, the walls go on
  Nanometres tolerance{2'000};   // of curves, in depth and sideways
  std::string words = {};        // for the operator
  DrawnPoint park = {};
};

struct VCarvePlan {
  MillPlan mill = {};
  Nanometres deepest = {};  // below 0
  std::size_t layers = 1;
  Region floor = {};  // what stays of areas that are too wide, at the depth `floor_z`
  Nanometres floor_z = {};
  Region unreached = {};  // strokes narrower than the tip
};

// Errors "engrave.…" are in `diagnostics`.
VCarvePlan plan_v_carve(const Region& area, const VCarveOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress = {});

}  // namespace passo
