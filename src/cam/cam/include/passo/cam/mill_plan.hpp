// MillPlan: the toolpaths of milling cutters as runs: down into the board, along a toolpath, and up again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/cam/region.hpp"
#include "passo/cam/route_link.hpp"

namespace passo {

// How fast the cutter moves: it cuts, finishes walls or floors, links two cuts through a cleared area, or moves
// straight up or down in the air.
enum class MillPace : std::uint8_t { cut, finish, link, rapid };

// A position of the cutter centre. The bulge defines the connection to the next point, as in PathPoint; the height
// changes linearly in between. Z0 is the surface of the board.
struct MillPoint {
  DrawnPoint at = {};
  double bulge = 0;
  Nanometres z = {};
  MillPace pace = MillPace::cut;  // of the move to the next point
};

using MillRun = std::vector<MillPoint>;  // at least two points

// Begins a run above a floor that has been cut: a rapid leads down to just above it. `floor`: its Z; nothing is added
// if it is not clearly below Z0.
void enter_above(MillRun& run, DrawnPoint at, Nanometres floor);
// Continues to a point at the Z of the run's end, through a cleared area; slightly lifted if the link is long enough.
void link_to(MillRun& run, DrawnPoint to);

// A gap counts as exactly as wide as the cutter, and is cut along its centre line, if it is narrower by at most this:
// 0.02 mm, and 1 % of the cutter's diameter.
constexpr Nanometres tight_cut_tolerance(Nanometres cutter) {
  return {cutter.count < 2'000'000 ? cutter.count / 100 : 20'000};
}

struct MillTool {
  Nanometres width = {};           // milled width at the surface of the board; for varying depth, the tip width
  std::string words = {};          // name for the operator: "cutter 1 mm"
  std::vector<MillRun> runs = {};  // in machining order
};

struct MillPlan {
  std::vector<MillTool> tools = {};     // in order of use; unused tools are omitted
  std::vector<std::string> notes = {};  // changes and omissions, each a sentence without a full stop
};

struct MillLengths {
  std::size_t runs = 0;  // number of runs; equals the number of plunges
  double milled_nm = 0;
  double links_nm = 0;   // through cleared areas
  double rapids_nm = 0;  // rapid distance at clearance height, including the ways to the first run and from the last
};

// Returns the lengths of a tool that comes from the park position and returns to it.
MillLengths lengths_of(const MillTool& tool, DrawnPoint park);
// Returns the lengths of each tool. `link`: of the program.
std::vector<MillLengths> lengths_of(const MillPlan& plan, DrawnPoint park, const RouteLink& link);

// Returns where the next tool of a plan comes from.
DrawnPoint end_of(const MillPlan& plan, DrawnPoint park, const RouteLink& link);

// Returns the path of the cutter centre as chords within the tolerance.
std::vector<DrawnPoint> chords_of(const MillRun& run, Nanometres tolerance);

}  // namespace passo
