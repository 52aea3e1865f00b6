// MillPlan: the toolpaths of milling cutters as runs: down into the board, along a toolpath, and up again.
#pragma once

#include <string>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// A position of the cutter centre. The bulge defines the connection to the next point, as in PathPoint; the height
// changes linearly in between. Z0 is the surface of the board.
struct MillPoint {
  DrawnPoint at = {};
  double bulge = 0;
  Nanometres z = {};
};

using MillRun = std::vector<MillPoint>;  // at least two points

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
  double rapids_nm = 0;  // rapid distance at clearance height, from the park position and back, for each tool
};

MillLengths lengths_of(const MillTool& tool, DrawnPoint park);

// Returns the path of the cutter centre as chords within the tolerance.
std::vector<DrawnPoint> chords_of(const MillRun& run, Nanometres tolerance);

}  // namespace passo
