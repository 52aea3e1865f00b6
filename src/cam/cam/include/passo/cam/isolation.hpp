// plan_isolation: where cutters go to free the copper of a layer from the copper around it.
//
// The middle of the cutter goes around every island of copper, half its width and a small margin away, in loops that
// lie one around the other until the wanted width is free, or with `clear` all ground of the board. So the cutter takes
// no copper that is wanted. Where two islands are nearer to each other than the cutter is wide, no loop fits between:
// that is a gap, and the islands stay joined.
//
// With several cutters the widest goes first. Each finer one then mills only the ground that the wider ones left and
// that still joins two islands (with `clear`: all ground that they left).
//
// With `voronoi` the first way runs midway between two islands instead, and further ones beside it: each island keeps
// the ground around it. These ways end at the board's edge; without an edge a frame around the copper is milled, too.
// Openings within one island, as those of a thermal relief, are milled as drawn.
//
// Loops begin where they are near to the end of the one before. The cutter stays down from loop to loop where the
// straight way is short and keeps away from the copper like the loops, and stays in the ground to be milled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct IsolationCutter {
  Nanometres width = {};  // at the face of the board
  std::string words = {};
};

// The width that a V-shaped cutter mills at the face: the tip, and the angle between its sides, at this depth (> 0).
Nanometres v_cutter_width(Nanometres tip, double angle_degrees, Nanometres depth);

struct IsolationOptions {
  std::vector<IsolationCutter> cutters = {};  // in any order, one or more
  std::uint32_t passes = 1;                   // loops of the widest cutter around an island
  std::optional<Nanometres> width = {};       // free ground around the copper, at least; instead of `passes`
  double overlap = 0.5;                       // share of the cutter's width that a loop and the next have in common
  bool clear = false;                         // frees the board of all copper that is not wanted
  bool voronoi = false;                       // ways midway between the islands; not with `clear`
  bool climb = true;                          // with a spindle that turns clockwise; else conventional
  Region board = {};                          // empty: around the copper
  Nanometres depth{-50'000};
  Nanometres tolerance{4'000};  // the loops are so much farther from the copper than half the cutter
  DrawnPoint park = {};
  std::uint64_t route_steps = 20'000'000;  // work of shorten_route() on each tool, at most
};

// Two islands of copper nearer to each other than the finest cutter needs.
struct CopperGap {
  DrawnPoint at = {};     // its narrowest place
  Nanometres width = {};  // there
};

struct IsolationPlan {
  MillPlan mill = {};
  std::size_t islands = 0;           // of copper
  std::vector<CopperGap> gaps = {};  // one for each two islands, from narrow to wide
  Region unmilled = {};              // the ground in the gaps and narrow openings, for the picture
  // Openings within an island, as those of a thermal relief, of which no cutter reaches half: a place in each.
  std::vector<DrawnPoint> narrow_openings = {};
};

// Errors "isolation.…" are in `diagnostics`.
IsolationPlan plan_isolation(const Region& copper, const IsolationOptions& options, Diagnostics& diagnostics,
                             const WorkProgress& progress = {});

}  // namespace passo
