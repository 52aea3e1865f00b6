// plan_isolation: plans isolation milling: toolpaths that separate the copper of a layer from the copper around it.
//
// The cutter centre follows each island of copper at half the cutter width plus a small margin, in concentric passes
// until the isolation width is reached; with `clear`, until all unwanted copper of the board is removed. The cutter
// therefore never removes copper of the layer. If two islands are closer than the cutter is wide, the finest cutter
// runs midway between them and takes up to `allowed_loss` from each side. Where that does not suffice, this is reported
// as a gap, and the islands stay connected.
//
// With several cutters the widest goes first. Each finer cutter then mills only the areas that the wider ones left and
// that still connect two islands (with `clear`: all areas that they left).
//
// With `voronoi` the first pass runs midway between two islands, and further passes run beside it: each island keeps
// the copper around it. These toolpaths end at the board's edge; without an edge, a frame around the copper is milled,
// too. Openings within one island, such as those of a thermal relief, are milled as drawn.
//
// Each loop begins near the end of the previous one. The cutter stays down between loops if the straight link is short,
// keeps the same distance from the copper as the loops, and stays in the area to be milled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/cam/route_link.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct IsolationCutter {
  Nanometres width = {};  // milled width at the board's surface
  std::string words = {};
};

// Returns the width that a V-bit mills at the surface, from its tip width, its included angle and the depth (> 0).
Nanometres v_cutter_width(Nanometres tip, double angle_degrees, Nanometres depth);

struct IsolationOptions {
  std::vector<IsolationCutter> cutters = {};  // at least one, in any order
  std::uint32_t passes = 1;                   // number of isolation passes of the widest cutter around an island
  std::optional<Nanometres> width = {};       // minimum isolation width; replaces `passes`
  double overlap = 0.5;                       // overlap of adjacent passes, as a fraction of the cutter width
  bool clear = false;                         // removes all unwanted copper from the board
  bool voronoi = false;                       // toolpaths midway between the islands; not with `clear`
  bool climb = true;                          // climb milling, for a clockwise spindle; otherwise conventional
  Region board = {};                          // the board's outline; empty: the surroundings of the copper
  Nanometres depth{-50'000};
  Nanometres tolerance{4'000};      // margin added to half the cutter width
  Nanometres allowed_loss{};        // copper that may be lost on each side of a gap that is too narrow
  Nanometres least_trace{100'000};  // traces keep at least this width there; narrower ones lose nothing
  DrawnPoint park = {};
  RouteLink link = {};
  std::uint64_t route_steps = 20'000'000;  // maximum number of steps of shorten_route() per tool
};

// Two islands of copper closer than the finest cutter requires.
struct CopperGap {
  DrawnPoint at = {};     // the narrowest point
  Nanometres width = {};  // width at that point
  std::size_t one = 0;    // index of each island, in the order of parts_of(copper)
  std::size_t other = 0;
};

struct IsolationPlan {
  MillPlan mill = {};
  std::size_t islands = 0;           // number of copper islands
  std::vector<CopperGap> gaps = {};  // one per pair of islands that stay joined, the narrowest first
  std::vector<Region> kept = {};     // what must stay of each island; empty: all of the copper
  Region unmilled = {};              // the unmilled areas in gaps and narrow openings, for the picture
  // Openings within an island, such as those of a thermal relief, of which cutters reach less than half: a point in
  // each.
  std::vector<DrawnPoint> narrow_openings = {};
};

// Reports errors "isolation.…" in `diagnostics`.
IsolationPlan plan_isolation(const Region& copper, const IsolationOptions& options, Diagnostics& diagnostics,
                             const WorkProgress& progress = {});

}  // namespace passo
